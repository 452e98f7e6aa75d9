/* SPDX-License-Identifier: MIT */
#include "belt/level_history.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_level_history_t history;

static void begin(double window, double period) {
    config.speed_window = BELT_REAL(window);
    config.period = BELT_REAL(period);
    belt_level_history_init(&history, &config);
}

void setUp(void) {
    config = paper_case();
    begin(0.2, 0.0025);
}

void tearDown(void) {
}

/** Rounding of a level to quanta. */
static double half_quantum(void) {
    return 0.5 * (double)history.quantum;
}

/** What congestion may be off: half a quantum a level over the window, six roundings of the result
 * on the way from the integers, and the window's end, a hair of 4 EPSILON and two roundings. */
static double tolerance(double congestion) {
    return (half_quantum() + 6 * EPSILON) * (double)config.speed_window + 6 * EPSILON * congestion;
}

static double congestion(void) {
    return (double)belt_level_history_congestion(&history);
}

static double level_at(double age) {
    return (double)belt_level_history_at(&history, BELT_REAL(age));
}

/** Levels on a line through time: `slope` a period up to `newest` now. */
static void push_ramp(double newest, double slope, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
        belt_level_history_push(&history, BELT_REAL(newest - slope * (double)(count - 1u - i)));
    }
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
    belt_level_history_push(&history, BELT_REAL(1000.25 * quantum));
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * quantum, 1000.0 * quantum, level_at(0));
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
    RUN_TEST(test_window_of_whole_periods_counts_them);
    RUN_TEST(test_window_that_rounding_left_short_of_whole_periods_counts_them_too);
    RUN_TEST(test_one_quantum_is_a_small_share_of_the_capacity);
    RUN_TEST(test_levels_are_rounded_to_the_nearest_quantum);
    RUN_TEST(test_empty_history_has_no_congestion);
    RUN_TEST(test_constant_level_gives_level_times_window);
    RUN_TEST(test_full_buffer_does_not_overflow_the_sum);
    RUN_TEST(test_trapezoids_are_exact_for_a_ramp);
    RUN_TEST(test_ramp_is_exact_when_the_window_is_no_multiple_of_the_period);
    RUN_TEST(test_falling_ramp_is_exact_too);
    RUN_TEST(test_pulse_leaves_the_window_after_the_window);
    RUN_TEST(test_window_of_one_period_is_one_trapezoid);
    RUN_TEST(test_levels_before_the_window_do_not_count);
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
