/* SPDX-License-Identifier: MIT */
#include "power.h"

#include <string.h>

#include "schedule.h"

/* What the memory holds after a cut is anything: here this. */
#define MEMORY_AFTER_A_CUT 0xA5

void power_begin(power_t *self, const scenario_t *scenario) {
    const double period = scenario->controller.period;
    const double interval = scenario->run.snapshot_period;
    const double last_cut = fault_last_cut(scenario->run.faults, scenario->run.fault_count);
    memset(self, 0, sizeof *self);
    self->interval = (interval > 0.0) ? schedule_periods(interval, period) : 0;
    self->end = (last_cut >= 0.0) ? schedule_periods(last_cut, period) : SIZE_MAX;
}

void power_keep(power_t *self, const belt_controller_t *controller, size_t index) {
    if ((self->interval > 0) && (index >= self->due) && (index < self->end)) {
        (void)belt_snapshot_take(controller, self->slots);
        self->last = index;
        self->due = index + self->interval;
    }
}

bool power_restart(power_t *self, belt_controller_t *controller, const belt_config_t *config,
                   size_t index) {
    memset(controller, MEMORY_AFTER_A_CUT, sizeof *controller);
    const size_t down = index - self->last - 1; /* of no meaning while there is no snapshot */
    const belt_status_t status =
        belt_snapshot_restore(controller, config, self->slots, (uint32_t)down);
    return (status == BELT_OK) || (status == BELT_SNAPSHOT_OLD) ||
           (belt_init(controller, config) == BELT_OK);
}
