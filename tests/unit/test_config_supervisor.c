/* SPDX-License-Identifier: MIT */
/* The rules of estimator and supervisor: each field may be left 0. */
#include "config_case.h"

void setUp(void) {
    begin_with_papers_case();
}

void tearDown(void) {
}

static void assert_estimator_time(belt_real_t time, bool is_kept) {
    config.estimator_time = time;
    assert_breaks_nothing_but(is_kept ? BELT_OK : BELT_ESTIMATOR_TIME);
}

/* --- defaults --- */

static void test_everything_may_be_left_zero(void) {
    TEST_ASSERT_EQUAL(BELT_ESTIMATOR_OFF, config.estimator);
    assert_breaks_nothing_but(BELT_OK);
    config.estimator = BELT_ESTIMATOR_ON;
    assert_breaks_nothing_but(BELT_OK);
}

static void test_default_estimator_time_is_a_share_of_the_empty_lines_dead_time(void) {
    /* 0.74*0.25*2, three roundings; congestion does not enter. */
    TEST_ASSERT_DOUBLE_WITHIN(3 * EPSILON * 0.37, 0.37,
                              (double)belt_config_estimator_time(&config));
    config.processing_time = BELT_REAL(0.5);
    config.belt_length = BELT_REAL(5);
    TEST_ASSERT_DOUBLE_WITHIN(3 * EPSILON * 1.85, 1.85,
                              (double)belt_config_estimator_time(&config));
    config.estimator_time = BELT_REAL(-0.0);
    TEST_ASSERT_DOUBLE_WITHIN(3 * EPSILON * 1.85, 1.85,
                              (double)belt_config_estimator_time(&config));
}

static void test_stated_estimator_time_is_taken_as_it_is(void) {
    const belt_real_t times[] = {real_from_bits(1u), BELT_REAL(0.01), BELT_REAL(1e6)};
    for (size_t i = 0; i < COUNT(times); ++i) {
        config.estimator_time = times[i];
        TEST_ASSERT_TRUE(belt_config_estimator_time(&config) == times[i]);
        TEST_ASSERT_TRUE(belt_config_rule(&config, BELT_ESTIMATOR_TIME).value == times[i]);
    }
}

static void test_counts_may_have_any_value(void) {
    const uint16_t counts[] = {0u, 1u, 2u, UINT16_MAX - 1u, UINT16_MAX};
    for (size_t i = 0; i < COUNT(counts); ++i) {
        config.hold_periods = counts[i];
        config.recovery_samples = counts[i];
        config.sample_periods = counts[i]; /* the estimator is off */
        assert_breaks_nothing_but(BELT_OK);
    }
}

/* --- the estimator's time --- */

static void test_estimator_takes_no_less_than_the_time_between_two_samples(void) {
    config.estimator = BELT_ESTIMATOR_ON;
    config.period = BELT_REAL(0.001953125); /* a power of two: products of it are exact */
    for (uint16_t periods = 0; periods <= 4; ++periods) {
        config.sample_periods = periods;
        const belt_real_t least = config.period * BELT_REAL((periods > 0u) ? periods : 1u);
        assert_estimator_time(least, true);
        assert_estimator_time(real_next(least, BELT_REAL(0)), false);
        assert_estimator_time(real_next(least, BELT_REAL(1)), true);
        assert_limits(BELT_ESTIMATOR_TIME, least, BELT_REAL(1e6));
    }
}

static void test_default_estimator_time_must_bear_the_time_between_two_samples_too(void) {
    /* 0.37 s are 148 periods of 0.0025 s. */
    config.estimator = BELT_ESTIMATOR_ON;
    config.sample_periods = 147;
    assert_breaks_nothing_but(BELT_OK);
    config.sample_periods = 149;
    assert_breaks_nothing_but(BELT_ESTIMATOR_TIME);
    config.estimator = BELT_ESTIMATOR_OFF;
    assert_breaks_nothing_but(BELT_OK);
}

static void test_estimator_that_is_off_may_have_any_time_that_is_a_number(void) {
    assert_estimator_time(real_from_bits(1u), true);
    assert_estimator_time(BELT_REAL(0.0001), true);
    assert_limits(BELT_ESTIMATOR_TIME, BELT_REAL(0), BELT_REAL(1e6));
}

