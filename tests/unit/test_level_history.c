/* SPDX-License-Identifier: MIT */
/* The window and its congestion. */
#include "level_history_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- the window --- */

static void test_window_of_whole_periods_counts_them(void) {
    TEST_ASSERT_EQUAL_UINT32(80u, history.whole);
    TEST_ASSERT_DOUBLE_WITHIN(80.0 * 8 * EPSILON, 0.0, (double)history.part);
}

static void test_window_that_rounding_left_short_of_whole_periods_counts_them_too(void) {
    for (unsigned periods = 1; periods <= BELT_WINDOW_CAPACITY - 2u; ++periods) {
        for (int i = 1; i < 8; ++i) {
            const double period = 0.0007 * i;
            begin((double)BELT_REAL(period) * periods, period);
            TEST_ASSERT_EQUAL_UINT32(periods, history.whole);
        }
    }
}

static void test_one_quantum_is_a_small_share_of_the_capacity(void) {
    /* 82 levels of 2^30 quanta in all: 7.6e-8 of the capacity, as the header says. */
    TEST_ASSERT_TRUE((double)history.quantum < 7.7e-8);
    TEST_ASSERT_TRUE((double)history.quantum > 0.0);
}

static void test_levels_are_rounded_to_the_nearest_quantum(void) {
    const double quantum = (double)history.quantum;
    belt_level_history_push(&history, BELT_REAL(1000.75 * quantum));
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * quantum, 1001.0 * quantum, level_at(0));
    belt_level_history_push(&history, BELT_REAL(1000.45 * quantum));
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * quantum, 1000.0 * quantum, level_at(0));
    belt_level_history_push(&history, BELT_REAL(1000.55 * quantum));
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * quantum, 1001.0 * quantum, level_at(0));
}

static void test_rate_is_one_over_the_period(void) {
    begin(0.125, 0.0078125);
    TEST_ASSERT_TRUE(history.period == BELT_REAL(0.0078125));
    TEST_ASSERT_TRUE(history.rate == BELT_REAL(128));
}

static void test_init_touches_no_level_behind_those_in_use(void) {
    memset(&history, 0x5A, sizeof history);
    const belt_quanta_t untouched = history.level[0];
    begin(0.2, 0.0025);
    TEST_ASSERT_EQUAL_UINT32(82u, history.length);
    TEST_ASSERT_TRUE(history.level[81] == 0);
    TEST_ASSERT_TRUE(history.level[82] == untouched);
}

/* --- congestion --- */

static void test_empty_history_has_no_congestion(void) {
    TEST_ASSERT_TRUE(belt_level_history_congestion(&history) == BELT_REAL(0));
}

static void test_constant_level_gives_level_times_window(void) {
    const double windows[] = {0.0025, 0.003, 0.00499, 0.2, 0.2001, 0.2012, 0.5};
    for (size_t i = 0; i < sizeof windows / sizeof windows[0]; ++i) {
        for (int level = 0; level <= 8; ++level) {
            begin(windows[i], 0.0025);
            belt_level_history_begin(&history, BELT_REAL(0.125 * level));
            const double truth = 0.125 * level * windows[i];
            TEST_ASSERT_DOUBLE_WITHIN(tolerance(truth), truth, congestion());
        }
    }
}

static void test_full_buffer_does_not_overflow_the_sum(void) {
    begin(0.2, 0.0025);
    for (int i = 0; i < 500; ++i) {
        belt_level_history_push(&history, config.level_capacity);
    }
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.2), 0.2, congestion());
}

static void test_trapezoids_are_exact_for_a_ramp(void) {
    /* Mean level of the window: the one half a window ago. */
    push_ramp(0.9, 0.004, 100);
    const double truth = 0.2 * (0.9 - 0.004 * 40.0);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(truth), truth, congestion());
}

static void test_ramp_is_exact_when_the_window_is_no_multiple_of_the_period(void) {
    for (double part = 0.05; part < 1.0; part += 0.1) {
        begin((12.0 + part) * 0.0025, 0.0025);
        push_ramp(0.9, 0.03, 30);
        const double truth = (12.0 + part) * 0.0025 * (0.9 - 0.03 * 0.5 * (12.0 + part));
        TEST_ASSERT_DOUBLE_WITHIN(tolerance(truth), truth, congestion());
    }
}

static void test_falling_ramp_is_exact_too(void) {
    begin(12.3 * 0.0025, 0.0025);
    push_ramp(0.1, -0.03, 30);
    const double truth = 12.3 * 0.0025 * (0.1 + 0.03 * 0.5 * 12.3);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(truth), truth, congestion());
}

static void test_pulse_leaves_the_window_after_the_window(void) {
    begin(4.5 * 0.25, 0.25);
    belt_level_history_push(&history, BELT_REAL(1));
    /* A triangle one period to either side; the window cuts it after 4.5 periods. Areas in
     * periods: half, whole, ..., whole less the last half triangle's 1/8 of it, then that 1/8. */
    const double areas[] = {0.5, 1.0, 1.0, 1.0, 0.875, 0.125, 0.0, 0.0};
    for (size_t i = 0; i < sizeof areas / sizeof areas[0]; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.25), 0.25 * areas[i], congestion());
        belt_level_history_push(&history, BELT_REAL(0));
    }
}

static void test_window_of_one_period_is_one_trapezoid(void) {
    begin(0.0025, 0.0025);
    belt_level_history_push(&history, BELT_REAL(0.25));
    belt_level_history_push(&history, BELT_REAL(0.75));
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.00125), 0.00125, congestion());
}

static void test_levels_before_the_window_do_not_count(void) {
    push_ramp(1.0, 0.0, 100);
    push_ramp(0.25, 0.0, 81);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance(0.05), 0.05, congestion());
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_window_of_whole_periods_counts_them);
    RUN_TEST(test_window_that_rounding_left_short_of_whole_periods_counts_them_too);
    RUN_TEST(test_one_quantum_is_a_small_share_of_the_capacity);
    RUN_TEST(test_levels_are_rounded_to_the_nearest_quantum);
    RUN_TEST(test_rate_is_one_over_the_period);
    RUN_TEST(test_init_touches_no_level_behind_those_in_use);
    RUN_TEST(test_empty_history_has_no_congestion);
    RUN_TEST(test_constant_level_gives_level_times_window);
    RUN_TEST(test_full_buffer_does_not_overflow_the_sum);
    RUN_TEST(test_trapezoids_are_exact_for_a_ramp);
    RUN_TEST(test_ramp_is_exact_when_the_window_is_no_multiple_of_the_period);
    RUN_TEST(test_falling_ramp_is_exact_too);
    RUN_TEST(test_pulse_leaves_the_window_after_the_window);
    RUN_TEST(test_window_of_one_period_is_one_trapezoid);
    RUN_TEST(test_levels_before_the_window_do_not_count);
    return UNITY_END();
}
