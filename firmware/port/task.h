/* SPDX-License-Identifier: MIT */
/*
 * task.h - the periodic control task, as it is flashed: a timer interrupt every control period, and in
 * the main loop measurement in, step, command out.
 *
 *     static task_t task = {.io = &io};
 *     belt_init(&task.controller, &config) ... task_start(&task, cycles) ... for (;;) task_run(&task);
 *
 * The interrupt counts periods and nothing else, so whatever else interrupts may. A step that is not
 * done when the next period begins is an overrun: it is counted, and the periods that no step of their
 * own saw are told to the next one (elapsed_ticks), which makes up for them. Only a finished step feeds
 * the watchdog: it bites when the task hangs, when the timer stops and when steps never come to an end.
 */
#ifndef PORT_TASK_H
#define PORT_TASK_H

#include "belt/belt.h"

/** The board's side of the task, called in the main loop. */
typedef struct {
    void *context;

    /** This period's measurement; elapsed_ticks and its bit are the task's. False: the task ends. */
    bool (*measure)(void *context, belt_controller_t *controller, uint32_t elapsed_ticks,
                    belt_measurement_t *measurement);

    /** The command to the actuator; it holds until the next one. */
    void (*feed)(void *context, belt_status_t status, const belt_command_t *command);

    void (*feed_watchdog)(void *context);
} task_io_t;

typedef struct {
    const task_io_t *io;
    belt_controller_t controller;
    belt_measurement_t measurement;
    belt_command_t command;

    uint32_t period_cycles; /**< from one interrupt to the next. */
    uint32_t last_period;   /**< the one the last step belonged to. */

    /* What an operator wants to see. */
    uint32_t steps;        /**< finished. */
    uint32_t overruns;     /**< of these not within their period. */
    uint32_t lost_periods; /**< without a step of their own. */
    uint32_t worst_cycles; /**< of any step, measurement and command included. */
    uint32_t worst_step;   /**< which one it was. */
    uint64_t busy_cycles;  /**< of all steps. */
} task_t;

/** Called by the timer's interrupt, once a period. */
void task_tick(void);

/** Starts the timer. False: it cannot count so far. */
bool task_start(task_t *task, uint32_t period_cycles);

/** Sleeps until a period begins, then does its work. False once the board has no more measurements. */
bool task_run(task_t *task);

#endif
