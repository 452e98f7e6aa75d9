/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/* --- error bits add up, each says its own --- */

static void assert_bits(uint32_t bits, belt_status_t expected, belt_status_t found) {
    TEST_ASSERT_EQUAL_HEX32(bits, command.error_bits);
    TEST_ASSERT_EQUAL(expected, found);
}

static void test_each_fault_has_its_bit(void) {
    steps_level(0.2, 20u);
    assert_bits(BELT_ERROR_LEVEL_MISSING, BELT_INPUT_REJECTED, step_blind());
    assert_bits(BELT_ERROR_LEVEL_INVALID, BELT_INPUT_REJECTED, step_level(NAN));
    assert_bits(BELT_ERROR_LEVEL_RANGE, BELT_INPUT_REJECTED, step_level(-0.0001));
    assert_bits(BELT_ERROR_LEVEL_STEP, BELT_INPUT_REJECTED, step_level(0.6));
    assert_bits(BELT_ERROR_LEVEL_STEP | BELT_ERROR_LEVEL_RANGE, BELT_INPUT_REJECTED,
                step_level(1.05));
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT;
    measurement.sample_count = 1u;
    assert_bits(0u, BELT_OK, step_level(0.25));
    assert_bits(BELT_ERROR_LEVEL_STALE, BELT_INPUT_REJECTED, step_level(0.25));
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX;
    measurement.applied_flux = BELT_REAL(-1);
    assert_bits(BELT_ERROR_APPLIED_FLUX_INVALID, BELT_INPUT_REJECTED, step_level(0.25));
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_DENSITY;
    measurement.density = NULL;
    assert_bits(BELT_ERROR_DENSITY_INVALID, BELT_INPUT_REJECTED, step_level(0.25));
}

static void test_bits_of_several_faults_add_up(void) {
    steps_level(0.25, 20u);
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX | BELT_HAS_OUTLET_FLUX |
                          BELT_HAS_DENSITY | BELT_HAS_ELAPSED_TICKS;
    measurement.applied_flux = BELT_REAL(NAN);
    measurement.outlet_flux = BELT_REAL(INFINITY);
    measurement.elapsed_ticks = 5u;
    assert_bits(BELT_ERROR_LEVEL_INVALID | BELT_ERROR_APPLIED_FLUX_INVALID |
                    BELT_ERROR_OUTLET_FLUX_INVALID | BELT_ERROR_DENSITY_INVALID |
                    BELT_ERROR_PERIODS_LATE,
                BELT_INPUT_REJECTED, step_level(NAN));
}

static void test_bits_are_of_this_step_alone(void) {
    steps_level(0.25, 20u);
    (void)step_level(NAN);
    assert_bits(0u, BELT_OK, step_level(0.25));
}

/* --- statuses by priority --- */

static void feed_other_than_told(double applied) {
    measurement.present |= BELT_HAS_APPLIED_FLUX;
    measurement.applied_flux = BELT_REAL(applied);
}

static void test_valve_that_does_not_follow_is_said_after_five_periods(void) {
    (void)begin_at_rest();
    feed_other_than_told(0.0);
    for (unsigned i = 1; i < BELT_MISMATCH_PERIODS; ++i) {
        assert_bits(0u, BELT_OK, step_level(0.3));
    }
    assert_bits(BELT_ERROR_FLUX_MISMATCH, BELT_LINE_DEVIATES, step_level(0.3));
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
    feed_other_than_told(flux());
    assert_bits(0u, BELT_OK, step_level(0.3));
}

static void test_disturbance_at_its_limit_is_said(void) {
    config.estimator = BELT_ESTIMATOR_ON;
    config.estimator_time = BELT_REAL(0.02);
    config.level_step_max = BELT_REAL(1);
    start();
    (void)step_level(0.3);
    /* The limit is the greatest service and the greatest inflow, 1.4 parts/s; a buffer that is full
     * and empty eight times a second has some 1/0.02. */
    feed_other_than_told(0.0);
    uint32_t seen = 0;
    for (int i = 0; i < 4000; ++i) {
        (void)step_level((i % 100 < 50) ? 1.0 : 0.0);
        seen |= command.error_bits;
    }
    TEST_ASSERT_TRUE((seen & BELT_ERROR_DISTURBANCE_LIMIT) != 0u);
}

static void test_an_input_outranks_a_late_step_and_that_a_deviating_line(void) {
    (void)begin_at_rest();
    feed_other_than_told(0.0);
    steps_level(0.3, BELT_MISMATCH_PERIODS);
    measurement.present |= BELT_HAS_ELAPSED_TICKS;
    measurement.elapsed_ticks = 2u;
    assert_bits(BELT_ERROR_FLUX_MISMATCH | BELT_ERROR_PERIODS_LATE, BELT_PERIODS_MISSED,
                step_level(0.3));
    assert_bits(BELT_ERROR_FLUX_MISMATCH | BELT_ERROR_PERIODS_LATE | BELT_ERROR_LEVEL_INVALID,
                BELT_INPUT_REJECTED, step_level(NAN));
}

