/* SPDX-License-Identifier: MIT */
/* How the level begins, and when it is stale. */
#include "gate_level_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- the beginning --- */

static void test_before_the_first_sample_nothing_is_known_and_nothing_wrong(void) {
    const belt_gate_t before = {.level_quality = BELT_REAL(1), .good_samples = RECOVERY};
    memset(&memory, 0xA5, sizeof memory);
    belt_measurement_init(&memory, &limits);
    TEST_ASSERT_TRUE(memory.level == before.level);
    TEST_ASSERT_TRUE(memory.level_elsewhere == before.level_elsewhere);
    TEST_ASSERT_TRUE(memory.level_quality == before.level_quality);
    const uint32_t counts[] = {memory.sample_count,    memory.sample_age,       memory.owed_periods,
                               memory.bad_periods,     memory.agreeing_samples, memory.has_level,
                               memory.mismatch_periods};
    for (size_t i = 0; i < COUNT(counts); ++i) {
        TEST_ASSERT_EQUAL_UINT32(0u, counts[i]);
    }
    TEST_ASSERT_EQUAL_UINT32(RECOVERY, memory.good_samples);
    assert_health(BELT_LEVEL_TRUSTED);
}

static void test_first_level_is_believed_wherever_it_is(void) {
    const double levels[] = {0.0, 0.25, 0.26, 0.99, 1.0};
    for (size_t i = 0; i < COUNT(levels); ++i) {
        begin();
        TEST_ASSERT_EQUAL_HEX32(0u, sample(levels[i]));
        assert_health(BELT_LEVEL_TRUSTED);
        TEST_ASSERT_EQUAL_UINT32(1u, memory.has_level);
        TEST_ASSERT_TRUE(memory.level == BELT_REAL(levels[i]));
    }
}

static void test_first_level_may_carry_any_count(void) {
    measurement.sample_count = UINT32_MAX; /* one more is 0, what the gate begins with */
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
    TEST_ASSERT_EQUAL_UINT32(1u, memory.has_level);
}

static void test_level_that_never_comes_is_lost_and_was_never_had(void) {
    for (uint32_t i = 0; i < 2u * HOLD; ++i) {
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_MISSING, miss());
    }
    assert_health(BELT_LEVEL_LOST);
    TEST_ASSERT_EQUAL_UINT32(0u, memory.has_level);
}

/* --- stale --- */

static void test_constant_level_with_new_samples_is_not_stale(void) {
    for (int i = 0; i < 100000; ++i) {
        TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
    }
    assert_health(BELT_LEVEL_TRUSTED);
}

static void test_same_count_is_stale_at_once_and_the_last_level_stands_in(void) {
    (void)sample(0.5);
    measurement.level = BELT_REAL(0.625);
    for (int i = 0; i < 3; ++i) {
        const belt_trusted_t trusted = step();
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_STALE, trusted.error_bits);
        TEST_ASSERT_FALSE(trusted.level_is_new);
        TEST_ASSERT_TRUE(trusted.level == BELT_REAL(0.5));
        assert_health(BELT_LEVEL_DOUBTED);
    }
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.625));
}

static void test_any_other_count_is_a_new_sample(void) {
    const uint32_t counts[] = {UINT32_MAX - 1u, UINT32_MAX, 0u, 1u, 0x80000000u, 7u, 6u};
    (void)sample(0.5);
    for (size_t i = 0; i < COUNT(counts); ++i) {
        measurement.sample_count = counts[i];
        TEST_ASSERT_EQUAL_HEX32(0u, step().error_bits);
    }
}

static void test_without_a_count_every_level_is_new(void) {
    measurement.present = BELT_HAS_LEVEL;
    for (int i = 0; i < 100; ++i) {
        const belt_trusted_t trusted = step();
        TEST_ASSERT_EQUAL_HEX32(0u, trusted.error_bits);
        TEST_ASSERT_TRUE(trusted.level_is_new);
    }
}

static void test_count_that_is_not_present_is_not_read(void) {
    (void)sample(0.5);
    measurement.present = BELT_HAS_LEVEL;
    measurement.sample_count += 1u; /* whatever stands there */
    (void)step();
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT;
    TEST_ASSERT_EQUAL_HEX32(0u, step().error_bits);
}

static void test_between_two_samples_nothing_is_wrong_and_nothing_is_new(void) {
    limits.sample_periods = 3;
    for (int i = 0; i < 300; ++i) {
        TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
        TEST_ASSERT_EQUAL_UINT32(0u, memory.sample_age);
        for (uint32_t age = 1; age <= 2u; ++age) {
            const belt_trusted_t trusted = step();
            TEST_ASSERT_EQUAL_HEX32(0u, trusted.error_bits);
            TEST_ASSERT_FALSE(trusted.level_is_new);
            TEST_ASSERT_EQUAL_UINT32(age, memory.sample_age);
        }
    }
    TEST_ASSERT_TRUE(memory.level_quality == BELT_REAL(1));
    assert_health(BELT_LEVEL_TRUSTED);
}

static void test_sample_that_is_a_period_late_is_stale_in_that_period(void) {
    limits.sample_periods = 3;
    (void)sample(0.5);
    (void)step();
    TEST_ASSERT_EQUAL_HEX32(0u, step().error_bits);
    for (int i = 0; i < 1000; ++i) {
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_STALE, step().error_bits);
        TEST_ASSERT_EQUAL_UINT32(3u, memory.sample_age);
    }
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
    TEST_ASSERT_EQUAL_HEX32(0u, step().error_bits);
}

static void test_periods_between_two_samples_neither_recover_nor_doubt(void) {
    limits.sample_periods = 3;
    (void)sample(0.5);
    (void)sample(-1.0);
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
    (void)step();
    TEST_ASSERT_EQUAL_HEX32(0u, miss()); /* none shown, and none due */
    TEST_ASSERT_EQUAL_UINT32(1u, memory.good_samples);
    TEST_ASSERT_EQUAL_UINT32(0u, memory.bad_periods);
    assert_health(BELT_LEVEL_DOUBTED);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_before_the_first_sample_nothing_is_known_and_nothing_wrong);
    RUN_TEST(test_first_level_is_believed_wherever_it_is);
    RUN_TEST(test_first_level_may_carry_any_count);
    RUN_TEST(test_level_that_never_comes_is_lost_and_was_never_had);
    RUN_TEST(test_constant_level_with_new_samples_is_not_stale);
    RUN_TEST(test_same_count_is_stale_at_once_and_the_last_level_stands_in);
    RUN_TEST(test_any_other_count_is_a_new_sample);
    RUN_TEST(test_without_a_count_every_level_is_new);
    RUN_TEST(test_count_that_is_not_present_is_not_read);
    RUN_TEST(test_between_two_samples_nothing_is_wrong_and_nothing_is_new);
    RUN_TEST(test_sample_that_is_a_period_late_is_stale_in_that_period);
    RUN_TEST(test_periods_between_two_samples_neither_recover_nor_doubt);
    return UNITY_END();
}
