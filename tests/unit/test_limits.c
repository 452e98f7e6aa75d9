/* SPDX-License-Identifier: MIT */
#include "belt/limits.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_limits_t limits;

void setUp(void) {
    config = paper_case();
    belt_limits_init(&limits, &config);
}

void tearDown(void) {
}

static void begin(void) {
    belt_limits_init(&limits, &config);
}

/* --- what is left 0 has its default --- */

static void test_actuator_without_limit_has_that_of_a_sound_line(void) {
    /* 10*1.2 parts/s, 1.2 times slower at most, exp(-0.6) of it left; some ten roundings. */
    const double bound = 14.4 * exp(0.6);
    TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON * bound, bound, (double)limits.inlet_flux_max);
    config.inlet_flux_max = BELT_REAL(30);
    begin();
    TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON * bound, bound, (double)limits.inlet_flux_max);
}

static void test_rate_left_0_is_no_limit(void) {
    TEST_ASSERT_TRUE(limits.flux_step_max == BELT_NO_FLUX_LIMIT);
}

static void test_nothing_is_fed_as_a_substitute(void) {
    TEST_ASSERT_TRUE(limits.substitute_flux == BELT_REAL(0));
}

static void test_level_may_step_by_a_quarter_of_the_capacity(void) {
    TEST_ASSERT_TRUE(limits.level_step_max == BELT_REAL(0.25));
    config.level_capacity = BELT_REAL(200);
    begin();
    TEST_ASSERT_TRUE(limits.level_step_max == BELT_REAL(50));
}

static void test_counts_have_their_defaults(void) {
    TEST_ASSERT_EQUAL_UINT32(1u, limits.sample_periods);
    TEST_ASSERT_EQUAL_UINT32(10u, limits.recovery_samples);
    /* Half of P D = 0.5 s in periods of 0.0025 s. */
    TEST_ASSERT_EQUAL_UINT32(100u, limits.hold_periods);
}

static void test_hold_takes_whole_periods_only(void) {
    config.belt_length = BELT_REAL(2.015); /* 0.503750 s: half of it 100.75 periods */
    begin();
    TEST_ASSERT_EQUAL_UINT32(100u, limits.hold_periods);
}

static void test_bump_goes_over_in_a_quarter_of_the_empty_lines_dead_time(void) {
    /* exp(-0.0025/(0.25*0.5)); exponent and exponential take four roundings. */
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, exp(-0.02), (double)limits.transfer_kept);
}

static void test_tolerances_are_shares_of_the_greatest_nominal_flux(void) {
    TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON * 1.2e-6, 1.2e-6, (double)limits.bump_min);
    TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON * 0.06, 0.06, (double)limits.flux_tolerance);
}

/* --- what is stated counts --- */

static void test_stated_limits_are_kept(void) {
    config.inlet_flux_max = BELT_REAL(2.5);
    config.substitute_flux = BELT_REAL(0.375);
    config.level_step_max = BELT_REAL(0.0625);
    config.sample_periods = 7;
    config.hold_periods = 33;
    config.recovery_samples = 5;
    begin();
    TEST_ASSERT_TRUE(limits.inlet_flux_max == BELT_REAL(2.5));
    TEST_ASSERT_TRUE(limits.substitute_flux == BELT_REAL(0.375));
    TEST_ASSERT_TRUE(limits.level_step_max == BELT_REAL(0.0625));
    TEST_ASSERT_EQUAL_UINT32(7u, limits.sample_periods);
    TEST_ASSERT_EQUAL_UINT32(33u, limits.hold_periods);
    TEST_ASSERT_EQUAL_UINT32(5u, limits.recovery_samples);
}

static void test_counts_of_one_and_of_the_most_are_kept(void) {
    const uint16_t counts[] = {1u, UINT16_MAX};
    for (size_t i = 0; i < 2; ++i) {
        config.sample_periods = counts[i];
        config.hold_periods = counts[i];
        config.recovery_samples = counts[i];
        begin();
        TEST_ASSERT_EQUAL_UINT32(counts[i], limits.sample_periods);
        TEST_ASSERT_EQUAL_UINT32(counts[i], limits.hold_periods);
        TEST_ASSERT_EQUAL_UINT32(counts[i], limits.recovery_samples);
    }
}

static void test_rate_of_the_flux_is_a_step_a_period(void) {
    config.flux_rate_max = BELT_REAL(4);
    config.period = BELT_REAL(0.00390625);
    begin();
    TEST_ASSERT_TRUE(limits.flux_step_max == BELT_REAL(0.015625));
}

