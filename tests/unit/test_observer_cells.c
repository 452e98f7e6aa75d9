/* SPDX-License-Identifier: MIT */
/* One cell: its cut, its step, and how both age. */
#include "belt/observer.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_line_t line;
static belt_observer_t observer;

static void begin(void) {
    belt_line_init(&line, &config);
    belt_observer_init(&observer);
}

void setUp(void) {
    config = paper_case();
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
    config.node_count = 8;
    begin();
}

void tearDown(void) {
}

/* A spacing takes 0.0625 s. */
static void advance(double travel, double fed) {
    const belt_passage_t passage = {.duration = BELT_REAL(0.0625 * travel),
                                    .travel = BELT_REAL(travel),
                                    .fed_density = BELT_REAL(fed)};
    belt_observer_advance(&observer, &line, &passage);
}

static uint32_t slot(uint32_t cell) {
    return belt_observer_behind(&line, observer.outlet, cell);
}

/** The cell closed last. */
static double cut(void) {
    return (double)observer.cut[slot(7)];
}

static double step(void) {
    return (double)observer.step[slot(7)];
}

static double mean(void) {
    return (double)observer.density[slot(7)];
}

/** Fills a cell, quarter by quarter, behind one of density 1. */
static void fill(double first, double second, double third, double fourth) {
    begin();
    advance(1.0, 1.0);
    advance(0.25, first);
    advance(0.25, second);
    advance(0.25, third);
    advance(0.25, fourth);
}

static void test_init_clears_everything(void) {
    memset(&observer, 0xA5, sizeof observer);
    belt_observer_init(&observer);
    for (size_t i = 0; i < BELT_CELL_CAPACITY; ++i) {
        TEST_ASSERT_TRUE(observer.density[i] == BELT_REAL(0));
        TEST_ASSERT_TRUE(observer.step[i] == BELT_REAL(0));
        TEST_ASSERT_TRUE(observer.cut[i] == BELT_REAL(0));
    }
    TEST_ASSERT_EQUAL_UINT32(0u, observer.outlet);
    const belt_real_t others[] = {
        observer.gone,  observer.outlet_density, observer.moment,     observer.modelled_density,
        observer.jumps, observer.fed_density,    observer.jumps_place};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i) {
        TEST_ASSERT_TRUE(others[i] == BELT_REAL(0));
    }
}

static void test_even_feed_makes_a_cell_without_a_step_cut_in_its_middle(void) {
    fill(1.0, 1.0, 1.0, 1.0);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, mean());
    TEST_ASSERT_EQUAL_DOUBLE(0.5, cut());
    TEST_ASSERT_EQUAL_DOUBLE(0.0, step());
}

static void test_jump_at_the_cells_end_is_no_cut_in_it(void) {
    fill(3.0, 3.0, 3.0, 3.0);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, mean());
    TEST_ASSERT_EQUAL_DOUBLE(0.5, cut());
    TEST_ASSERT_EQUAL_DOUBLE(0.0, step());
}

static void test_one_jump_is_cut_and_step(void) {
    fill(1.0, 3.0, 3.0, 3.0);
    /* Quarters, thirds of them: division and three roundings. */
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 2.5, 2.5, mean());
    TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON, 0.25, cut());
    TEST_ASSERT_DOUBLE_WITHIN(32 * EPSILON, 2.0, step());
    fill(1.0, 1.0, 1.0, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON, 0.75, cut());
    TEST_ASSERT_DOUBLE_WITHIN(32 * EPSILON, -0.5, step());
    fill(4.0, 0.0, 0.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(32 * EPSILON, -4.0, step());
    fill(0.0, 0.0, 0.0, 4.0);
    TEST_ASSERT_DOUBLE_WITHIN(32 * EPSILON, 4.0, step());
}

static void test_cut_keeps_off_the_ends_of_its_cell(void) {
    const double margin = 1.0 / 1024.0;
    advance(1.0, 1.0);
    advance(0.0005, 1.0);
    advance(0.9995, 3.0);
    TEST_ASSERT_EQUAL_DOUBLE(margin, cut());
    begin();
    advance(1.0, 1.0);
    advance(0.9995, 1.0);
    advance(0.0005, 3.0);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 - margin, cut());
}

