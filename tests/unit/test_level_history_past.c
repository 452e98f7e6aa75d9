/* SPDX-License-Identifier: MIT */
/* The sum, the look-back and the first level. */
#include "level_history_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- the sum --- */

static void test_sum_after_a_million_pushes_is_that_of_a_fresh_history(void) {
    static belt_level_history_t fresh;
    uint64_t random = 20240607u;
    belt_level_history_init(&fresh, &config);
    for (unsigned i = 0; i < 1000000u; ++i) {
        const belt_real_t level = random_share(&random);
        belt_level_history_push(&history, level);
        if (i >= 1000000u - 82u) { /* all that the fresh one can hold */
            belt_level_history_push(&fresh, level);
        }
    }
    TEST_ASSERT_TRUE(history.window_sum == fresh.window_sum);
    TEST_ASSERT_TRUE(belt_level_history_congestion(&history) ==
                     belt_level_history_congestion(&fresh));
}

static void test_sum_is_that_of_the_levels_in_the_window(void) {
    uint64_t random = 5u;
    for (unsigned i = 0; i < 1000u; ++i) {
        belt_level_history_push(&history, random_share(&random));
        belt_quanta_t sum = 0;
        for (uint32_t age = 0; age <= history.whole; ++age) {
            sum += history.level[belt_level_history_index(&history, age)];
        }
        TEST_ASSERT_TRUE(history.window_sum == sum);
    }
}

/* --- look-back --- */

static void test_look_back_finds_every_level_of_the_window(void) {
    for (unsigned turn = 0; turn < 200u; ++turn) { /* wherever the ring begins */
        push_ramp(0.9, 0.008, 81);
        for (int age = 0; age <= 80; ++age) {
            /* Half a quantum, and a rounding of 1. */
            TEST_ASSERT_DOUBLE_WITHIN(half_quantum() + EPSILON, 0.9 - 0.008 * age, level_at(age));
        }
        belt_level_history_push(&history, BELT_REAL(0));
    }
}

static void test_look_back_is_linear_between_periods(void) {
    push_ramp(0.9, 0.008, 82);
    for (double age = 0.0; age < 80.0; age += 0.173) {
        /* Two levels' quanta; the age itself is rounded at 80, times the slope. */
        TEST_ASSERT_DOUBLE_WITHIN(2 * half_quantum() + 2 * EPSILON + 80.0 * EPSILON * 0.008,
                                  0.9 - 0.008 * age, level_at(age));
    }
}

static void test_look_back_reaches_the_end_of_a_broken_window(void) {
    begin(12.6 * 0.0025, 0.0025);
    push_ramp(0.9, 0.03, 14);
    TEST_ASSERT_DOUBLE_WITHIN(2 * half_quantum() + 16 * EPSILON, 0.9 - 0.03 * 12.6,
                              (double)belt_level_history_at(&history, history.window));
}

static void test_look_back_to_the_whole_window_reads_no_older_level(void) {
    push_ramp(1.0, 0.0, 1); /* 81 periods old in the end */
    push_ramp(0.5, 0.0, 81);
    TEST_ASSERT_DOUBLE_WITHIN(half_quantum() + 80.0 * 8 * EPSILON, 0.5,
                              (double)belt_level_history_at(&history, history.window));
}

static void test_change_of_congestion_is_what_enters_less_what_leaves(void) {
    uint64_t random = 77u;
    begin(12.6 * 0.0025, 0.0025);
    for (int i = 0; i < 200; ++i) {
        const double before = congestion();
        const double newest = level_at(0.0);
        const double left_first = level_at(12.6);
        const double corner = level_at(12.0);
        belt_level_history_push(&history, random_share(&random));
        /* On its way from one place between two levels to the next, the window's end passes the
         * level between, a corner of the polygon. */
        const double left_last = level_at(12.6);
        const double left = 0.5 * (0.6 * (left_first + corner) + 0.4 * (corner + left_last));
        const double entered = 0.5 * (newest + level_at(0.0));
        TEST_ASSERT_DOUBLE_WITHIN(4 * tolerance(0.03), 0.0025 * (entered - left),
                                  congestion() - before);
    }
}

/* --- begin --- */

static void test_first_level_is_the_whole_past(void) {
    belt_level_history_begin(&history, BELT_REAL(0.375));
    for (int age = 0; age <= 80; ++age) {
        TEST_ASSERT_DOUBLE_WITHIN(half_quantum() + EPSILON, 0.375, level_at(age));
    }
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.075), 0.075, congestion());
}

static void test_first_level_is_what_pushing_it_long_enough_leads_to(void) {
    for (double window = 0.0025; window < 0.3; window += 0.0137) {
        begin(window, 0.0025);
        belt_level_history_begin(&history, BELT_REAL(0.3));
        const double filled = congestion();
        belt_level_history_init(&history, &config);
        push_ramp(0.3, 0.0, 300);
        /* one is a product, the other a sum of whole quanta: a rounding or two apart */
        TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.3 * window, filled, congestion());
    }
}

static void test_first_level_is_forgotten_once_it_has_left_the_window(void) {
    static belt_level_history_t other;
    uint64_t random = 31u;
    belt_level_history_init(&other, &config);
    belt_level_history_begin(&history, BELT_REAL(1));
    belt_level_history_begin(&other, BELT_REAL(0));
    for (int i = 0; i < 1000; ++i) {
        const belt_real_t level = random_share(&random);
        belt_level_history_push(&history, level);
        belt_level_history_push(&other, level);
    }
    for (int age = 0; age <= 80; ++age) {
        /* Quanta are whole numbers: less the first level and back again they are the same. */
        TEST_ASSERT_TRUE(level_at(age) == (double)belt_level_history_at(&other, BELT_REAL(age)));
    }
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.2), (double)belt_level_history_congestion(&other),
                              congestion());
}

static void test_change_over_the_whole_range_does_not_overflow_the_sum(void) {
    belt_level_history_begin(&history, config.level_capacity);
    push_ramp(0.0, 0.0, 500);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.2), 0.0, congestion());
    push_ramp(1.0, 0.0, 500);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.2), 0.2, congestion());
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_sum_after_a_million_pushes_is_that_of_a_fresh_history);
    RUN_TEST(test_sum_is_that_of_the_levels_in_the_window);
    RUN_TEST(test_look_back_finds_every_level_of_the_window);
    RUN_TEST(test_look_back_is_linear_between_periods);
    RUN_TEST(test_look_back_reaches_the_end_of_a_broken_window);
    RUN_TEST(test_look_back_to_the_whole_window_reads_no_older_level);
    RUN_TEST(test_change_of_congestion_is_what_enters_less_what_leaves);
    RUN_TEST(test_first_level_is_the_whole_past);
    RUN_TEST(test_first_level_is_what_pushing_it_long_enough_leads_to);
    RUN_TEST(test_first_level_is_forgotten_once_it_has_left_the_window);
    RUN_TEST(test_change_over_the_whole_range_does_not_overflow_the_sum);
    return UNITY_END();
}
