/* SPDX-License-Identifier: MIT */
/* What the observer shows: the density at a place, and its own outlet density beside a measured one. */
#include "belt/observer.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_line_t line;
static belt_observer_t observer;

static void begin(uint16_t nodes) {
    config.node_count = nodes;
    belt_line_init(&line, &config);
    belt_observer_init(&observer);
}

void setUp(void) {
    config = paper_case();
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
    begin(8);
}

void tearDown(void) {
}

static void advance(double travel, double fed) {
    const belt_passage_t passage = {.duration = BELT_REAL(0.0625 * travel),
                                    .travel = BELT_REAL(travel),
                                    .fed_density = BELT_REAL(fed)};
    belt_observer_advance(&observer, &line, &passage);
}

static void advance_measured(double travel, double fed, double left) {
    const belt_passage_t passage = {.duration = BELT_REAL(0.0625 * travel),
                                    .travel = BELT_REAL(travel),
                                    .fed_density = BELT_REAL(fed),
                                    .left_density = BELT_REAL(left),
                                    .left_is_measured = true};
    belt_observer_advance(&observer, &line, &passage);
}

static double density_at(double place) {
    return (double)belt_observer_density_at(&observer, &line, BELT_REAL(place));
}

/* --- density at a place --- */

static void test_empty_belt_shows_nothing_anywhere(void) {
    for (double place = 0.0; place <= 8.0; place += 0.25) {
        TEST_ASSERT_EQUAL_DOUBLE(0.0, density_at(place));
    }
}

static void test_each_cell_shows_its_two_sides(void) {
    /* A ramp of 1 a spacing: a cell from i to i + 1 has i + 1/4 before its middle, i + 3/4 behind. */
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL(i);
    }
    belt_observer_assume(&observer, &line, density);
    for (int i = 0; i < 8; ++i) {
        TEST_ASSERT_EQUAL_DOUBLE(i + 0.25, density_at(i));
        TEST_ASSERT_EQUAL_DOUBLE(i + 0.25, density_at(i + 0.4375));
        TEST_ASSERT_EQUAL_DOUBLE(i + 0.75, density_at(i + 0.5));
        TEST_ASSERT_EQUAL_DOUBLE(i + 0.75, density_at(i + 0.9375));
    }
    TEST_ASSERT_EQUAL_DOUBLE(8.0,
                             density_at(8.0)); /* of the inlet, where nothing has been fed yet */
}

static void test_places_move_with_the_material(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL(i);
    }
    belt_observer_assume(&observer, &line, density);
    advance(0.25, 16.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, density_at(0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.75, density_at(0.25));
    TEST_ASSERT_EQUAL_DOUBLE(1.25, density_at(0.75));
    TEST_ASSERT_EQUAL_DOUBLE(7.75, density_at(7.625));
    TEST_ASSERT_EQUAL_DOUBLE(16.0, density_at(7.75)); /* fed since */
    TEST_ASSERT_EQUAL_DOUBLE(16.0, density_at(8.0));
}

static void test_jump_is_shown_where_it_is(void) {
    for (int i = 0; i < 40; ++i) {
        advance(0.25, (i < 23) ? 1.0 : 3.0);
    }
    /* 17 periods of 0.25 ago. */
    for (double place = 0.0; place <= 8.0; place += 0.125) {
        TEST_ASSERT_EQUAL_DOUBLE((place < 8.0 - 17 * 0.25) ? 1.0 : 3.0, density_at(place));
    }
}

static void test_inlet_shows_what_was_fed_last(void) {
    for (int i = 0; i < 50; ++i) {
        advance(0.25, 1.0 + i); /* in a new cell what was fed last, else the mean of its fill */
        const int fed = i % 4;  /* periods of this cell before */
        const double mean = 1.0 + i - 0.5 * fed;
        TEST_ASSERT_EQUAL_DOUBLE((fed == 3) ? 1.0 + i : mean, density_at(8.0));
    }
}

static void test_places_off_the_belt_are_its_ends(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL(i);
    }
    belt_observer_assume(&observer, &line, density);
    advance(0.25, 16.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.25, density_at(-1.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.25, density_at(-1e30));
    TEST_ASSERT_EQUAL_DOUBLE(0.25, density_at((double)NAN));
    TEST_ASSERT_EQUAL_DOUBLE(16.0, density_at(9.0));
    TEST_ASSERT_EQUAL_DOUBLE(16.0, density_at(1e30));
}

