/* SPDX-License-Identifier: MIT */
/* safety_case.h - a judged controller, and what the bounds are by hand. */
#ifndef TESTS_UNIT_SAFETY_CASE_H
#define TESTS_UNIT_SAFETY_CASE_H

#include "belt/safety.h"

#include "belt_case.h"

static belt_safety_t safety;

static inline void assess(void) {
    memset(&safety, 0xA5, sizeof safety);
    TEST_ASSERT_EQUAL(BELT_OK, belt_safety_assess(&controller, &safety));
}

/** A controller that starts with `config`, a level and nothing on the belt, and stays unfed. */
static inline void begin_at(double level) {
    start();
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX;
    measurement.applied_flux = BELT_REAL(0);
    (void)step_level(level);
}

/** The same with node_count + 1 densities on the belt, outlet to inlet. */
static inline void begin_loaded(double level, const belt_real_t *density) {
    start();
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_DENSITY;
    measurement.density = density;
    (void)step_level(level);
    measurement.present = BELT_HAS_LEVEL;
}

/** 1 + tau*level/congestion_scale. */
static inline double crowded(double level) {
    return 1.0 + (double)config.speed_window * level / (double)config.congestion_scale;
}

/** A * integral of y*exp(-c*(D - y)) over [0, D], c = C*P*crowding: the rework of a belt that leaves
 * with density 1, in closed form. */
static inline double rework_of_one(double crowding) {
    const double length = (double)config.belt_length;
    const double c = (double)config.loss_rate[0] * (double)config.processing_time * crowding;
    return (double)config.rework_rate * (length / c - (1.0 - exp(-c * length)) / (c * c));
}

static inline void assert_near(double expected, double found, double relative) {
    TEST_ASSERT_DOUBLE_WITHIN(relative * fabs(expected), expected, found);
}

static inline void assert_finite(const belt_promise_t *promise) {
    const belt_real_t numbers[] = {promise->flux_min, promise->density_max, promise->left,
                                   promise->right, promise->margin};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        TEST_ASSERT_TRUE((numbers[i] >= BELT_REAL(0)) && (numbers[i] <= BELT_REAL_MAX));
    }
}

static inline void assert_all_finite(void) {
    assert_finite(&safety.proposition);
    assert_finite(&safety.sharper);
    TEST_ASSERT_TRUE((safety.jump >= -BELT_REAL_MAX) && (safety.jump <= BELT_REAL_MAX));
}

static inline void assert_no_promise(void) {
    TEST_ASSERT_FALSE(safety.proposition.holds);
    TEST_ASSERT_FALSE(safety.sharper.holds);
}

#endif
