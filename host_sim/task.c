/* SPDX-License-Identifier: MIT */
#include "task.h"

#include <math.h>

void task_begin(task_t *self, const scenario_t *scenario) {
    self->scenario = scenario;
    self->missed = 0;
    self->was_cut = false;
    for (uint32_t i = 0; i < FAULT_CAPACITY; ++i) {
        chance_begin(&self->chance[i], (uint32_t)scenario->plant.seed, i + 1u);
    }
}

/** What a fault at work does to the period. */
static void suffer(task_t *self, size_t number, task_period_t *period) {
    const fault_t *const fault = &self->scenario->run.faults[number];
    chance_t *const chance = &self->chance[number];
    switch (fault->word) {
        case FAULT_OFF: period->has_power = false; break;
        case FAULT_STUCK: period->steps = false; break;
        case FAULT_INTERMITTENT:
            period->steps = period->steps && !(chance_share(chance) < fault->value);
            break;
        case FAULT_GARBAGE:
            period->elapsed_ticks = (uint32_t)(chance_bits(chance) % (FAULT_TICKS_MAX + 1u));
            break;
        case FAULT_WRONG:
            period->elapsed_ticks =
                (uint32_t)fmin(floor(fault->value * period->elapsed_ticks + 0.5), UINT32_MAX);
            break;
        case FAULT_SLOW:
        case FAULT_DELAYED: break; /* the scenario's reader refuses them */
    }
}

task_period_t task_next(task_t *self, size_t index) {
    const scenario_t *const scenario = self->scenario;
    task_period_t period = {true, false, true, self->missed + 1u};
    for (size_t i = 0; i < scenario->run.fault_count; ++i) {
        const fault_t *const fault = &scenario->run.faults[i];
        if ((fault->signal == FAULT_ON_PERIOD) &&
            fault_is_active(fault, index, scenario->controller.period)) {
            suffer(self, i, &period);
        }
    }
    period.restarts = period.has_power && self->was_cut;
    period.steps = period.has_power && (period.steps || period.restarts);
    if (period.restarts) {
        period.elapsed_ticks = 1; /* the restart itself is told how long it was down */
    }
    self->was_cut = !period.has_power;
    self->missed = period.steps ? 0u : self->missed + 1u;
    return period;
}
