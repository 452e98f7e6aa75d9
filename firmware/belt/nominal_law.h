/* SPDX-License-Identifier: MIT */
/*
 * nominal_law.h - the softened bang-bang law u(Q*, Q) of the line without dead time (eq:bangbang).
 *
 * Below the set-point it rises towards nominal_flux_max as the buffer empties, above it falls
 * towards 0 as the buffer fills; both branches meet at Q* in value and slope. One branch takes the
 * point Q = Q*: with two Heavisides both would count there.
 */
#ifndef BELT_NOMINAL_LAW_H
#define BELT_NOMINAL_LAW_H

#include "gains.h"

typedef struct {
    belt_real_t level_setpoint; /**< Q* [parts]. */
    belt_real_t setpoint_flux;  /**< Q* / (alpha service_time): holds the set-point [parts/s]. */
    belt_real_t level_capacity; /**< Qmax [parts]. */
    belt_gains_t gains;         /**< Lambda_l, Lambda_r [1/parts]. */
    belt_real_t reach_below;    /**< S/Lambda_l: how far the lower branch would rise [parts/s]. */
    belt_real_t reach_above;    /**< S/Lambda_r: how far the upper branch would fall [parts/s]. */
} belt_nominal_law_t;

/** Solves the gains for the configuration's set-point; not for the step. */
void belt_nominal_law_init(belt_nominal_law_t *law, const belt_config_t *config);

/** u(Q*, Q) in [0, nominal_flux_max] [parts/s] (bangBl, bangBr). Levels outside [0, level_capacity]
 * count as its ends. One exponential. */
belt_real_t belt_nominal_law_flux(const belt_nominal_law_t *law, belt_real_t level);

#endif
