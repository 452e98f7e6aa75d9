/* SPDX-License-Identifier: MIT */
#include "safety_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/** The units of length, time and parts: so many of the new ones are one of the old. */
typedef struct {
    double metres;
    double seconds;
    double parts;
} units_t;

static belt_config_t rescaled(const belt_config_t *old, const units_t *by) {
    belt_config_t scaled = *old;
    scaled.belt_length *= BELT_REAL(by->metres);
    scaled.processing_time *= BELT_REAL(by->seconds / by->metres);
    scaled.speed_window *= BELT_REAL(by->seconds);
    scaled.congestion_scale *= BELT_REAL(by->parts * by->seconds);
    scaled.service_rate_max *= BELT_REAL(by->parts / by->seconds);
    scaled.service_time *= BELT_REAL(by->seconds);
    scaled.level_capacity *= BELT_REAL(by->parts);
    scaled.rework_rate *= BELT_REAL(1.0 / (by->metres * by->seconds));
    for (size_t i = 0; i < scaled.loss_count; ++i) {
        scaled.loss_rate[i] *= BELT_REAL(1.0 / by->seconds);
    }
    scaled.level_setpoint *= BELT_REAL(by->parts);
    scaled.nominal_flux_max *= BELT_REAL(by->parts / by->seconds);
    scaled.slope *= BELT_REAL(1.0 / by->seconds);
    scaled.period *= BELT_REAL(by->seconds);
    return scaled;
}

/** Judges the line in other units, with a level and a belt. */
static void assess_in(const units_t *by, const belt_config_t *old) {
    static belt_real_t density[BELT_NODE_CAPACITY + 1];
    config = rescaled(old, by);
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = BELT_REAL((0.1 + 0.01 * (double)i) * by->parts / by->metres);
    }
    begin_loaded(0.35 * by->parts, density);
    assess();
}

static void assert_same(const belt_promise_t *known, const belt_promise_t *found,
                        const units_t *by) {
    const double tolerance = 200.0 * EPSILON; /* sums and products of some hundred roundings */
    assert_near((double)known->margin, (double)found->margin, tolerance);
    assert_near((double)known->flux_min * by->parts / by->seconds, (double)found->flux_min,
                tolerance);
    assert_near((double)known->density_max * by->parts / by->metres, (double)found->density_max,
                tolerance);
    TEST_ASSERT_TRUE((found->applies == known->applies) && (found->holds == known->holds));
}

static void test_promises_do_not_depend_on_the_units(void) {
    const units_t as_they_are = {1.0, 1.0, 1.0};
    const units_t others[] = {
        {3.28, 1.0, 1.0}, {1.0, 1.0 / 60.0, 1.0}, {1.0, 1.0, 250.0}, {0.01, 60.0, 100.0}};
    config.loss_count = 3;
    config.loss_rate[0] = BELT_HALF;
    config.loss_rate[1] = BELT_REAL(1);
    config.loss_rate[2] = BELT_REAL(0.2);
    const belt_config_t old = config;
    assess_in(&as_they_are, &old);
    const belt_safety_t known = safety;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i) {
        assess_in(&others[i], &old);
        assert_same(&known.proposition, &safety.proposition, &others[i]);
        assert_same(&known.sharper, &safety.sharper, &others[i]);
        assert_near((double)known.jump * others[i].parts / others[i].metres, (double)safety.jump,
                    200.0 * EPSILON);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_promises_do_not_depend_on_the_units);
    return UNITY_END();
}
