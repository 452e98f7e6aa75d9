/* SPDX-License-Identifier: MIT */
#include "rivals.h"

#include "equilibrium.h"
#include "model.h"

void rivals_begin(rivals_t *self, const scenario_t *scenario) {
    const rivals_t fresh = {scenario, 0.0, 0.0, false};
    *self = fresh;
}

bool rivals_are_out(const scenario_t *scenario) {
    return (scenario->controller.law == LAW_PREDICTOR) || (scenario->controller.law == LAW_FROZEN);
}

/** Found anew only when the set-point has changed. */
static double open_loop_flux(rivals_t *self, double level_setpoint) {
    const bool has_changed =
        (level_setpoint > self->level_setpoint) || (level_setpoint < self->level_setpoint);
    if (!self->has_flux || has_changed) {
        self->level_setpoint = level_setpoint;
        self->holding_flux = equilibrium_of(&self->scenario->line, level_setpoint).inlet_flux;
        self->has_flux = true;
    }
    return self->holding_flux;
}

double rivals_flux(rivals_t *self, const belt_controller_t *controller, const belt_command_t *own,
                   double level_setpoint) {
    const belt_real_t limit = controller->config.inlet_flux_max;
    switch (self->scenario->controller.law) {
        case LAW_UNCOMPENSATED:
            return (double)belt_command_limit(
                belt_nominal_law_flux(&controller->law, controller->model.present.level), limit);
        case LAW_OPEN_LOOP:
            return (double)belt_command_limit(model_real(open_loop_flux(self, level_setpoint)),
                                              limit);
        case LAW_PREDICTOR:
        case LAW_FROZEN: break;
    }
    return (double)own->inlet_flux;
}
