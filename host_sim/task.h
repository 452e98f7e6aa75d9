/* SPDX-License-Identifier: MIT */
/*
 * task.h - whether the control task runs in a period, and what its counter of periods says.
 */
#ifndef HOST_SIM_TASK_H
#define HOST_SIM_TASK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "chance.h"
#include "scenario.h"

typedef struct {
    const scenario_t *scenario;
    chance_t chance[FAULT_CAPACITY]; /**< one for each fault. */
    uint32_t missed;                 /**< periods without a step since the last. */
    bool was_cut;                    /**< there was no power in the last period. */
} task_t;

/** One period. */
typedef struct {
    bool has_power;
    bool restarts;          /**< the first period with power again; then `steps` is true. */
    bool steps;             /**< the task runs. */
    uint32_t elapsed_ticks; /**< what the step is told. */
} task_period_t;

void task_begin(task_t *self, const scenario_t *scenario);

/** Period `index`; once each, in order. */
task_period_t task_next(task_t *self, size_t index);

#endif
