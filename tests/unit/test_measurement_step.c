/* SPDX-License-Identifier: MIT */
/* Levels that jump: refused, until so many of them agree. */
#include "gate_case.h"

#define AGREEING 3u

void setUp(void) {
    config = paper_case();
    config.recovery_samples = AGREEING;
    begin(); /* a step of 0.25 is believed */
    measurement = (belt_measurement_t){.present = BELT_HAS_LEVEL, .level = BELT_REAL(0.5)};
    (void)step();
}

void tearDown(void) {
}

static uint32_t sample(double level) {
    measurement.level = BELT_REAL(level);
    return step().error_bits;
}

#define REFUSED BELT_ERROR_LEVEL_STEP

static void test_step_of_the_limit_itself_is_believed(void) {
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.75));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.25));
}

static void test_step_a_unit_beyond_the_limit_is_refused(void) {
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample((double)real_next(BELT_REAL(0.75), BELT_REAL(1))));
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.25 - 0.25 * EPSILON)); /* of the difference */
}

static void test_refused_level_is_not_used(void) {
    measurement.level = BELT_REAL(0.875);
    const belt_trusted_t trusted = step();
    TEST_ASSERT_FALSE(trusted.level_is_new);
    TEST_ASSERT_TRUE(trusted.level == BELT_REAL(0.5));
    TEST_ASSERT_EQUAL(BELT_LEVEL_DOUBTED, memory.health);
}

static void test_spike_is_refused_and_forgotten(void) {
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5)); /* and the count begins anew */
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
}

static void test_step_is_believed_once_enough_samples_agree(void) {
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.8125));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.875));
    TEST_ASSERT_TRUE(memory.level == BELT_REAL(0.875));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.5)); /* now this is the step */
}

static void test_samples_agree_within_the_same_limit(void) {
    config.level_capacity = BELT_REAL(4);
    belt_line_init(&line, &config);
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(1.0));
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(1.25)); /* each is compared with the one before it */
    TEST_ASSERT_EQUAL_HEX32(0u, sample(1.5));
}

static void test_sample_that_disagrees_begins_the_count_anew(void) {
    config.level_capacity = BELT_REAL(4);
    belt_line_init(&line, &config);
    (void)sample(1.0);
    (void)sample(1.0);
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(2.0));
    TEST_ASSERT_EQUAL_UINT32(1u, memory.agreeing_samples);
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(2.0));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(2.0));
}

static void test_agreement_a_unit_beyond_the_limit_is_none(void) {
    config.level_capacity = BELT_REAL(4);
    belt_line_init(&line, &config);
    (void)sample(1.0);
    (void)sample((double)real_next(BELT_REAL(1.25), BELT_REAL(2)));
    TEST_ASSERT_EQUAL_UINT32(1u, memory.agreeing_samples);
    (void)sample((double)real_next(BELT_REAL(1), BELT_REAL(0)));
    TEST_ASSERT_EQUAL_UINT32(1u, memory.agreeing_samples);
}

static void test_one_sample_is_enough_where_recovery_takes_one(void) {
    limits.recovery_samples = 1;
    TEST_ASSERT_EQUAL_HEX32(0u, sample(1.0));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.0));
    TEST_ASSERT_EQUAL(BELT_LEVEL_TRUSTED, memory.health);
}

static void test_samples_that_agreed_were_good_ones_after_all(void) {
    (void)sample(0.875);
    (void)sample(0.875);
    TEST_ASSERT_EQUAL(BELT_LEVEL_DOUBTED, memory.health);
    (void)sample(0.875);
    TEST_ASSERT_EQUAL(BELT_LEVEL_TRUSTED, memory.health);
    TEST_ASSERT_EQUAL_UINT32(0u, memory.agreeing_samples);
}

static void test_missing_level_between_them_leaves_the_count_of_those_that_agree(void) {
    (void)sample(0.875);
    measurement.present = 0u;
    (void)step();
    measurement.present = BELT_HAS_LEVEL;
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.875));
}

static void test_out_of_range_near_the_last_is_clamped_and_no_step(void) {
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.75));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_RANGE, sample(1.0625)); /* the raw one is near too */
    TEST_ASSERT_TRUE(memory.level == BELT_REAL(1));
    TEST_ASSERT_EQUAL(BELT_LEVEL_TRUSTED, memory.health);
}

static void test_out_of_range_and_far_from_the_last_is_a_step_besides(void) {
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_RANGE | REFUSED, sample(1.0625));
    TEST_ASSERT_TRUE(memory.level == BELT_REAL(0.5));
    TEST_ASSERT_EQUAL(BELT_LEVEL_DOUBTED, memory.health);
}

static void test_sensor_stuck_far_outside_is_never_believed(void) {
    limits.hold_periods = 50;
    for (int i = 0; i < 100; ++i) {
        measurement.level = BELT_REAL_MAX;
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_INVALID, step().error_bits);
    }
    TEST_ASSERT_EQUAL(BELT_LEVEL_LOST, memory.health);
}

static void test_invalid_sample_between_them_begins_the_count_of_those_that_agree_anew(void) {
    (void)sample(0.875);
    (void)sample(0.875);
    (void)sample(-1.0);
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_UINT32(1u, memory.agreeing_samples);
}

static void test_step_is_said_of_new_samples_only(void) {
    limits.sample_periods = 2;
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT;
    measurement.sample_count = 1u;
    TEST_ASSERT_EQUAL_HEX32(REFUSED, sample(0.875));
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.875)); /* the same one still */
    TEST_ASSERT_EQUAL_UINT32(1u, memory.agreeing_samples);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_step_of_the_limit_itself_is_believed);
    RUN_TEST(test_step_a_unit_beyond_the_limit_is_refused);
    RUN_TEST(test_refused_level_is_not_used);
    RUN_TEST(test_spike_is_refused_and_forgotten);
    RUN_TEST(test_step_is_believed_once_enough_samples_agree);
    RUN_TEST(test_samples_agree_within_the_same_limit);
    RUN_TEST(test_sample_that_disagrees_begins_the_count_anew);
    RUN_TEST(test_agreement_a_unit_beyond_the_limit_is_none);
    RUN_TEST(test_one_sample_is_enough_where_recovery_takes_one);
    RUN_TEST(test_samples_that_agreed_were_good_ones_after_all);
    RUN_TEST(test_missing_level_between_them_leaves_the_count_of_those_that_agree);
    RUN_TEST(test_out_of_range_near_the_last_is_clamped_and_no_step);
    RUN_TEST(test_out_of_range_and_far_from_the_last_is_a_step_besides);
    RUN_TEST(test_sensor_stuck_far_outside_is_never_believed);
    RUN_TEST(test_invalid_sample_between_them_begins_the_count_of_those_that_agree_anew);
    RUN_TEST(test_step_is_said_of_new_samples_only);
    return UNITY_END();
}