static void assert_open_cell_is_empty(void) {
    TEST_ASSERT_TRUE(observer.gone == BELT_REAL(0));
    TEST_ASSERT_TRUE(observer.density[slot(8)] == BELT_REAL(0));
    TEST_ASSERT_TRUE(observer.step[slot(8)] == BELT_REAL(0));
    TEST_ASSERT_TRUE(observer.cut[slot(8)] == BELT_REAL(0));
}

static void test_cell_that_opens_is_empty(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= BELT_NODE_CAPACITY; ++i) { /* the profile ends at node_count */
        density[i] = BELT_REAL(1);
    }
    belt_observer_assume(&observer, &line, density);
    assert_open_cell_is_empty();
    for (int i = 0; i < 20; ++i) {
        advance(0.5, 1.0);
        advance(0.5, 3.0);
        assert_open_cell_is_empty();
    }
}

static void test_cut_of_two_jumps_is_the_centre_of_their_squares(void) {
    fill(1.0, 2.0, 3.0, 3.0);
    /* Squares 1 and 1, times the distances to both ends: 1/4*3/4 and 1/2*1/2. */
    const double centre = (0.1875 * 0.25 + 0.25 * 0.5) / (0.1875 + 0.25);
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, centre, cut());
    /* The step has the first moment about the middle, where the mean of 2.25 has 2.25/2. */
    const double moment = 1.0 / 32.0 + 2.0 * 3.0 / 32.0 + 3.0 * 12.0 / 32.0;
    TEST_ASSERT_DOUBLE_WITHIN(64 * EPSILON, 2.0 * (moment - 1.125) / (centre * (1.0 - centre)),
                              step());
    fill(1.0, 3.0, 3.0, 4.0); /* squares 4 and 1 */
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, (4 * 0.25 + 0.75) / 5.0, cut());
}

static void test_neither_side_of_a_cut_is_below_nothing(void) {
    fill(1.0, 0.0, 0.0, 4.0); /* a step of 5.5 would put -0.9 on the outlet side */
    TEST_ASSERT_TRUE(mean() - step() * (1.0 - cut()) >= -4 * EPSILON);
    fill(4.0, 0.0, 0.0, 1.0);
    TEST_ASSERT_TRUE(mean() + step() * cut() >= -4 * EPSILON);
}

static void test_both_sides_of_a_cut_lose_alike(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint16_t kinds = 1; kinds <= 2; ++kinds) {
        config.loss_count = kinds;
        config.loss_rate[0] = BELT_REAL(1.5);
        config.loss_rate[1] = real_next(BELT_REAL(1.5), BELT_REAL(2)); /* all but uniform */
        begin();
        for (uint32_t i = 0; i <= line.node_count; ++i) {
            density[i] = BELT_REAL(i);
        }
        belt_observer_assume(&observer, &line, density);
        for (int i = 0; i < 12; ++i) {
            advance(0.25, 0.0);
        }
        /* Three spacings of 0.0625 s; the series leaves (loss of a period)^4/24, four roundings
         * each. */
        const double kept = exp(-1.5 * 3.0 * 0.0625);
        const double series = 12.0 * pow(1.5 * 0.25 * 0.0625, 4.0) / 24.0;
        for (uint32_t k = 0; k < 5u; ++k) {
            TEST_ASSERT_DOUBLE_WITHIN(series + 48 * EPSILON, 0.5 * kept,
                                      (double)observer.step[slot(k)]);
        }
    }
}

static void test_profile_leaves_nothing_of_what_the_ring_held(void) {
    const belt_real_t density[BELT_NODE_CAPACITY + 1] = {BELT_REAL(1)};
    for (uint16_t nodes = 7; nodes <= 8; ++nodes) {
        config.node_count = nodes;
        begin();
        memset(&observer, 0x5A, sizeof observer);
        belt_observer_assume(&observer, &line, density);
        for (uint32_t i = 1; i < line.cell_slots; ++i) {
            TEST_ASSERT_TRUE(observer.density[i] == BELT_REAL(0));
            TEST_ASSERT_TRUE(observer.step[i] == BELT_REAL(0));
            TEST_ASSERT_TRUE(observer.cut[i] == ((i < nodes) ? BELT_HALF : BELT_REAL(0)));
        }
        TEST_ASSERT_EQUAL_UINT32(0u, observer.outlet);
        TEST_ASSERT_TRUE((observer.gone == BELT_REAL(0)) && (observer.moment == BELT_REAL(0)));
        TEST_ASSERT_TRUE((observer.jumps == BELT_REAL(0)) &&
                         (observer.jumps_place == BELT_REAL(0)));
        TEST_ASSERT_TRUE(observer.fed_density == BELT_REAL(0));
        TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(1));
    }
}