static void test_no_level_outranks_what_else_is_wrong(void) {
    measurement.present |= BELT_HAS_ELAPSED_TICKS;
    measurement.elapsed_ticks = 2u;
    assert_bits(BELT_ERROR_LEVEL_INVALID | BELT_ERROR_PERIODS_LATE, BELT_NO_LEVEL, step_level(NAN));
    assert_nothing_is_fed();
}

/* --- what stands in for the level --- */

static void test_without_estimator_the_last_good_level_stands_in(void) {
    steps_level(0.25, 20u);
    (void)step_level(0.26);
    for (int i = 0; i < 50; ++i) {
        (void)step_blind();
        TEST_ASSERT_TRUE(controller.model.present.level == BELT_REAL(0.26));
    }
}

static void test_with_estimator_the_model_goes_on(void) {
    config.estimator = BELT_ESTIMATOR_ON;
    start();
    (void)begin_at_rest();
    ask(BELT_MODE_OFF);
    steps_level(0.3, 3u);
    /* The belt holds one dead time, 212 periods, of inflow; then the buffer empties, e-fold in 1 s. */
    steps_blind(212u);
    const double level = (double)controller.model.present.level;
    /* Half the level of material on 20 cells at most is off by a cell. */
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.3, level);
    steps_blind(400u);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.3 * exp(-1.0), (double)controller.model.present.level);
}

static void test_level_beyond_the_ends_counts_as_the_nearer_end(void) {
    steps_level(0.05, 20u);
    (void)step_level(-0.1);
    TEST_ASSERT_TRUE(controller.model.present.level == BELT_REAL(0));
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
}

static void test_level_that_stays_elsewhere_is_believed_after_ten_samples(void) {
    steps_level(0.1, 20u);
    for (int i = 1; i < 10; ++i) {
        assert_bits(BELT_ERROR_LEVEL_STEP, BELT_INPUT_REJECTED, step_level(0.5));
        TEST_ASSERT_TRUE(controller.model.present.level == BELT_REAL(0.1));
    }
    assert_bits(0u, BELT_OK, step_level(0.5));
    TEST_ASSERT_TRUE(controller.model.present.level == BELT_REAL(0.5));
}

static void test_sample_every_fifth_period_is_no_stale_one(void) {
    config.sample_periods = 5;
    start();
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT;
    for (uint32_t i = 0; i < 500u; ++i) {
        measurement.sample_count = UINT32_MAX - 20u + i / 5u; /* wraps */
        assert_bits(0u, BELT_OK, step_level(0.25));
        TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
    }
    for (int i = 1; i < 5; ++i) {
        (void)step_level(0.25);
    }
    assert_bits(BELT_ERROR_LEVEL_STALE, BELT_INPUT_REJECTED, step_level(0.25));
}

static void test_constant_level_with_new_samples_is_no_stale_one(void) {
    (void)begin_at_rest();
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT;
    for (uint32_t i = 1; i < 5000u; ++i) {
        measurement.sample_count = i;
        assert_bits(0u, BELT_OK, step_level(0.3));
    }
}

static void test_quality_is_the_share_of_good_samples(void) {
    steps_level(0.25, 20u);
    TEST_ASSERT_TRUE(controller.gate.level_quality == BELT_REAL(1));
    for (int i = 0; i < 2000; ++i) {
        (void)((i % 4 == 0) ? step_blind() : step_level(0.25));
    }
    /* The last 100 or so weigh 0.01 each: the ripple of one in four is below 0.01. */
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.75, (double)controller.gate.level_quality);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_each_fault_has_its_bit);
    RUN_TEST(test_bits_of_several_faults_add_up);
    RUN_TEST(test_bits_are_of_this_step_alone);
    RUN_TEST(test_valve_that_does_not_follow_is_said_after_five_periods);
    RUN_TEST(test_disturbance_at_its_limit_is_said);
    RUN_TEST(test_an_input_outranks_a_late_step_and_that_a_deviating_line);
    RUN_TEST(test_no_level_outranks_what_else_is_wrong);
    RUN_TEST(test_without_estimator_the_last_good_level_stands_in);
    RUN_TEST(test_with_estimator_the_model_goes_on);
    RUN_TEST(test_level_beyond_the_ends_counts_as_the_nearer_end);
    RUN_TEST(test_level_that_stays_elsewhere_is_believed_after_ten_samples);
    RUN_TEST(test_sample_every_fifth_period_is_no_stale_one);
    RUN_TEST(test_constant_level_with_new_samples_is_no_stale_one);
    RUN_TEST(test_quality_is_the_share_of_good_samples);
    return UNITY_END();
}
