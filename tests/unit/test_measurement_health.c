/* SPDX-License-Identifier: MIT */
/* How the level fares from period to period: doubted, lost and back; and its quality. */
#include "gate_level_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- hysteresis --- */

static void test_one_bad_period_is_doubt(void) {
    (void)sample(0.5);
    (void)miss();
    assert_health(BELT_LEVEL_DOUBTED);
}

static void test_level_is_trusted_again_after_so_many_good_samples(void) {
    (void)sample(0.5);
    (void)miss();
    for (uint32_t i = 1; i < RECOVERY; ++i) {
        TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
        assert_health(BELT_LEVEL_DOUBTED);
    }
    (void)sample(0.5);
    assert_health(BELT_LEVEL_TRUSTED);
}

static void test_bad_period_begins_the_count_of_good_samples_anew(void) {
    (void)sample(0.5);
    (void)miss();
    (void)sample(0.5);
    (void)sample(0.5);
    (void)miss();
    (void)sample(0.5);
    (void)sample(0.5);
    assert_health(BELT_LEVEL_DOUBTED);
    (void)sample(0.5);
    assert_health(BELT_LEVEL_TRUSTED);
}

static void test_level_is_lost_when_the_hold_is_over(void) {
    (void)sample(0.5);
    for (uint32_t i = 1; i <= HOLD; ++i) {
        (void)miss();
        assert_health(BELT_LEVEL_DOUBTED);
    }
    (void)miss();
    assert_health(BELT_LEVEL_LOST);
}

static void test_good_sample_begins_the_hold_anew(void) {
    (void)sample(0.5);
    for (int turn = 0; turn < 10; ++turn) {
        for (uint32_t i = 1; i <= HOLD; ++i) {
            (void)miss();
        }
        (void)sample(0.5);
        assert_health(BELT_LEVEL_DOUBTED);
    }
}

static void lose(void) {
    (void)sample(0.5);
    for (uint32_t i = 0; i <= HOLD; ++i) {
        (void)miss();
    }
}

static void test_lost_level_is_lost_until_it_is_trusted(void) {
    lose();
    for (uint32_t i = 1; i < RECOVERY; ++i) {
        (void)sample(0.5);
        assert_health(BELT_LEVEL_LOST);
    }
    (void)sample(0.5);
    assert_health(BELT_LEVEL_TRUSTED);
}

static void test_lost_level_stays_lost_after_too_few_good_samples(void) {
    lose();
    (void)sample(0.5);
    (void)miss();
    assert_health(BELT_LEVEL_LOST);
}

static void test_counts_stop_where_they_make_no_difference(void) {
    for (int i = 0; i < 1000; ++i) {
        (void)miss();
    }
    TEST_ASSERT_EQUAL_UINT32(HOLD + 1u, memory.bad_periods);
    for (int i = 0; i < 1000; ++i) {
        (void)sample(0.5);
    }
    TEST_ASSERT_EQUAL_UINT32(RECOVERY, memory.good_samples);
}

static void test_longest_hold_and_recovery_are_counted_out(void) {
    limits.hold_periods = UINT16_MAX;
    limits.recovery_samples = UINT16_MAX;
    (void)sample(0.5);
    for (uint32_t i = 0; i < UINT16_MAX; ++i) {
        (void)miss();
    }
    assert_health(BELT_LEVEL_DOUBTED);
    (void)miss();
    assert_health(BELT_LEVEL_LOST);
    for (uint32_t i = 1; i < UINT16_MAX; ++i) {
        (void)sample(0.5);
    }
    assert_health(BELT_LEVEL_LOST);
    (void)sample(0.5);
    assert_health(BELT_LEVEL_TRUSTED);
}

/* --- quality --- */

static void test_quality_forgets_by_a_hundredth_a_sample(void) {
    TEST_ASSERT_TRUE(memory.level_quality == BELT_REAL(1));
    double quality = 1.0;
    for (int i = 0; i < 500; ++i) {
        (void)miss();
        quality *= 0.99;
        /* A rounding a sample, of which a hundredth is forgotten with each. */
        TEST_ASSERT_DOUBLE_WITHIN(100 * EPSILON, quality, (double)memory.level_quality);
    }
    for (int i = 0; i < 500; ++i) {
        (void)sample(0.5);
        quality = 1.0 - 0.99 * (1.0 - quality);
        TEST_ASSERT_DOUBLE_WITHIN(100 * EPSILON, quality, (double)memory.level_quality);
    }
}