static void test_inlet_of_a_cell_that_is_nearly_full_is_still_the_open_one(void) {
    /* 320 + 0.999989 rounds to 321 in float32. */
    begin(320);
    advance(0.999989, 3.0);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, density_at(320.0));
    begin(319);
    advance(0.999989, 3.0);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, density_at(319.0));
}

static void test_mean_of_the_places_is_what_lies_on_the_belt(void) {
    uint64_t random = 4u;
    double balance = 0.0;
    for (int i = 0; i < 200; ++i) {
        const double fed = 0.25 * (double)((random_bits(&random) >> 20) & 15u);
        advance(0.25, fed);
        balance += 0.25 * (fed - (double)observer.outlet_density);
        double sum = 0.0;
        for (int k = 0; k < 8 * 1024; ++k) {
            sum += density_at((k + 0.5) / 1024.0) / 1024.0;
        }
        /* A cut lies anywhere in its 1024th, half of it off: of each of nine cells a step of up to
         * 3.75 over a quarter. */
        TEST_ASSERT_DOUBLE_WITHIN(9.0 * 0.5 * 15.0 / 1024.0, balance, sum);
    }
}

/* --- the observer's own outlet density --- */

static double own(void) {
    return (double)observer.modelled_density;
}

static double used(void) {
    return (double)observer.outlet_density;
}

static void test_both_are_nothing_at_first_and_the_outlets_after_a_profile(void) {
    memset(&observer, 0xA5, sizeof observer);
    belt_observer_init(&observer);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, own());
    TEST_ASSERT_EQUAL_DOUBLE(0.0, used());
    belt_real_t density[BELT_NODE_CAPACITY + 1] = {BELT_REAL(0.75), BELT_REAL(2)};
    belt_observer_assume(&observer, &line, density);
    TEST_ASSERT_EQUAL_DOUBLE(0.75, own());
    TEST_ASSERT_EQUAL_DOUBLE(0.75, used());
}

static void test_without_a_measured_one_both_are_the_observers(void) {
    for (int i = 0; i < 60; ++i) {
        advance(0.25, (i % 8 < 4) ? 1.0 : 2.0);
        TEST_ASSERT_EQUAL_DOUBLE(own(), used());
    }
}

static void test_measured_one_leaves_the_observers_own_to_be_seen(void) {
    for (int i = 0; i < 40; ++i) {
        advance_measured(0.25, 2.0, 0.125);
        TEST_ASSERT_EQUAL_DOUBLE(0.125, used());
        TEST_ASSERT_EQUAL_DOUBLE((i < 32) ? 0.0 : 2.0, own()); /* one belt later */
    }
}

static void test_both_stay_within_the_bounds_of_a_line(void) {
    const double bound = (double)line.density_bound;
    advance_measured(0.25, 0.0, 1e30);
    TEST_ASSERT_EQUAL_DOUBLE(bound, used());
    TEST_ASSERT_EQUAL_DOUBLE(0.0, own());
    advance_measured(0.25, 0.0, -1.0);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, used());
    for (int i = 0; i < 40; ++i) {
        advance(0.25, 10.0 * bound); /* no gate lets that in */
    }
    TEST_ASSERT_EQUAL_DOUBLE(bound, own());
    TEST_ASSERT_EQUAL_DOUBLE(bound, used());
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_empty_belt_shows_nothing_anywhere);
    RUN_TEST(test_each_cell_shows_its_two_sides);
    RUN_TEST(test_places_move_with_the_material);
    RUN_TEST(test_jump_is_shown_where_it_is);
    RUN_TEST(test_inlet_shows_what_was_fed_last);
    RUN_TEST(test_places_off_the_belt_are_its_ends);
    RUN_TEST(test_inlet_of_a_cell_that_is_nearly_full_is_still_the_open_one);
    RUN_TEST(test_mean_of_the_places_is_what_lies_on_the_belt);
    RUN_TEST(test_both_are_nothing_at_first_and_the_outlets_after_a_profile);
    RUN_TEST(test_without_a_measured_one_both_are_the_observers);
    RUN_TEST(test_measured_one_leaves_the_observers_own_to_be_seen);
    RUN_TEST(test_both_stay_within_the_bounds_of_a_line);
    return UNITY_END();
}
