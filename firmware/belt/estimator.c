/* SPDX-License-Identifier: MIT */
#include "estimator.h"

#include "exponential.h"

/** How many times faster than the other two the third pole is: it takes the noise and hardly any time. */
#define FILTER_SPEED BELT_REAL(50)

/** 1 - exp(-interval/time): what is forgotten between two samples. */
static belt_real_t forgotten(belt_real_t interval, belt_real_t time) {
    return -belt_expm1(-interval / time);
}

void belt_estimator_gains_init(belt_estimator_gains_t *gains, const belt_config_t *config) {
    const belt_real_t interval = BELT_REAL(belt_config_sample_periods(config)) * config->period;
    const belt_real_t time = belt_config_estimator_time(config);
    /* With z - 1 = w the error has the polynomial
     *     w^3 + F (1 + L + interval*M) w^2 + F (L + 2 interval*M) w + F interval*M,
     * F, L, M the gains of filter, level and disturbance; wanted is (w + r)^2 (w + s). */
    const belt_real_t r = forgotten(interval, time);
    const belt_real_t s = forgotten(interval, time / FILTER_SPEED);
    const belt_real_t product = r * r * s;
    const belt_real_t filter = BELT_REAL(2) * r + s - r * (r + BELT_REAL(2) * s) + product;
    const bool is_on = config->estimator == BELT_ESTIMATOR_ON;
    gains->is_on = is_on ? 1u : 0u;
    gains->filter = filter;
    gains->level = (r * (r + BELT_REAL(2) * s) - BELT_REAL(2) * product) / filter;
    gains->disturbance = product / (filter * interval);
    gains->disturbance_max = config->connectivity * config->nominal_flux_max;
}

void belt_estimator_begin(belt_estimator_t *estimator, belt_real_t level) {
    estimator->level = level;
    estimator->difference = BELT_REAL(0);
}

void belt_estimator_expect(belt_estimator_t *estimator, const belt_line_t *line,
                           belt_real_t outlet_flux, belt_real_t duration) {
    const belt_real_t inflow = line->connectivity * outlet_flux + estimator->disturbance;
    const belt_real_t half = BELT_HALF * duration;
    const belt_real_t middle =
        estimator->level + half * (inflow - belt_line_service(line, estimator->level));
    estimator->level = belt_line_level(
        line, estimator->level + duration * (inflow - belt_line_service(line, middle)));
}

void belt_estimator_correct(belt_estimator_t *estimator, const belt_estimator_gains_t *gains,
                            const belt_line_t *line, belt_real_t level) {
    const belt_real_t found = level - estimator->level;
    const belt_real_t difference =
        belt_within(-line->level_capacity,
                    estimator->difference + gains->filter * (found - estimator->difference),
                    line->level_capacity);
    estimator->difference = difference;
    estimator->level = belt_line_level(line, estimator->level + gains->level * difference);
    estimator->disturbance = belt_within(-gains->disturbance_max,
                                         estimator->disturbance + gains->disturbance * difference,
                                         gains->disturbance_max);
}

bool belt_estimator_is_at_limit(const belt_estimator_t *estimator,
                                const belt_estimator_gains_t *gains) {
    return (gains->is_on != 0u) && ((estimator->disturbance >= gains->disturbance_max) ||
                                    (estimator->disturbance <= -gains->disturbance_max));
}
