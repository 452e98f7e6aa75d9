/* SPDX-License-Identifier: MIT */
/* A flipped bit leaves the history: with every window its sum is begun anew. */
#include "belt/level_history.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

#define WINDOW 8u /* levels in the sum: 7 whole periods and a part */

static belt_config_t config;
static belt_level_history_t history;
static belt_level_history_t unhurt;
static uint64_t random_state;

void setUp(void) {
    config = paper_case();
    config.period = BELT_REAL(0.0078125);
    config.speed_window = BELT_REAL(7.5) * config.period;
    belt_level_history_init(&history, &config);
    belt_level_history_begin(&history, BELT_REAL(0.25));
    TEST_ASSERT_EQUAL_UINT32(WINDOW - 1u, history.whole);
    random_state = 99u;
}

void tearDown(void) {
}

/** The same levels into both. */
static void push(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
        const belt_real_t level = random_share(&random_state);
        belt_level_history_push(&history, level);
        belt_level_history_push(&unhurt, level);
    }
}

static bool are_alike(void) {
    return (history.window_sum == unhurt.window_sum) &&
           (belt_level_history_congestion(&history) == belt_level_history_congestion(&unhurt));
}

/** What is left of a flip after two windows, and the flipped level out of the ring. */
static void assert_heals(void) {
    push(2u * WINDOW);
    for (int i = 0; i < 100; ++i) {
        TEST_ASSERT_TRUE(are_alike());
        push(1);
    }
}

static void flip(belt_quanta_t *quanta, unsigned bit) {
    belt_word_t word = (belt_word_t)*quanta ^ ((belt_word_t)1 << bit);
    memcpy(quanta, &word, sizeof word);
}

/* --- the second sum --- */

static void test_both_sums_begin_at_nothing(void) {
    memset(&history, 0xA5, sizeof history);
    belt_level_history_init(&history, &config);
    TEST_ASSERT_TRUE(history.window_sum == 0);
    TEST_ASSERT_TRUE(history.check_sum == 0);
    TEST_ASSERT_EQUAL_UINT32(0u, history.check_count);
}

static void test_second_sum_counts_the_levels_of_one_window_and_begins_anew(void) {
    belt_quanta_t sum = 0;
    for (uint32_t i = 1; i < 10u * WINDOW; ++i) {
        belt_level_history_push(&history, random_share(&random_state));
        sum = (i % WINDOW == 0u) ? 0 : sum + history.level[history.newest];
        TEST_ASSERT_EQUAL_UINT32(i % WINDOW, history.check_count);
        TEST_ASSERT_TRUE(history.check_sum == sum);
    }
}

static void test_second_sum_changes_nothing_that_is_right(void) {
    /* Levels are whole numbers: the sum is that of the window, whichever of the two it came from. */
    for (unsigned i = 0; i < 100u * WINDOW; ++i) {
        belt_level_history_push(&history, random_share(&random_state));
        belt_quanta_t sum = 0;
        for (uint32_t age = 0; age <= history.whole; ++age) {
            sum += history.level[belt_level_history_index(&history, age)];
        }
        TEST_ASSERT_TRUE(history.window_sum == sum);
    }
}

/* --- flips --- */

static void test_flipped_level_is_healed(void) {
    for (uint32_t slot = 0; slot < history.length; ++slot) {
        for (unsigned bit = 0; bit <= BELT_QUANTA_BITS + 1u; ++bit) {
            unhurt = history;
            flip(&history.level[slot], bit);
            assert_heals();
        }
    }
}

static void test_flipped_sum_is_healed_and_was_wrong_before(void) {
    for (unsigned bit = 0; bit <= BELT_QUANTA_BITS + 1u; ++bit) {
        unhurt = history;
        flip(&history.window_sum, bit);
        TEST_ASSERT_FALSE(are_alike() && (history.window_sum == unhurt.window_sum));
        assert_heals();
    }
}

static void test_flipped_second_sum_is_healed(void) {
    for (unsigned bit = 0; bit <= BELT_QUANTA_BITS + 1u; ++bit) {
        push(3); /* in its midst */
        unhurt = history;
        flip(&history.check_sum, bit);
        assert_heals();
    }
}

static void test_flipped_count_is_healed(void) {
    for (unsigned bit = 0; bit < 32u; ++bit) {
        push(3);
        unhurt = history;
        history.check_count ^= (uint32_t)1 << bit;
        assert_heals();
        /* Both windows need not begin at the same level. */
        history.check_count = unhurt.check_count;
        history.check_sum = unhurt.check_sum;
    }
}

static void test_count_that_wraps_is_healed(void) {
    push(3);
    unhurt = history;
    history.check_count = UINT32_MAX; /* no one flip does that: a window more */
    push(WINDOW);
    assert_heals();
}

/* --- sums that wrap --- */

static void test_sum_and_difference_of_quanta_wrap(void) {
    const belt_quanta_t most = (belt_quanta_t)(((belt_word_t)1 << (BELT_QUANTA_BITS + 1)) - 1u);
    TEST_ASSERT_TRUE(belt_quanta_sum(3, 4) == 7);
    TEST_ASSERT_TRUE(belt_quanta_less(3, 4) == -1);
    TEST_ASSERT_TRUE(belt_quanta_sum(most, 1) == -most - 1);
    TEST_ASSERT_TRUE(belt_quanta_less(-most - 1, 1) == most);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_both_sums_begin_at_nothing);
    RUN_TEST(test_second_sum_counts_the_levels_of_one_window_and_begins_anew);
    RUN_TEST(test_second_sum_changes_nothing_that_is_right);
    RUN_TEST(test_flipped_level_is_healed);
    RUN_TEST(test_flipped_sum_is_healed_and_was_wrong_before);
    RUN_TEST(test_flipped_second_sum_is_healed);
    RUN_TEST(test_flipped_count_is_healed);
    RUN_TEST(test_count_that_wraps_is_healed);
    RUN_TEST(test_sum_and_difference_of_quanta_wrap);
    return UNITY_END();
}