static void test_quality_stays_a_share(void) {
    for (int turn = 0; turn < 2; ++turn) {
        for (int i = 0; i < 20000; ++i) {
            (void)((turn == 0) ? miss() : sample(0.5));
            TEST_ASSERT_TRUE((memory.level_quality >= BELT_REAL(0)) &&
                             (memory.level_quality <= BELT_REAL(1)));
        }
    }
}

static void test_quality_that_is_no_number_is_a_share_again(void) {
    memory.level_quality = BELT_REAL(NAN);
    (void)sample(0.5);
    TEST_ASSERT_TRUE(memory.level_quality == BELT_REAL(0));
    memory.level_quality = BELT_REAL(7);
    (void)sample(0.5);
    TEST_ASSERT_TRUE(memory.level_quality == BELT_REAL(1));
}

static void test_refused_and_stale_samples_count_against_the_quality(void) {
    const double once = 0.99;
    (void)sample(0.5);
    (void)step(); /* stale */
    TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON, once, (double)memory.level_quality);
    (void)sample(0.9); /* a step */
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, once * once, (double)memory.level_quality);
    (void)sample((double)NAN);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON, once * once * once, (double)memory.level_quality);
    assert_level(0.5);
}

/* --- a level that comes with gaps --- */

static void test_lost_level_that_comes_with_gaps_is_doubted_and_no_longer_lost(void) {
    (void)sample(0.5);
    for (unsigned i = 0; i <= HOLD; ++i) {
        (void)miss();
    }
    assert_health(BELT_LEVEL_LOST);
    for (unsigned i = 1; i < RECOVERY; ++i) { /* one good, one missing: never two in a row */
        (void)sample(0.5);
        (void)miss();
        assert_health(BELT_LEVEL_LOST);
    }
    (void)sample(0.5);
    assert_health(BELT_LEVEL_DOUBTED);
    (void)miss();
    assert_health(BELT_LEVEL_DOUBTED);
}

static void test_gap_longer_than_the_hold_loses_what_was_found(void) {
    (void)sample(0.5);
    for (unsigned i = 0; i <= HOLD; ++i) {
        (void)miss();
    }
    for (unsigned i = 1; i < RECOVERY; ++i) {
        (void)sample(0.5);
        (void)miss();
    }
    for (unsigned i = 0; i < HOLD; ++i) {
        (void)miss();
    }
    TEST_ASSERT_EQUAL_UINT32(0u, memory.found_samples);
    (void)sample(0.5);
    assert_health(BELT_LEVEL_LOST);
}

static void test_first_level_is_trusted_however_long_it_was_waited_for(void) {
    for (unsigned i = 0; i < 10u * HOLD; ++i) {
        (void)miss();
    }
    assert_health(BELT_LEVEL_LOST);
    TEST_ASSERT_EQUAL_HEX32(0u, sample(0.5));
    assert_health(BELT_LEVEL_TRUSTED);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_one_bad_period_is_doubt);
    RUN_TEST(test_level_is_trusted_again_after_so_many_good_samples);
    RUN_TEST(test_bad_period_begins_the_count_of_good_samples_anew);
    RUN_TEST(test_level_is_lost_when_the_hold_is_over);
    RUN_TEST(test_good_sample_begins_the_hold_anew);
    RUN_TEST(test_lost_level_is_lost_until_it_is_trusted);
    RUN_TEST(test_lost_level_stays_lost_after_too_few_good_samples);
    RUN_TEST(test_counts_stop_where_they_make_no_difference);
    RUN_TEST(test_longest_hold_and_recovery_are_counted_out);
    RUN_TEST(test_quality_forgets_by_a_hundredth_a_sample);
    RUN_TEST(test_quality_stays_a_share);
    RUN_TEST(test_quality_that_is_no_number_is_a_share_again);
    RUN_TEST(test_refused_and_stale_samples_count_against_the_quality);
    RUN_TEST(test_lost_level_that_comes_with_gaps_is_doubted_and_no_longer_lost);
    RUN_TEST(test_gap_longer_than_the_hold_loses_what_was_found);
    RUN_TEST(test_first_level_is_trusted_however_long_it_was_waited_for);
    return UNITY_END();
}
