/* SPDX-License-Identifier: MIT */
/*
 * periodic.c - the periodic task of firmware/port on an emulated board, with a recorded run for its
 * sensors and its operator. Reads the calls of the run from `request`; from `setup` the cycles of a
 * period, and the step in which the task hangs as its measurement never comes. Writes a reply for each
 * call into `reply`, as server.c does, and at the end what the task counted into `report`. Exit 0 done, 1
 * a file or a message was not as it should be, 3 the timer cannot count a period, 4 the watchdog has
 * reset the board while the task ran: of `report` the times it was fed hold.
 */
#include "belt/belt.h"
#include "channel.h"
#include "port.h"
#include "task.h"
#include "watchdog.h"

typedef struct {
    int requests;
    int replies;
    exchange_message_t message;
    belt_config_t config;
    belt_real_t profile[BELT_NODE_CAPACITY + 1];
    belt_command_t command;
    uint32_t hang_at; /* step */
    bool is_well;
} playback_t;

static playback_t playback;

/* The watchdog bites before more periods are lost than a step makes up for. */
#define WATCHDOG_PERIODS 100u
#define RUNNING 0x52554E21u

/* What a reset leaves as it is: it tells one that the watchdog made from power-on. */
static struct {
    uint32_t is_running; /* RUNNING, while the task does */
    uint32_t fed;        /* times the watchdog was */
} survivor __attribute__((section(".preserve")));

static void reply(belt_controller_t *controller, belt_status_t status) {
    exchange_t exchange = exchange_write(&playback.message, (uint32_t)status);
    exchange_state(&exchange, controller, &playback.command);
    playback.is_well = playback.is_well && exchange_end(&exchange) &&
                       channel_send(playback.replies, &playback.message);
}

/** What the operator says. */
static void hear(belt_controller_t *controller) {
    exchange_t call = exchange_read(&playback.message);
    belt_real_t number = BELT_REAL(0);
    uint32_t word = 0;
    belt_status_t status = BELT_MISUSE;
    switch ((exchange_call_t)playback.message.what) {
        case EXCHANGE_INIT:
            exchange_config(&call, &playback.config);
            status = belt_init(controller, &playback.config);
            break;
        case EXCHANGE_SETPOINT:
            exchange_real(&call, &number);
            status = belt_set_setpoint(controller, number);
            break;
        case EXCHANGE_MODE:
            exchange_word(&call, &word);
            status = belt_set_mode(controller, (belt_mode_t)word);
            break;
        case EXCHANGE_MANUAL_FLUX:
            exchange_real(&call, &number);
            status = belt_set_manual_flux(controller, number);
            break;
        case EXCHANGE_STEP:
        case EXCHANGE_TAKE:
        case EXCHANGE_RESTORE: call.is_sound = false; break;
    }
    playback.is_well = playback.is_well && exchange_end(&call);
    reply(controller, status);
}

/** Hears all that is said before the next measurement. False at the end of the run. */
static bool hear_all(belt_controller_t *controller) {
    while (playback.is_well && channel_receive(playback.requests, &playback.message)) {
        if (playback.message.what == (uint32_t)EXCHANGE_STEP) {
            return true;
        }
        hear(controller);
    }
    return false;
}

static task_t task;

static bool measure(void *context, belt_controller_t *controller, uint32_t elapsed_ticks,
                    belt_measurement_t *measurement) {
    (void)context;
    (void)elapsed_ticks; /* the recorded sensors wait for a task that is late */
    if (!hear_all(controller)) {
        return false;
    }
    while (task.steps == playback.hang_at) {
        __asm__ volatile(""); /* a sensor that never answers */
    }
    exchange_t call = exchange_read(&playback.message);
    exchange_measurement(&call, measurement, playback.profile, playback.config.node_count);
    playback.is_well = playback.is_well && exchange_end(&call);
    return playback.is_well;
}

static void feed(void *context, belt_status_t status, const belt_command_t *command) {
    (void)context;
    playback.command = *command;
    reply(&task.controller, status);
}

static void feed_watchdog(void *context) {
    (void)context;
    port_watchdog_feed();
    survivor.fed += 1u;
}

static bool read_setup(uint32_t *cycles) {
    const int setup = channel_open("setup", false);
    bool is_read = (setup >= 0) && channel_receive(setup, &playback.message);
    exchange_t exchange = exchange_read(&playback.message);
    exchange_word(&exchange, cycles);
    exchange_word(&exchange, &playback.hang_at);
    return is_read && exchange_end(&exchange);
}

static bool write_report(void) {
    uint32_t busy_low = (uint32_t)task.busy_cycles;
    uint32_t busy_high = (uint32_t)(task.busy_cycles >> 32);
    uint32_t *const numbers[] = {&task.steps,        &task.overruns,   &task.lost_periods,
                                 &task.worst_cycles, &task.worst_step, &task.period_cycles,
                                 &busy_low,          &busy_high,       &survivor.fed};
    const int report = channel_open("report", true);
    exchange_t exchange = exchange_write(&playback.message, 0);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        exchange_word(&exchange, numbers[i]);
    }
    return (report >= 0) && exchange_end(&exchange) && channel_send(report, &playback.message);
}

/** Runs the task to the end of the run. */
static int play(uint32_t cycles) {
    static const task_io_t io = {NULL, measure, feed, feed_watchdog};
    task.io = &io;
    /* The run begins with its configuration; init belongs before the first period. */
    if (playback.is_well && channel_receive(playback.requests, &playback.message)) {
        hear(&task.controller);
    }
    survivor.is_running = RUNNING;
    survivor.fed = 0;
    port_watchdog_start(WATCHDOG_PERIODS * cycles);
    if (!task_start(&task, cycles)) {
        return 3;
    }
    while (task_run(&task)) {
    }
    survivor.is_running = 0;
    return (playback.is_well && write_report()) ? 0 : 1;
}

int main(void) {
    uint32_t cycles = 0;
    if (survivor.is_running == RUNNING) {
        survivor.is_running = 0;
        return write_report() ? 4 : 1;
    }
    playback.requests = channel_open("request", false);
    playback.replies = channel_open("reply", true);
    playback.is_well = (playback.requests >= 0) && (playback.replies >= 0) && read_setup(&cycles);
    return play(cycles);
}
