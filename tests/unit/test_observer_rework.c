/* SPDX-License-Identifier: MIT */
/* What comes back on the way, and what is measured at the outlet. */
#include "observer_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- rework --- */

/** Fills the belt with nothing but rework of a measured outlet density of 0.5. A material piece at x
 * then has picked up A*v*slowness*(D - x)^2/2, in spacings rework_per_spacing*v*pace*(20 - place)^2/2;
 * the midpoint rule is exact for it. */
static void assert_rework_of_a_known_outlet(double travel) {
    config.rework_rate = BELT_REAL(0.3);
    begin();
    for (int k = 0; k * travel < 24.35; ++k) {
        advance_measured(0.025, travel, 0.0, 0.5);
    }
    for (uint32_t k = 1; k <= last_cell(); ++k) {
        const double way = 20.0 - centre(k);
        const double truth = 0.3 * 2.0 / 20.0 * 0.5 * 0.025 * 0.5 * way * way;
        /* 20/travel sums of numbers up to 0.075: a rounding of that each. */
        TEST_ASSERT_DOUBLE_WITHIN(20.0 / travel * EPSILON * 0.075, truth, cell(k));
    }
}

static void test_rework_of_a_known_outlet_density(void) {
    assert_rework_of_a_known_outlet(1.0);
    assert_rework_of_a_known_outlet(0.5);
    assert_rework_of_a_known_outlet(0.125);
}

static void test_rework_goes_on_while_a_cell_closes_within_a_period(void) {
    assert_rework_of_a_known_outlet(0.3);
    assert_rework_of_a_known_outlet(0.71);
}

static void test_rework_with_loss(void) {
    /* After time a on the belt: A*v*w*(a/C - (1 - exp(-C*a))/C^2), w the speed. */
    config.rework_rate = BELT_REAL(0.3);
    config.loss_rate[0] = BELT_REAL(1.5);
    double worst[2] = {0.0, 0.0};
    for (int fine = 0; fine < 2; ++fine) {
        config.node_count = (uint16_t)(20 << fine);
        begin();
        const double pace = 0.5 / config.node_count;
        for (int k = 0; k * 0.5 < 1.2 * config.node_count; ++k) {
            advance_measured(pace, 0.5, 0.0, 0.5);
        }
        for (uint32_t k = 1; k < line.node_count; ++k) {
            const double age = pace * (config.node_count - centre(k));
            const double truth = 0.3 * 0.5 * 4.0 * (age / 1.5 + expm1(-1.5 * age) / (1.5 * 1.5));
            worst[fine] = fmax(worst[fine], fabs(cell(k) - truth));
        }
    }
    /* The rework of a period, up to 0.3*0.5*2*0.0125, keeps half its loss of 0.01875, to the square
     * of that; 40 times. Twice as fine: a quarter, or roundings. */
    TEST_ASSERT_TRUE(worst[0] < 40.0 * 0.00375 * 0.01875 * 0.01875 + 40 * EPSILON);
    TEST_ASSERT_TRUE(worst[1] < 0.3 * worst[0] + 80 * EPSILON);
}

static void test_rework_comes_from_the_belts_own_outlet_too(void) {
    /* Known after each period as outlet_density: the balance in + rework = out + change closes. Each
     * whole cell gains A*(D - x)*v*time. */
    config.rework_rate = BELT_REAL(0.3);
    begin();
    (void)leaving_after_filling(0.025, 0.5, 0.8);
    const double before = on_belt();
    advance(0.5, 0.8);
    /* Over all of the belt: A*D*v*time*20/2, while half a spacing is exchanged. */
    const double gained = 0.6 * left() * 0.0125 * 10.0;
    /* The outlet cell is aged ahead of its centre by up to half a cell, and the open one's centre
     * behind: a quarter of a spacing's rework, v*0.6*0.025/4, either end. */
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * 0.25 * 0.6 * 0.025 * left(), 0.5 * (0.8 - left()) + gained,
                              on_belt() - before);
}

static void test_belt_at_rest_in_the_papers_case_leaves_what_holds_the_setpoint(void) {
    config = paper_case();
    begin();
    const rest_t rest = line_at_rest(&config);
    const double pace = rest.slowness * 0.1;
    const double fed = rest.inlet_flux * rest.slowness;
    for (int i = 0; i < 5000; ++i) { /* the loop through the rework settles in a few transits */
        advance_at(pace, 0.37, fed);
    }
    for (int i = 0; i < 100; ++i) { /* wherever in a cell the outlet is */
        advance_at(pace, 0.37, fed);
        /* Second order in the rework of a spacing, A*D*pace = 0.0053, and in its loss, 0.0265:
         * their product, of the density. */
        TEST_ASSERT_DOUBLE_WITHIN(0.0053 * 0.0265 * 0.159 + 800 * EPSILON * 0.159,
                                  rest.outlet_density, left());
    }
}

/* --- the outlet --- */

static void test_measured_outlet_replaces_the_observers_own(void) {
    (void)leaving_after_filling(0.025, 0.3, 0.8);
    advance_measured(0.025, 0.3, 0.8, 0.125);
    TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(0.125));
    advance(0.3, 0.8);
    TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON, 0.8, left());
}

static void test_measured_outlet_that_is_not_to_be_used_is_not(void) {
    (void)leaving_after_filling(0.025, 0.3, 0.8);
    belt_passage_t passage = {.duration = BELT_REAL(0.0075),
                              .travel = BELT_REAL(0.3),
                              .fed_density = BELT_REAL(0.8),
                              .left_density = BELT_REAL(0.125)};
    belt_observer_advance(&observer, &line, &passage);
    TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON, 0.8, left());
}

static void test_rest_of_the_outlet_cell_is_what_its_two_sides_leave(void) {
    /* Profile 1 at the outlet, 0 one spacing on: sides 0.75 and 0.25. Travel in eighths. */
    belt_real_t density[BELT_NODE_CAPACITY + 1] = {BELT_REAL(1)};
    belt_observer_assume(&observer, &line, density);
    const double rests[] = {0.5,
                            (0.375 * 0.75 + 0.5 * 0.25) / 0.875,
                            (0.25 * 0.75 + 0.5 * 0.25) / 0.75,
                            (0.125 * 0.75 + 0.5 * 0.25) / 0.625,
                            0.25,
                            0.25,
                            0.25,
                            0.25};
    for (int i = 0; i < 8; ++i) {
        /* Division and three roundings. */
        TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, rests[i],
                                  (double)belt_observer_rest_of_outlet(&observer));
        advance(0.125, 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, (i < 4) ? 0.75 : 0.25, left());
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_rework_of_a_known_outlet_density);
    RUN_TEST(test_rework_goes_on_while_a_cell_closes_within_a_period);
    RUN_TEST(test_rework_with_loss);
    RUN_TEST(test_rework_comes_from_the_belts_own_outlet_too);
    RUN_TEST(test_belt_at_rest_in_the_papers_case_leaves_what_holds_the_setpoint);
    RUN_TEST(test_measured_outlet_replaces_the_observers_own);
    RUN_TEST(test_measured_outlet_that_is_not_to_be_used_is_not);
    RUN_TEST(test_rest_of_the_outlet_cell_is_what_its_two_sides_leave);
    return UNITY_END();
}
