/* SPDX-License-Identifier: MIT */
/* The numbers derived from a configuration, and the value and limits of each rule. */
#include "config_case.h"

void setUp(void) {
    begin_with_papers_case();
}

void tearDown(void) {
}

/* --- the paper's case in numbers --- */

static void test_papers_case_breaks_no_rule(void) {
    assert_breaks_nothing_but(BELT_OK);
    TEST_ASSERT_EQUAL(BELT_OK, belt_config_check(&config, NULL));
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
}

static void test_derived_numbers_of_the_papers_case(void) {
    /* Four roundings at most in each: 4 EPSILON of the result. */
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.6, 0.6, (double)belt_config_setpoint_flux(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 2.0, 2.0, (double)belt_config_slope_min(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 22.0, 22.0, (double)belt_config_slope(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.6, 0.6, (double)belt_config_dead_time_max(&config));
}

static void test_above_the_middle_the_upper_branch_sets_the_least_slope(void) {
    /* Q* 0.5: flux 1; below (1.2 - 1)/0.5 = 0.4, above 1/0.5 = 2. Three roundings. */
    config.level_setpoint = BELT_REAL(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(3 * EPSILON * 2.0, 2.0, (double)belt_config_slope_min(&config));
}

static void test_units_enter_the_flux_and_the_dead_time(void) {
    config.service_time = BELT_REAL(2);
    config.congestion_scale = BELT_REAL(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.3, 0.3, (double)belt_config_setpoint_flux(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.7, 0.7, (double)belt_config_dead_time_max(&config));
}

static void test_absolute_slope_is_the_slope_itself(void) {
    config.slope_kind = BELT_SLOPE_ABSOLUTE;
    TEST_ASSERT_EQUAL_DOUBLE((double)config.slope, (double)belt_config_slope(&config));
}

/* --- value and limits --- */

static void test_rule_gives_the_value_of_its_field(void) {
    for (size_t i = 0; i < COUNT(fields); ++i) {
        TEST_ASSERT_EQUAL_DOUBLE((double)value_of(&fields[i]),
                                 (double)belt_config_rule(&config, fields[i].code).value);
    }
    TEST_ASSERT_EQUAL_DOUBLE((double)belt_config_slope(&config),
                             (double)belt_config_rule(&config, BELT_SETPOINT_SLOPE).value);
}

static void test_dimensions_lie_between_a_millionth_and_a_million(void) {
    const belt_status_t dimensions[] = {
        BELT_BELT_LENGTH,      BELT_PROCESSING_TIME, BELT_SPEED_WINDOW,   BELT_CONGESTION_SCALE,
        BELT_SERVICE_RATE_MAX, BELT_SERVICE_TIME,    BELT_LEVEL_CAPACITY, BELT_PERIOD};
    for (size_t i = 0; i < COUNT(dimensions); ++i) {
        assert_limits(dimensions[i], BELT_REAL(1e-6), BELT_REAL(1e6));
    }
    assert_limits(BELT_CONNECTIVITY, BELT_REAL(1e-6), BELT_REAL(1));
    assert_limits(BELT_REWORK_RATE, BELT_REAL(0), BELT_REAL(1e6));
    assert_limits(BELT_LOSS_RATE, BELT_REAL(-1e6), BELT_REAL(1e6));
}

static void test_limits_of_the_law_follow_from_the_line(void) {
    /* Bmax <= min(Qmax/service_time, mu)/alpha = 0.8/0.5; Q* < alpha*Bmax*service_time = 0.6, and
     * eight roundings below it for the flux to stay below Bmax. */
    const belt_rule_t flux = belt_config_rule(&config, BELT_NOMINAL_FLUX_MAX);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 1.6, 1.6, (double)flux.upper);
    const belt_rule_t setpoint = belt_config_rule(&config, BELT_LEVEL_SETPOINT);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.6, 0.6 * (1 - 8 * EPSILON), (double)setpoint.upper);
    TEST_ASSERT_TRUE(setpoint.lower_open && setpoint.upper_open);

    config.service_time = BELT_REAL(2); /* now Qmax/service_time = 0.5 is the lesser */
    const belt_rule_t slower = belt_config_rule(&config, BELT_NOMINAL_FLUX_MAX);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, 1.0, (double)slower.upper);
    const belt_rule_t longer = belt_config_rule(&config, BELT_LEVEL_SETPOINT);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 1.2, 1.2 * (1 - 8 * EPSILON), (double)longer.upper);
}

static void test_limits_of_counts_words_and_the_actuator(void) {
    assert_limits(BELT_LOSS_COUNT, BELT_REAL(1), BELT_REAL(BELT_LOSS_CAPACITY));
    assert_limits(BELT_NODE_COUNT, BELT_REAL(4), BELT_REAL(BELT_NODE_CAPACITY));
    assert_limits(BELT_SLOPE_KIND, BELT_REAL(0), BELT_REAL(1));
    assert_limits(BELT_PREDICTION_KIND, BELT_REAL(0), BELT_REAL(1));
    assert_limits(BELT_INLET_FLUX_MAX, BELT_REAL(0), BELT_REAL_MAX);
    TEST_ASSERT_TRUE(belt_config_rule(&config, BELT_INLET_FLUX_MAX).lower_open);
}

static void test_values_of_the_discretisation_rules(void) {
    /* At most six roundings each: 6 EPSILON of the number. */
    const belt_rule_t node = belt_config_rule(&config, BELT_PERIOD_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.025, 0.025, (double)node.upper);
    const belt_rule_t window = belt_config_rule(&config, BELT_WINDOW_LONG);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 82.0, 82.0, (double)window.value);
    const belt_rule_t dead_time = belt_config_rule(&config, BELT_DEAD_TIME);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 240.0, 240.0, (double)dead_time.value);
    const belt_rule_t exponent = belt_config_rule(&config, BELT_LOSS_EXPONENT);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.6, 0.6, (double)exponent.value);
    const belt_rule_t loss = belt_config_rule(&config, BELT_LOSS_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.03, 0.03, (double)loss.value);
    const belt_rule_t rework = belt_config_rule(&config, BELT_REWORK_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.006, 0.006, (double)rework.value);
    const belt_rule_t slope = belt_config_rule(&config, BELT_PERIOD_PER_SLOPE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.0275, 0.0275, (double)slope.value);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_papers_case_breaks_no_rule);
    RUN_TEST(test_derived_numbers_of_the_papers_case);
    RUN_TEST(test_above_the_middle_the_upper_branch_sets_the_least_slope);
    RUN_TEST(test_units_enter_the_flux_and_the_dead_time);
    RUN_TEST(test_absolute_slope_is_the_slope_itself);
    RUN_TEST(test_rule_gives_the_value_of_its_field);
    RUN_TEST(test_dimensions_lie_between_a_millionth_and_a_million);
    RUN_TEST(test_limits_of_the_law_follow_from_the_line);
    RUN_TEST(test_limits_of_counts_words_and_the_actuator);
    RUN_TEST(test_values_of_the_discretisation_rules);
    return UNITY_END();
}
