/* SPDX-License-Identifier: MIT */
/*
 * gains.h - from set-point and slope to the two gains of the nominal law.
 *
 * Call at start-up and at a change of set-point, not in the step: about 20 exponentials.
 */
#ifndef BELT_GAINS_H
#define BELT_GAINS_H

#include "config.h"

/** Newton steps; from the start chosen below it converges in 8 or fewer for every slope a configuration
 * may have, and then stays. */
#define BELT_GAIN_ITERATIONS 8

typedef struct {
    belt_real_t below; /**< Lambda_l: gain for levels below the set-point [1/parts], > 0. */
    belt_real_t above; /**< Lambda_r: gain for levels above it [1/parts], > 0. */
} belt_gains_t;

/** The gains (eq:lambda_left, eq:lambda_right) of a configuration that belt_config_check() has
 * passed. */
belt_gains_t belt_gains_solve(const belt_config_t *config);

/** The positive root of x = steepness*(1 - exp(-x)), steepness > 1: both gain equations in
 * dimensionless form. Bounded iterations; relative error a few units in the last place of
 * steepness - 1. */
belt_real_t belt_gains_root(belt_real_t steepness);

#endif
