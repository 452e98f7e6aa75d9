/* SPDX-License-Identifier: MIT */
/* Periods that come late, twice or not at all; a valve that does not do what it is told. */
#include "gate_case.h"

void setUp(void) {
    begin_with_all_inputs();
}

void tearDown(void) {
}

static void assert_periods(uint32_t elapsed, uint32_t periods, uint32_t error_bits) {
    const belt_trusted_t trusted = step_after(elapsed);
    TEST_ASSERT_EQUAL_UINT32(periods, trusted.periods);
    TEST_ASSERT_EQUAL_HEX32(error_bits, trusted.error_bits);
}

/* --- elapsed ticks --- */

static void test_periods_are_those_elapsed_up_to_the_cap(void) {
    assert_periods(1u, 1u, 0u);
    assert_periods(2u, 2u, BELT_ERROR_PERIODS_LATE);
    assert_periods(3u, 3u, BELT_ERROR_PERIODS_LATE);
    assert_periods(CAP - 1u, CAP - 1u, BELT_ERROR_PERIODS_LATE);
    assert_periods(CAP, CAP, BELT_ERROR_PERIODS_LATE);
    assert_periods(CAP + 1u, CAP, BELT_ERROR_PERIODS_LOST);
    assert_periods(0x80000000u, CAP, BELT_ERROR_PERIODS_LOST);
    assert_periods(UINT32_MAX, CAP, BELT_ERROR_PERIODS_LOST);
    assert_periods(0u, 0u, BELT_ERROR_PERIOD_REPEATED);
    assert_periods(1u, 1u, 0u);
}

static void test_without_ticks_every_step_is_on_time(void) {
    measurement.present = ALL_PRESENT & ~BELT_HAS_ELAPSED_TICKS;
    assert_periods(0u, 1u, 0u);
    assert_periods(77u, 1u, 0u);
}

static void test_late_steps_do_not_touch_the_level(void) {
    const belt_trusted_t trusted = step_after(CAP);
    TEST_ASSERT_TRUE(trusted.level_is_new);
    TEST_ASSERT_EQUAL(BELT_LEVEL_TRUSTED, memory.health);
}

static void test_lost_periods_doubt_the_level_though_it_is_new(void) {
    const belt_trusted_t trusted = step_after(CAP + 1u);
    TEST_ASSERT_TRUE(trusted.level_is_new);
    TEST_ASSERT_TRUE(trusted.level == BELT_REAL(0.5));
    TEST_ASSERT_EQUAL(BELT_LEVEL_DOUBTED, memory.health);
    TEST_ASSERT_EQUAL_UINT32(0u, memory.good_samples);
    TEST_ASSERT_EQUAL_UINT32(1u, memory.bad_periods);
}

static void test_repeated_step_needs_no_new_sample(void) {
    (void)step_after(1u);
    measurement.elapsed_ticks = 0u;
    for (int i = 0; i < 100; ++i) {
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIOD_REPEATED, step().error_bits);
        TEST_ASSERT_EQUAL(BELT_LEVEL_TRUSTED, memory.health);
    }
}

static void test_late_step_ages_the_sample_by_all_its_periods(void) {
    limits.sample_periods = 3;
    (void)step_after(1u);
    measurement.elapsed_ticks = 2u;
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIODS_LATE, step().error_bits);
    measurement.elapsed_ticks = 1u;
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_STALE, step().error_bits);
}

static void test_hold_is_over_after_so_many_periods_however_late_the_steps(void) {
    limits.hold_periods = 20;
    measurement.present = ALL_PRESENT & ~BELT_HAS_LEVEL;
    for (int i = 0; i < 4; ++i) {
        (void)step_after(5u);
        TEST_ASSERT_EQUAL(BELT_LEVEL_DOUBTED, memory.health);
    }
    (void)step_after(1u);
    TEST_ASSERT_EQUAL(BELT_LEVEL_LOST, memory.health);
}

static void test_counts_stop_where_they_make_no_difference_however_late_the_steps(void) {
    limits.hold_periods = 20;
    measurement.present = ALL_PRESENT & ~BELT_HAS_LEVEL;
    (void)step_after(15u);
    TEST_ASSERT_EQUAL_UINT32(15u, memory.bad_periods);
    (void)step_after(15u);
    TEST_ASSERT_EQUAL_UINT32(21u, memory.bad_periods);
    (void)step_after(CAP);
    TEST_ASSERT_EQUAL_UINT32(21u, memory.bad_periods);
    limits.sample_periods = 30;
    measurement.present = ALL_PRESENT;
    (void)step_after(1u);
    measurement.elapsed_ticks = CAP;
    (void)step();
    TEST_ASSERT_EQUAL_UINT32(30u, memory.sample_age);
}

static void test_count_that_a_flipped_bit_made_too_great_is_brought_back(void) {
    memory.bad_periods = UINT32_MAX;
    memory.mismatch_periods = UINT32_MAX;
    measurement.present = ALL_PRESENT & ~BELT_HAS_LEVEL;
    measurement.applied_flux = BELT_REAL(0.25);
    (void)step_after(1u);
    TEST_ASSERT_EQUAL_UINT32(limits.hold_periods + 1u, memory.bad_periods);
    TEST_ASSERT_EQUAL_UINT32(5u, memory.mismatch_periods);
    TEST_ASSERT_EQUAL(BELT_LEVEL_LOST, memory.health);
}

/* --- owed periods --- */

static void test_owed_periods_are_made_up_for_once(void) {
    memory.owed_periods = 5u;
    assert_periods(1u, 6u, BELT_ERROR_PERIODS_LATE);
    TEST_ASSERT_EQUAL_UINT32(0u, memory.owed_periods);
    assert_periods(1u, 1u, 0u);
}

