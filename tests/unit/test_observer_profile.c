/* SPDX-License-Identifier: MIT */
/* A known profile, and bounds. */
#include "observer_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- a known profile --- */

static void test_assumed_profile_lies_on_the_belt_by_trapezoids(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    double trapezoids = 0.0;
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL((double)((i * 7u) % 5u) * 0.25);
        trapezoids += (double)density[i] * (((i == 0u) || (i == line.node_count)) ? 0.5 : 1.0);
    }
    belt_observer_assume(&observer, &line, density);
    TEST_ASSERT_TRUE(on_belt() == trapezoids); /* quarters: exact */
    for (uint32_t i = 0; i < line.node_count; ++i) {
        TEST_ASSERT_TRUE(cell(i) == 0.5 * ((double)density[i] + (double)density[i + 1u]));
    }
}

static void test_assumed_ramp_leaves_as_a_ramp(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL(0.05 * i);
    }
    belt_observer_assume(&observer, &line, density);
    for (int i = 0; i < 40; ++i) {
        advance(0.5, 0.0);
        /* The mean of each half cell; rounded at 1, divided by 0.5. */
        TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, 0.05 * (0.5 * i + 0.25), left());
    }
    advance(0.5, 0.0);
    TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(0));
}

static void test_assumed_profile_replaces_all_that_was_known(void) {
    static belt_observer_t fresh;
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL(0.5);
    }
    belt_observer_init(&fresh);
    belt_observer_assume(&fresh, &line, density);
    for (int i = 0; i < 77; ++i) {
        advance(0.3, 0.1 * i);
    }
    belt_observer_assume(&observer, &line, density);
    for (int i = 0; i < 100; ++i) {
        const belt_real_t used = observer.outlet_density;
        TEST_ASSERT_TRUE(used == fresh.outlet_density);
        belt_passage_t passage = {.duration = BELT_REAL(0.0075),
                                  .travel = BELT_REAL(0.3),
                                  .fed_density = BELT_REAL(0.25)};
        belt_observer_advance(&observer, &line, &passage);
        belt_observer_advance(&fresh, &line, &passage);
    }
}

/* --- nothing leaves its bounds --- */

static void test_line_that_runs_away_stays_finite(void) {
    config.rework_rate = BELT_REAL(4); /* twice of what leaves comes back: no rule would have it */
    begin();
    for (int i = 0; i < 40000; ++i) {
        advance(0.5, 1.0);
        TEST_ASSERT_TRUE(observer.outlet_density >= BELT_REAL(0));
        TEST_ASSERT_TRUE(observer.outlet_density <= line.density_bound);
    }
    TEST_ASSERT_TRUE(observer.outlet_density >= BELT_HALF * line.density_bound);
}

static void test_outlet_density_that_is_no_number_is_none_at_all(void) {
    advance_measured(0.025, 0.5, 1.0, (double)NAN);
    TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(0));
}

static void test_neither_side_of_a_cut_is_below_zero(void) {
    uint64_t state = 20260101u;
    for (int i = 0; i < 20000; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        advance(0.03 + 0.4 * (double)(state >> 40) / (double)(1 << 24),
                (double)((state >> 33) & 1u));
        TEST_ASSERT_TRUE(observer.outlet_density >= BELT_REAL(0));
        TEST_ASSERT_TRUE(belt_observer_rest_of_outlet(&observer) >= -BELT_REAL(EPSILON));
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_assumed_profile_lies_on_the_belt_by_trapezoids);
    RUN_TEST(test_assumed_ramp_leaves_as_a_ramp);
    RUN_TEST(test_assumed_profile_replaces_all_that_was_known);
    RUN_TEST(test_line_that_runs_away_stays_finite);
    RUN_TEST(test_outlet_density_that_is_no_number_is_none_at_all);
    RUN_TEST(test_neither_side_of_a_cut_is_below_zero);
    return UNITY_END();
}
