/* SPDX-License-Identifier: MIT */
#include "nominal_law.h"

#include "exponential.h"

void belt_nominal_law_init(belt_nominal_law_t *law, const belt_config_t *config) {
    const belt_real_t slope = belt_config_slope(config);
    law->level_setpoint = config->level_setpoint;
    law->setpoint_flux = belt_config_setpoint_flux(config);
    law->level_capacity = config->level_capacity;
    law->gains = belt_gains_solve(config);
    /* From the gain equations: (Bmax - flux)/(1 - exp(-Lambda Q*)) = S/Lambda. */
    law->reach_below = slope / law->gains.below;
    law->reach_above = slope / law->gains.above;
}

belt_real_t belt_nominal_law_flux(const belt_nominal_law_t *law, belt_real_t level) {
    const belt_real_t missing =
        law->level_setpoint - belt_within(BELT_REAL(0), level, law->level_capacity);
    if (missing >= BELT_REAL(0)) {
        return law->setpoint_flux - law->reach_below * belt_expm1(-law->gains.below * missing);
    }
    const belt_real_t flux =
        law->setpoint_flux + law->reach_above * belt_expm1(law->gains.above * missing);
    return (flux > BELT_REAL(0)) ? flux : BELT_REAL(0);
}
