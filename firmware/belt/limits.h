/* SPDX-License-Identifier: MIT */
/*
 * limits.h - the limits that gate and supervisor work with, defaults filled in, in periods.
 */
#ifndef BELT_LIMITS_H
#define BELT_LIMITS_H

#include "config.h"

typedef struct {
    belt_real_t
        inlet_flux_max; /**< greatest command: the configuration's, or belt_config_flux_bound()
                                     if that is less [parts/s]. */
    belt_real_t flux_step_max;   /**< greatest change of the command in a step [parts/s]. */
    belt_real_t substitute_flux; /**< [parts/s]. */
    belt_real_t transfer_kept;   /**< share of a bump that is left a period later, [0, 1). */
    belt_real_t bump_min;        /**< a bump that nobody sees [parts/s]. */
    belt_real_t flux_tolerance;  /**< how far command and applied flux may differ [parts/s]. */
    belt_real_t level_step_max;  /**< [parts]. */
    uint32_t sample_periods;
    uint32_t hold_periods;
    uint32_t recovery_samples;
    uint32_t stretch_periods; /**< periods in which no belt moves more than a node spacing, >= 1. */
} belt_limits_t;

/** For a configuration that belt_config_check() has passed. One exponential. */
void belt_limits_init(belt_limits_t *limits, const belt_config_t *config);

#endif