static void test_smallest_rate_of_the_flux_is_a_limit_too(void) {
    /* Times the period it rounds to 0: no change at all, and not any change. */
    config.flux_rate_max = real_from_bits(1u);
    begin();
    TEST_ASSERT_TRUE(limits.flux_step_max == BELT_REAL(0));
}

static void test_transfer_time_is_that_of_an_exponential(void) {
    const double times[] = {0.001, 0.0025, 0.1, 3.0, 40.0};
    for (size_t i = 0; i < sizeof times / sizeof times[0]; ++i) {
        config.transfer_time = BELT_REAL(times[i]);
        begin();
        /* Two units of the exponential in [0, 1], a rounding of the sum, two of the exponent. */
        TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, exp(-0.0025 / times[i]),
                                  (double)limits.transfer_kept);
    }
}

static void test_transfer_time_far_below_a_period_leaves_no_bump(void) {
    config.transfer_time = real_from_bits(1u);
    begin();
    TEST_ASSERT_TRUE(limits.transfer_kept == BELT_REAL(0));
    config.transfer_time = BELT_REAL(1e-5);
    begin();
    TEST_ASSERT_TRUE(limits.transfer_kept == BELT_REAL(0));
}

static void test_longest_transfer_time_still_ends(void) {
    /* 4e8 periods: a share that rounds to 1 would keep the bump for ever. */
    config.transfer_time = BELT_REAL(1e6);
    begin();
    TEST_ASSERT_TRUE(limits.transfer_kept < BELT_REAL(1));
    TEST_ASSERT_TRUE(limits.transfer_kept > BELT_REAL(0.999));
}

/* --- stretches --- */

static void test_stretch_is_the_periods_of_one_node_spacing(void) {
    TEST_ASSERT_EQUAL_UINT32(10u, limits.stretch_periods); /* 0.5/20 s */
    config.period = BELT_REAL(0.00251);                    /* 9.96 of them */
    begin();
    TEST_ASSERT_EQUAL_UINT32(9u, limits.stretch_periods);
    config.period = BELT_REAL(0.025);
    begin();
    TEST_ASSERT_EQUAL_UINT32(1u, limits.stretch_periods);
}

static void test_stretch_that_rounding_left_short_of_whole_periods_is_whole(void) {
    for (uint16_t nodes = 4; nodes <= 60; ++nodes) {
        for (unsigned periods = 1; periods <= 40; ++periods) {
            config.node_count = nodes;
            config.period = BELT_REAL(0.5 / ((double)nodes * periods));
            begin();
            TEST_ASSERT_EQUAL_UINT32(periods, limits.stretch_periods);
        }
    }
}

static void test_stretch_never_moves_a_belt_by_more_than_a_spacing(void) {
    for (double period = 0.0005; period <= 0.025; period *= 1.0137) {
        config.period = BELT_REAL(period);
        begin();
        /* At full speed, which no belt exceeds; the hair is 1e-5 and two roundings. */
        const double moved = limits.stretch_periods * (double)config.period / 0.025;
        TEST_ASSERT_TRUE(moved <= 1.0 + 1e-5 + 2 * EPSILON);
        TEST_ASSERT_TRUE(moved + (double)config.period / 0.025 > 1.0 - 2 * EPSILON);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_actuator_without_limit_has_that_of_a_sound_line);
    RUN_TEST(test_rate_left_0_is_no_limit);
    RUN_TEST(test_nothing_is_fed_as_a_substitute);
    RUN_TEST(test_level_may_step_by_a_quarter_of_the_capacity);
    RUN_TEST(test_counts_have_their_defaults);
    RUN_TEST(test_hold_takes_whole_periods_only);
    RUN_TEST(test_bump_goes_over_in_a_quarter_of_the_empty_lines_dead_time);
    RUN_TEST(test_tolerances_are_shares_of_the_greatest_nominal_flux);
    RUN_TEST(test_stated_limits_are_kept);
    RUN_TEST(test_counts_of_one_and_of_the_most_are_kept);
    RUN_TEST(test_rate_of_the_flux_is_a_step_a_period);
    RUN_TEST(test_smallest_rate_of_the_flux_is_a_limit_too);
    RUN_TEST(test_transfer_time_is_that_of_an_exponential);
    RUN_TEST(test_transfer_time_far_below_a_period_leaves_no_bump);
    RUN_TEST(test_longest_transfer_time_still_ends);
    RUN_TEST(test_stretch_is_the_periods_of_one_node_spacing);
    RUN_TEST(test_stretch_that_rounding_left_short_of_whole_periods_is_whole);
    RUN_TEST(test_stretch_never_moves_a_belt_by_more_than_a_spacing);
    return UNITY_END();
}