static void test_estimator_time_ends_at_a_million_and_is_a_number(void) {
    const belt_real_t senseless[] = {BELT_REAL(NAN),       -BELT_REAL(NAN),    BELT_REAL(INFINITY),
                                     BELT_REAL(-INFINITY), BELT_REAL_MAX,      -BELT_REAL_MAX,
                                     BELT_REAL(-1),        -real_from_bits(1u)};
    for (int kind = (int)BELT_ESTIMATOR_OFF; kind <= (int)BELT_ESTIMATOR_ON; ++kind) {
        config.estimator = (belt_estimator_kind_t)kind;
        assert_estimator_time(BELT_REAL(1e6), true);
        assert_estimator_time(real_next(BELT_REAL(1e6), BELT_REAL_MAX), false);
        for (size_t i = 0; i < COUNT(senseless); ++i) {
            assert_estimator_time(senseless[i], false);
        }
    }
}

/* --- limits of the others; their edges have been tested with those of every field --- */

static void test_limits_of_what_may_be_left_zero(void) {
    assert_limits(BELT_ESTIMATOR_KIND, BELT_REAL(0), BELT_REAL(1));
    assert_limits(BELT_FLUX_RATE_MAX, BELT_REAL(0), BELT_REAL(1e6));
    assert_limits(BELT_LEVEL_STEP_MAX, BELT_REAL(0), BELT_REAL(1e6));
    assert_limits(BELT_TRANSFER_TIME, BELT_REAL(0), BELT_REAL(1e6));
}

static void test_substitute_is_no_more_than_can_be_fed(void) {
    config.inlet_flux_max = BELT_REAL(1.5);
    assert_limits(BELT_SUBSTITUTE_FLUX, BELT_REAL(0), BELT_REAL(1.5));
    config.substitute_flux = BELT_REAL(1.5);
    assert_breaks_nothing_but(BELT_OK);
    config.substitute_flux = real_next(BELT_REAL(1.5), BELT_REAL(2));
    assert_breaks_nothing_but(BELT_SUBSTITUTE_FLUX);
}

static void test_substitute_of_an_actuator_without_limit_is_a_flux_of_a_sound_line(void) {
    /* 10*1.2*1.2*exp(0.6), as in the tests of the gate. */
    const belt_rule_t rule = belt_config_rule(&config, BELT_SUBSTITUTE_FLUX);
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON * 14.4 * exp(0.6), 14.4 * exp(0.6), (double)rule.upper);
    config.inlet_flux_max = real_next(rule.upper, BELT_REAL(0));
    assert_limits(BELT_SUBSTITUTE_FLUX, BELT_REAL(0), config.inlet_flux_max);
    config.inlet_flux_max = real_next(rule.upper, BELT_REAL_MAX);
    assert_limits(BELT_SUBSTITUTE_FLUX, BELT_REAL(0), rule.upper);
}

static void test_none_of_these_rules_is_open(void) {
    for (int code = (int)BELT_ESTIMATOR_KIND; code <= (int)BELT_RULE_LAST; ++code) {
        const belt_rule_t rule = belt_config_rule(&config, (belt_status_t)code);
        TEST_ASSERT_FALSE(rule.lower_open || rule.upper_open);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_everything_may_be_left_zero);
    RUN_TEST(test_default_estimator_time_is_a_share_of_the_empty_lines_dead_time);
    RUN_TEST(test_stated_estimator_time_is_taken_as_it_is);
    RUN_TEST(test_counts_may_have_any_value);
    RUN_TEST(test_estimator_takes_no_less_than_the_time_between_two_samples);
    RUN_TEST(test_default_estimator_time_must_bear_the_time_between_two_samples_too);
    RUN_TEST(test_estimator_that_is_off_may_have_any_time_that_is_a_number);
    RUN_TEST(test_estimator_time_ends_at_a_million_and_is_a_number);
    RUN_TEST(test_limits_of_what_may_be_left_zero);
    RUN_TEST(test_substitute_is_no_more_than_can_be_fed);
    RUN_TEST(test_substitute_of_an_actuator_without_limit_is_a_flux_of_a_sound_line);
    RUN_TEST(test_none_of_these_rules_is_open);
    return UNITY_END();
}
