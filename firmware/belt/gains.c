/* SPDX-License-Identifier: MIT */
#include "gains.h"

#include "exponential.h"

belt_real_t belt_gains_root(belt_real_t steepness) {
    /* Both steepness and 2 (steepness - 1) lie right of the root, where the function is convex and
     * rising: from there Newton's steps fall monotonically onto the root. */
    const belt_real_t near_one = BELT_REAL(2) * (steepness - BELT_REAL(1));
    belt_real_t x = (near_one < steepness) ? near_one : steepness;
    for (int i = 0; i < BELT_GAIN_ITERATIONS; ++i) {
        const belt_real_t fall = belt_expm1(-x);
        const belt_real_t residual = x + steepness * fall;
        const belt_real_t rise = BELT_REAL(1) - steepness * (BELT_REAL(1) + fall);
        const belt_real_t next = x - residual / rise;
        x = ((next > BELT_REAL(0)) && (next < x)) ? next : x;
    }
    /* So close to 1 that rounding took the root: the law then is a straight line, and any small gain
     * gives it. */
    return (x > BELT_REAL_EPSILON) ? x : BELT_REAL_EPSILON;
}

belt_gains_t belt_gains_solve(const belt_config_t *config) {
    const belt_real_t flux = belt_config_setpoint_flux(config);
    const belt_real_t slope = belt_config_slope(config);
    const belt_real_t reach_below = config->level_setpoint;
    const belt_real_t reach_above = config->level_capacity - config->level_setpoint;
    belt_gains_t gains;
    gains.below =
        belt_gains_root(slope * reach_below / (config->nominal_flux_max - flux)) / reach_below;
    gains.above = belt_gains_root(slope * reach_above / flux) / reach_above;
    return gains;
}