static void test_repeated_step_owes_on(void) {
    memory.owed_periods = 5u;
    assert_periods(0u, 0u, BELT_ERROR_PERIOD_REPEATED);
    TEST_ASSERT_EQUAL_UINT32(5u, memory.owed_periods);
    assert_periods(1u, 6u, BELT_ERROR_PERIODS_LATE);
}

static void test_elapsed_and_owed_periods_add_up_to_the_cap(void) {
    for (uint32_t elapsed = 1; elapsed <= CAP + 2u; ++elapsed) {
        for (uint32_t owed = 0; owed <= CAP + 2u; ++owed) {
            const uint32_t sum = elapsed + owed;
            memory.owed_periods = owed;
            assert_periods(elapsed, (sum < CAP) ? sum : CAP,
                           (sum > CAP)   ? BELT_ERROR_PERIODS_LOST
                           : (sum == 1u) ? 0u
                                         : BELT_ERROR_PERIODS_LATE);
        }
    }
}

static void test_sum_of_elapsed_and_owed_periods_does_not_overflow(void) {
    const uint32_t most[] = {1u, CAP, CAP + 1u, UINT32_MAX};
    for (size_t i = 0; i < COUNT(most); ++i) {
        memory.owed_periods = UINT32_MAX;
        assert_periods(most[i], CAP, BELT_ERROR_PERIODS_LOST);
        TEST_ASSERT_EQUAL_UINT32(0u, memory.owed_periods);
    }
}

/* --- the valve --- */

/** A period in which `applied` is fed; whether a mismatch is said. */
static bool mismatches(double applied) {
    measurement.applied_flux = BELT_REAL(applied);
    const belt_trusted_t trusted = step_after(1u);
    TEST_ASSERT_EQUAL_HEX32(0u, trusted.error_bits & ~BELT_ERROR_FLUX_MISMATCH);
    TEST_ASSERT_TRUE(trusted.applied_flux == measurement.applied_flux);
    return (trusted.error_bits & BELT_ERROR_FLUX_MISMATCH) != 0u;
}

static void test_mismatch_is_said_from_the_fifth_period_on(void) {
    for (int i = 1; i <= 4; ++i) {
        TEST_ASSERT_FALSE(mismatches(0.25));
    }
    for (int i = 0; i < 1000; ++i) {
        TEST_ASSERT_TRUE(mismatches(0.25));
    }
    TEST_ASSERT_EQUAL_UINT32(5u, memory.mismatch_periods);
    TEST_ASSERT_FALSE(mismatches(0.75));
    for (int i = 1; i <= 4; ++i) {
        TEST_ASSERT_FALSE(mismatches(0.25));
    }
    TEST_ASSERT_TRUE(mismatches(0.25));
}

static void test_mismatch_is_one_beyond_the_tolerance_to_either_side(void) {
    memory.mismatch_periods = 5u;
    TEST_ASSERT_FALSE(mismatches(0.875));
    memory.mismatch_periods = 5u;
    TEST_ASSERT_FALSE(mismatches(0.625));
    memory.mismatch_periods = 5u;
    TEST_ASSERT_TRUE(mismatches((double)real_next(BELT_REAL(0.875), BELT_REAL(1))));
    memory.mismatch_periods = 5u;
    TEST_ASSERT_TRUE(mismatches((double)real_next(BELT_REAL(0.625), BELT_REAL(0))));
}

static void test_period_without_an_applied_flux_begins_the_count_anew(void) {
    memory.mismatch_periods = 4u;
    measurement.present = ALL_PRESENT & ~BELT_HAS_APPLIED_FLUX;
    TEST_ASSERT_EQUAL_HEX32(0u, step_after(1u).error_bits);
    TEST_ASSERT_EQUAL_UINT32(0u, memory.mismatch_periods);
}

static void test_senseless_applied_flux_neither_counts_nor_ends_the_count(void) {
    memory.mismatch_periods = 4u;
    measurement.applied_flux = BELT_REAL(NAN);
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_APPLIED_FLUX_INVALID, step_after(1u).error_bits);
    TEST_ASSERT_EQUAL_UINT32(4u, memory.mismatch_periods);
    TEST_ASSERT_TRUE(mismatches(0.25));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_periods_are_those_elapsed_up_to_the_cap);
    RUN_TEST(test_without_ticks_every_step_is_on_time);
    RUN_TEST(test_late_steps_do_not_touch_the_level);
    RUN_TEST(test_lost_periods_doubt_the_level_though_it_is_new);
    RUN_TEST(test_repeated_step_needs_no_new_sample);
    RUN_TEST(test_late_step_ages_the_sample_by_all_its_periods);
    RUN_TEST(test_hold_is_over_after_so_many_periods_however_late_the_steps);
    RUN_TEST(test_counts_stop_where_they_make_no_difference_however_late_the_steps);
    RUN_TEST(test_count_that_a_flipped_bit_made_too_great_is_brought_back);
    RUN_TEST(test_owed_periods_are_made_up_for_once);
    RUN_TEST(test_repeated_step_owes_on);
    RUN_TEST(test_elapsed_and_owed_periods_add_up_to_the_cap);
    RUN_TEST(test_sum_of_elapsed_and_owed_periods_does_not_overflow);
    RUN_TEST(test_mismatch_is_said_from_the_fifth_period_on);
    RUN_TEST(test_mismatch_is_one_beyond_the_tolerance_to_either_side);
    RUN_TEST(test_period_without_an_applied_flux_begins_the_count_anew);
    RUN_TEST(test_senseless_applied_flux_neither_counts_nor_ends_the_count);
    return UNITY_END();
}