static void test_rework_of_the_last_way_is_that_of_its_middle(void) {
    /* Of an empty cell half a spacing before the outlet, while 0.5 leaves: A*(D - x) at a quarter of
     * a spacing, for the time of half of one. */
    config.rework_rate = BELT_REAL(0.3);
    begin();
    observer.outlet_density = BELT_HALF;
    advance(0.125, 0.0);
    const double gained = (0.6 - 0.6 / 8.0 * 0.25) * 0.5 * 0.5 * 0.0625;
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON * gained, gained, (double)observer.modelled_density);
}

/** Much loss and rework for two belts, by one loss or by two that all but agree. */
static void run_lossy(uint16_t kinds) {
    config.rework_rate = BELT_REAL(0.3);
    config.loss_count = kinds;
    config.loss_rate[0] = BELT_REAL(3);
    config.loss_rate[1] = real_next(BELT_REAL(3), BELT_REAL(4));
    begin();
    for (int i = 0; i < 64; ++i) {
        advance(0.25, 1.0);
    }
}

static void test_profile_of_nearly_equal_values_ages_as_the_uniform_loss(void) {
    run_lossy(1);
    const belt_observer_t uniform = observer;
    run_lossy(2);
    for (uint32_t i = 0; i < line.cell_slots; ++i) {
        /* 64 periods of four roundings of up to 1. */
        TEST_ASSERT_DOUBLE_WITHIN(256 * EPSILON, (double)uniform.density[i],
                                  (double)observer.density[i]);
    }
}

static void test_cell_of_nothing_but_rework_has_no_step(void) {
    /* All of a cell is taken at the age of its centre, so what came back to it is even. */
    config.rework_rate = BELT_REAL(0.3);
    begin();
    belt_passage_t passage = {.duration = BELT_REAL(0.015625),
                              .travel = BELT_REAL(0.25),
                              .left_density = BELT_REAL(0.5),
                              .left_is_measured = true};
    for (int i = 0; i < 16; ++i) {
        belt_observer_advance(&observer, &line, &passage);
        if (i % 4 == 3) {
            /* A*D/8*0.5*0.0625 a spacing, from 0 to 1/2 in: 1/8 of it; and roundings of that. */
            const double gained = 0.3 * 2.0 / 8.0 * 0.5 * 0.0625 / 8.0;
            TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON * gained, gained, mean());
            TEST_ASSERT_DOUBLE_WITHIN(64 * EPSILON * gained, 0.0, step());
        }
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_init_clears_everything);
    RUN_TEST(test_even_feed_makes_a_cell_without_a_step_cut_in_its_middle);
    RUN_TEST(test_jump_at_the_cells_end_is_no_cut_in_it);
    RUN_TEST(test_one_jump_is_cut_and_step);
    RUN_TEST(test_cut_of_two_jumps_is_the_centre_of_their_squares);
    RUN_TEST(test_neither_side_of_a_cut_is_below_nothing);
    RUN_TEST(test_both_sides_of_a_cut_lose_alike);
    RUN_TEST(test_cut_keeps_off_the_ends_of_its_cell);
    RUN_TEST(test_cell_that_opens_is_empty);
    RUN_TEST(test_profile_leaves_nothing_of_what_the_ring_held);
    RUN_TEST(test_rework_of_the_last_way_is_that_of_its_middle);
    RUN_TEST(test_profile_of_nearly_equal_values_ages_as_the_uniform_loss);
    RUN_TEST(test_cell_of_nothing_but_rework_has_no_step);
    return UNITY_END();
}
