/* SPDX-License-Identifier: MIT */
/* The march with a flow into the buffer that the model does not know. */
#include "belt/predictor.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_model_t model;
static belt_prediction_t prediction;

/** An evenly filled belt, a constant level, and no congestion to speak of: P*D = 0.5 s. */
static void march(double density, double level, double disturbance) {
    belt_real_t nodes[BELT_NODE_CAPACITY + 1];
    belt_line_init(&model.line, &config);
    for (uint32_t i = 0; i <= model.line.node_count; ++i) {
        nodes[i] = BELT_REAL(density);
    }
    belt_observer_assume(&model.observer, &model.line, nodes);
    belt_level_history_init(&model.history, &config);
    belt_level_history_begin(&model.history, BELT_REAL(level));
    model.present = (belt_present_t){.level = BELT_REAL(level),
                                     .congestion = belt_level_history_congestion(&model.history),
                                     .disturbance = BELT_REAL(disturbance),
                                     .disturbance_flux = BELT_REAL(NAN)}; /* not the march's */
    memset(&prediction, 0xFF, sizeof prediction);
    belt_predictor_march(&prediction, &model);
}

void setUp(void) {
    config = paper_case();
    config.congestion_scale = BELT_REAL(1e6);
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
}

void tearDown(void) {
}

/* Ten roundings a cell, and a millionth of congestion of up to 0.1. */
#define ROUNDING (10 * EPSILON * 20 + 1e-7)

static void test_full_service_and_a_disturbance_make_a_straight_line(void) {
    config.service_rate_max = BELT_REAL(0.125);
    march(0.0, 0.5, 0.25);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.5 + (0.25 - 0.125) * 0.5, (double)prediction.inlet.level);
    march(0.0, 0.5, -0.25);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.5 - (0.25 + 0.125) * 0.5, (double)prediction.inlet.level);
}

static void test_disturbance_fills_an_empty_buffer_by_its_exponential(void) {
    march(0.0, 0.0, 0.25);
    /* Q' = 0.25 - Q; midpoint steps of 0.05 s leave h^2/6 of the rate a second. */
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 6.0 * 0.5 * 0.25 + ROUNDING, 0.25 * (1.0 - exp(-0.5)),
                              (double)prediction.inlet.level);
}

static void test_disturbance_adds_to_what_arrives(void) {
    march(0.125, 0.4, 0.15); /* alpha*density/P = 0.25, and 0.15: 0.4 is served */
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.4, (double)prediction.inlet.level);
    for (uint32_t i = 0; i <= prediction.inlet.count; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.4, (double)prediction.level[i]);
    }
}

static void test_disturbance_is_as_much_a_second_on_every_kind_of_march(void) {
    /* Odd and even counts, uniform loss or not: 0.2 more a second for 0.5 s of full service. */
    config.service_rate_max = BELT_REAL(0.125);
    for (uint16_t nodes = 20; nodes <= 21; ++nodes) {
        for (uint16_t kinds = 1; kinds <= 2; ++kinds) {
            config.node_count = nodes;
            config.loss_count = kinds;
            config.loss_rate[1] = BELT_REAL(1);
            march(0.125, 0.25, 0.0);
            const double without = (double)prediction.inlet.level;
            march(0.125, 0.25, 0.2);
            TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, without + 0.1, (double)prediction.inlet.level);
        }
    }
}

static void test_disturbance_slows_the_line_by_the_level_it_makes(void) {
    config.congestion_scale = BELT_REAL(1);
    config.service_rate_max = BELT_REAL(0.125);
    march(0.0, 0.25, 0.125); /* nothing changes: R = 0.05, 1/omega = 0.2625 */
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.525, (double)prediction.inlet.arrival);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.25, (double)prediction.inlet.level);
    const double steady = (double)prediction.inlet.arrival;
    march(0.0, 0.25, 0.25);
    TEST_ASSERT_TRUE((double)prediction.inlet.arrival > steady + 0.001);
}

static void test_level_stays_in_the_buffer_whatever_the_disturbance(void) {
    const double most[] = {1.4, -1.4};
    const double ends[] = {1.0, 0.0};
    for (size_t i = 0; i < 2; ++i) {
        march(0.0, 0.5, most[i]);
        for (uint32_t k = 0; k <= prediction.inlet.count; ++k) {
            TEST_ASSERT_TRUE((prediction.level[k] >= BELT_REAL(0)) &&
                             (prediction.level[k] <= BELT_REAL(1)));
        }
        config.service_rate_max = BELT_REAL(0.125);
        march(0.0, 0.5, most[i]);
        TEST_ASSERT_EQUAL_DOUBLE(ends[i], (double)prediction.inlet.level);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_full_service_and_a_disturbance_make_a_straight_line);
    RUN_TEST(test_disturbance_fills_an_empty_buffer_by_its_exponential);
    RUN_TEST(test_disturbance_adds_to_what_arrives);
    RUN_TEST(test_disturbance_is_as_much_a_second_on_every_kind_of_march);
    RUN_TEST(test_disturbance_slows_the_line_by_the_level_it_makes);
    RUN_TEST(test_level_stays_in_the_buffer_whatever_the_disturbance);
    return UNITY_END();
}
