/* SPDX-License-Identifier: MIT */
#include "limits.h"

#include "exponential.h"

static belt_real_t stated_or(belt_real_t stated, belt_real_t fallback) {
    return (stated > BELT_REAL(0)) ? stated : fallback;
}

void belt_limits_init(belt_limits_t *limits, const belt_config_t *config) {
    const belt_real_t dead_time = config->processing_time * config->belt_length;
    const belt_real_t transfer_time = stated_or(config->transfer_time, BELT_REAL(0.25) * dead_time);
    const belt_real_t flux_bound = belt_config_flux_bound(config);
    limits->inlet_flux_max =
        (config->inlet_flux_max < flux_bound) ? config->inlet_flux_max : flux_bound;
    limits->flux_step_max = (config->flux_rate_max > BELT_REAL(0))
                                ? config->flux_rate_max * config->period
                                : BELT_NO_FLUX_LIMIT;
    limits->substitute_flux = config->substitute_flux;
    /* Less than 1 however long the time is: a bump must end. */
    limits->transfer_kept =
        belt_within(BELT_REAL(0), BELT_REAL(1) + belt_expm1(-config->period / transfer_time),
                    BELT_REAL(1) - BELT_REAL_EPSILON);
    limits->bump_min = BELT_REAL(1e-6) * config->nominal_flux_max;
    limits->flux_tolerance = BELT_REAL(0.05) * config->nominal_flux_max;
    limits->level_step_max =
        stated_or(config->level_step_max, BELT_REAL(0.25) * config->level_capacity);
    limits->sample_periods = belt_config_sample_periods(config);
    const belt_real_t half_dead_time = BELT_HALF * dead_time / config->period;
    limits->hold_periods =
        (config->hold_periods > 0u) ? config->hold_periods : (uint32_t)half_dead_time;
    limits->recovery_samples = (config->recovery_samples > 0u) ? config->recovery_samples : 10u;
    const belt_real_t spacing = dead_time / BELT_REAL(config->node_count);
    /* BELT_PERIOD_PER_NODE: a period is no longer than that, but for rounding. */
    limits->stretch_periods = (uint32_t)(spacing / config->period * BELT_REAL(1.00001));
}
