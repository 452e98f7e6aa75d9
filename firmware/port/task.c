/* SPDX-License-Identifier: MIT */
#include "task.h"

#include "port.h"

/* Periods begun. Written by the interrupt alone, one word: no lock is needed. */
static volatile uint32_t begun;

void task_tick(void) {
    begun = begun + 1u;
}

bool task_start(task_t *task, uint32_t period_cycles) {
    task->period_cycles = period_cycles;
    task->last_period = begun;
    return port_start(period_cycles);
}

static void note(task_t *task, uint32_t period, uint32_t cycles) {
    task->busy_cycles += cycles;
    if (cycles > task->worst_cycles) {
        task->worst_cycles = cycles;
        task->worst_step = task->steps;
    }
    if (begun != period) {
        task->overruns += 1u;
    }
    task->steps += 1u;
}

bool task_run(task_t *task) {
    const task_io_t *io = task->io;
    while (begun == task->last_period) {
        port_sleep_while(&begun, task->last_period);
    }
    const uint32_t begin = port_cycles();
    const uint32_t period = begun;
    const uint32_t elapsed = period - task->last_period;
    task->last_period = period;
    if (!io->measure(io->context, &task->controller, elapsed, &task->measurement)) {
        return false;
    }
    task->measurement.present |= BELT_HAS_ELAPSED_TICKS;
    task->measurement.elapsed_ticks = elapsed;
    const belt_status_t status = belt_step(&task->controller, &task->measurement, &task->command);
    io->feed(io->context, status, &task->command);
    io->feed_watchdog(io->context);
    task->lost_periods += elapsed - 1u;
    note(task, period, port_cycles() - begin);
    return true;
}
