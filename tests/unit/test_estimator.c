/* SPDX-License-Identifier: MIT */
#include "belt/estimator.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_line_t line;
static belt_estimator_gains_t gains;
static belt_estimator_t estimator;

static void begin(double level) {
    belt_line_init(&line, &config);
    belt_estimator_gains_init(&gains, &config);
    belt_estimator_begin(&estimator, BELT_REAL(level));
}

/* Numbers of these lines are sums of powers of two, so that a step is exact. */
void setUp(void) {
    config = paper_case();
    config.estimator = BELT_ESTIMATOR_ON;
    estimator = (belt_estimator_t){0};
    begin(0.5);
    gains = (belt_estimator_gains_t){.is_on = 1u,
                                     .filter = BELT_REAL(0.5),
                                     .level = BELT_REAL(0.25),
                                     .disturbance = BELT_REAL(2),
                                     .disturbance_max = BELT_REAL(1)};
}

void tearDown(void) {
}

static void expect(double outlet_flux, double duration) {
    belt_estimator_expect(&estimator, &line, BELT_REAL(outlet_flux), BELT_REAL(duration));
}

static void correct(double level) {
    belt_estimator_correct(&estimator, &gains, &line, BELT_REAL(level));
}

static void assert_is(double level, double difference, double disturbance) {
    TEST_ASSERT_EQUAL_DOUBLE(level, (double)estimator.level);
    TEST_ASSERT_EQUAL_DOUBLE(difference, (double)estimator.difference);
    TEST_ASSERT_EQUAL_DOUBLE(disturbance, (double)estimator.disturbance);
}

static void set(double level, double difference, double disturbance) {
    estimator.level = BELT_REAL(level);
    estimator.difference = BELT_REAL(difference);
    estimator.disturbance = BELT_REAL(disturbance);
}

/* --- begin --- */

static void test_begin_takes_the_level_and_leaves_the_disturbance(void) {
    set(0.25, 0.125, 0.375);
    belt_estimator_begin(&estimator, BELT_REAL(0.75));
    assert_is(0.75, 0.0, 0.375);
}

/* --- what is expected --- */

static void test_full_service_and_a_constant_inflow_make_a_straight_line(void) {
    config.service_rate_max = BELT_REAL(0.125);
    begin(0.5);
    set(0.5, 0.0625, 0.25);
    expect(0.5, 0.25); /* 0.5 + 0.25*(0.5*0.5 + 0.25 - 0.125) */
    assert_is(0.59375, 0.0625, 0.25);
}

static void test_service_is_that_of_the_middle(void) {
    set(0.5, 0.0, 0.125);
    expect(0.5, 0.25);
    /* Inflow 0.375; in the middle 0.5 + 0.125*(0.375 - 0.5) = 0.484375, which is served. */
    assert_is(0.5 + 0.25 * (0.375 - 0.484375), 0.0, 0.125);
}

static void test_expected_level_follows_the_exponential_of_the_buffer(void) {
    set(0.5, 0.0, 0.125);
    expect(0.5, 0.0025);
    /* Q' = 0.375 - Q; the midpoint leaves T^3/6 of the rate, and three roundings. */
    TEST_ASSERT_DOUBLE_WITHIN(0.0025 * 0.0025 * 0.0025 / 6.0 * 0.125 + 2 * EPSILON,
                              0.375 + 0.125 * exp(-0.0025), (double)estimator.level);
}

static void test_no_time_changes_nothing(void) {
    set(0.5, 0.25, 0.125);
    expect(0.5, 0.0);
    assert_is(0.5, 0.25, 0.125);
}

static void test_expected_level_stays_in_the_buffer(void) {
    set(0.875, 0.0, 0.0);
    expect(1e6, 0.25);
    assert_is(1.0, 0.0, 0.0);
    set(0.125, 0.0, -1.0);
    expect(0.0, 0.25);
    assert_is(0.0, 0.0, -1.0);
}

/* --- correction --- */

static void test_filtered_difference_corrects_both(void) {
    set(0.25, 0.125, 0.0625);
    correct(0.75);
    /* Found 0.5: 0.125 + 0.5*(0.5 - 0.125); a quarter of it for the level, twice for the other. */
    assert_is(0.25 + 0.25 * 0.3125, 0.3125, 0.0625 + 2.0 * 0.3125);
}

static void test_level_as_expected_only_empties_the_filter(void) {
    set(0.5, 0.125, 0.25);
    correct(0.5);
    assert_is(0.5 + 0.25 * 0.0625, 0.0625, 0.25 + 2.0 * 0.0625);
    set(0.5, 0.0, 0.25);
    correct(0.5);
    assert_is(0.5, 0.0, 0.25);
}

static void test_corrected_level_stays_in_the_buffer(void) {
    set(1.0, 1.0, 0.0);
    correct(1.0);
    TEST_ASSERT_TRUE(estimator.level == BELT_REAL(1));
    set(0.0, -1.0, 0.0);
    correct(0.0);
    TEST_ASSERT_TRUE(estimator.level == BELT_REAL(0));
}

static void test_difference_stays_within_the_capacity(void) {
    set(0.5, 8.0, 0.0);
    correct(0.5);
    TEST_ASSERT_TRUE(estimator.difference == config.level_capacity);
    set(0.5, -8.0, 0.0);
    correct(0.5);
    TEST_ASSERT_TRUE(estimator.difference == -config.level_capacity);
}

static void test_disturbance_stays_within_its_limit(void) {
    set(0.5, 1.0, 0.75);
    correct(0.5);
    TEST_ASSERT_TRUE(estimator.disturbance == BELT_REAL(1));
    set(0.5, -1.0, -0.75);
    correct(0.5);
    TEST_ASSERT_TRUE(estimator.disturbance == BELT_REAL(-1));
}

/* --- at the limit --- */

static bool is_at_limit(double disturbance) {
    set(0.5, 0.0, disturbance);
    return belt_estimator_is_at_limit(&estimator, &gains);
}

static void test_limit_is_told_at_both_ends_and_not_between(void) {
    TEST_ASSERT_TRUE(is_at_limit(1.0));
    TEST_ASSERT_TRUE(is_at_limit(-1.0));
    TEST_ASSERT_FALSE(is_at_limit((double)real_next(BELT_REAL(1), BELT_REAL(0))));
    TEST_ASSERT_FALSE(is_at_limit((double)real_next(BELT_REAL(-1), BELT_REAL(0))));
    TEST_ASSERT_FALSE(is_at_limit(0.0));
}

static void test_without_estimator_there_is_no_limit(void) {
    gains.is_on = 0u;
    TEST_ASSERT_FALSE(is_at_limit(1.0));
    TEST_ASSERT_FALSE(is_at_limit(-1.0));
}

/* --- whatever the bits --- */

static void assert_is_sound(void) {
    TEST_ASSERT_TRUE((estimator.level >= BELT_REAL(0)) &&
                     (estimator.level <= config.level_capacity));
    TEST_ASSERT_TRUE((estimator.difference >= -config.level_capacity) &&
                     (estimator.difference <= config.level_capacity));
    TEST_ASSERT_TRUE((estimator.disturbance >= -gains.disturbance_max) &&
                     (estimator.disturbance <= gains.disturbance_max));
}

static void test_one_step_makes_any_state_sound(void) {
    const double senseless[] = {NAN, -NAN, INFINITY, -INFINITY, 1e30, -1e30};
    for (size_t i = 0; i < sizeof senseless / sizeof senseless[0]; ++i) {
        for (int field = 0; field < 3; ++field) {
            set((field == 0) ? senseless[i] : 0.5, (field == 1) ? senseless[i] : 0.0,
                (field == 2) ? senseless[i] : 0.0);
            expect(0.5, 0.0025);
            correct(0.5);
            assert_is_sound();
        }
    }
}

static void test_senseless_arguments_leave_a_sound_state(void) {
    const double senseless[] = {NAN, INFINITY, -INFINITY, 1e30, -1e30};
    for (size_t i = 0; i < sizeof senseless / sizeof senseless[0]; ++i) {
        set(0.5, 0.0, 0.0);
        expect(senseless[i], 0.0025);
        correct(senseless[i]);
        assert_is_sound();
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_begin_takes_the_level_and_leaves_the_disturbance);
    RUN_TEST(test_full_service_and_a_constant_inflow_make_a_straight_line);
    RUN_TEST(test_service_is_that_of_the_middle);
    RUN_TEST(test_expected_level_follows_the_exponential_of_the_buffer);
    RUN_TEST(test_no_time_changes_nothing);
    RUN_TEST(test_expected_level_stays_in_the_buffer);
    RUN_TEST(test_filtered_difference_corrects_both);
    RUN_TEST(test_level_as_expected_only_empties_the_filter);
    RUN_TEST(test_corrected_level_stays_in_the_buffer);
    RUN_TEST(test_difference_stays_within_the_capacity);
    RUN_TEST(test_disturbance_stays_within_its_limit);
    RUN_TEST(test_limit_is_told_at_both_ends_and_not_between);
    RUN_TEST(test_without_estimator_there_is_no_limit);
    RUN_TEST(test_one_step_makes_any_state_sound);
    RUN_TEST(test_senseless_arguments_leave_a_sound_state);
    return UNITY_END();
}
