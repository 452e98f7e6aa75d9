/* SPDX-License-Identifier: MIT */
#include "safety_case.h"

/* A handful of operations, each rounded; the exponential is good to 2 units of a result near 1. */
#define ROUNDING (20.0 * EPSILON)
/* The rework ahead on 20 cells: midpoints of stretches of two, D/10, of y*exp(c*y). What they may miss,
 * 4/20^2, is added to it. */
#define MIDPOINTS 1.5e-3
#define ADDED 1.01

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

static void test_paper_case_by_hand(void) {
    begin_at(0.0);
    assess();
    const double density_max = 0.25 * 1.2 * 1.2 * 1.2 * exp(2.0 * 0.1 * 4.0 * 0.25 * 1.2);
    assert_near(0.6, (double)safety.proposition.flux_min, ROUNDING);
    assert_near(density_max, (double)safety.proposition.density_max, ROUNDING);
    assert_near(density_max / 0.6, (double)safety.proposition.left, ROUNDING);
    assert_near(2.0 / (0.1 * 4.0 * 1.2), (double)safety.proposition.right, ROUNDING);
    assert_near(2.0 / 0.48 * 0.6 / density_max, (double)safety.proposition.margin, ROUNDING);
    TEST_ASSERT_TRUE(safety.proposition.applies && safety.proposition.holds);
    /* Everything to come is fed by the law, at P*(1 + tau*Q*)*Bmax, on a line that was empty. */
    const double fed = 0.25 * crowded(0.3) * 1.2;
    assert_near(0.6, (double)safety.sharper.flux_min, ROUNDING);
    assert_near(fed, (double)safety.sharper.density_max, ROUNDING);
    assert_near(ADDED * fed * rework_of_one(1.0), (double)safety.sharper.left, MIDPOINTS);
    TEST_ASSERT_TRUE(safety.sharper.right == safety.sharper.flux_min);
    TEST_ASSERT_TRUE(safety.sharper.applies && safety.sharper.holds);
}

static void test_heavy_window_has_the_sharper_promise_only(void) {
    config.speed_window = BELT_REAL(0.8);
    config.congestion_scale = BELT_REAL(0.8) / BELT_REAL(3);
    begin_at(0.0);
    assess();
    assert_near(17.8043, (double)safety.proposition.left, 1e-4); /* as many digits as are stated */
    assert_near(1.25, (double)safety.proposition.right, ROUNDING);
    TEST_ASSERT_FALSE(safety.proposition.holds);
    TEST_ASSERT_TRUE(safety.proposition.applies && safety.sharper.holds);
}

static void test_rework_ahead_is_of_second_order_in_the_cells(void) {
    double error[2];
    for (uint16_t i = 0; i < 2u; ++i) {
        config.node_count = (uint16_t)(10u * (i + 1u));
        begin_at(0.0);
        assess();
        error[i] =
            (double)safety.sharper.left / (0.25 * crowded(0.3) * 1.2 * rework_of_one(1.0)) - 1.0;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 4.0, error[0] / error[1]); /* next order: a tenth */
}

static void test_without_rework_the_margin_is_the_greatest_number(void) {
    config.rework_rate = BELT_REAL(0);
    begin_at(0.1);
    assess();
    TEST_ASSERT_TRUE(safety.proposition.right == BELT_REAL_MAX);
    TEST_ASSERT_TRUE(safety.sharper.left == BELT_REAL(0));
    TEST_ASSERT_TRUE(safety.proposition.margin == BELT_REAL_MAX);
    TEST_ASSERT_TRUE(safety.sharper.margin == BELT_REAL_MAX);
    TEST_ASSERT_TRUE(safety.proposition.holds && safety.sharper.holds);
    assert_all_finite();
    controller.model.present.disturbance_flux = BELT_REAL(1.5); /* the law wants nothing either */
    assess();
    TEST_ASSERT_TRUE(safety.proposition.left == safety.proposition.right);
    TEST_ASSERT_TRUE(safety.sharper.left == safety.sharper.right);
    assert_no_promise();
}

static void test_least_flux_is_that_of_the_highest_level_to_come(void) {
    static belt_real_t density[BELT_NODE_CAPACITY + 1];
    begin_at(0.5); /* falls below the set-point while the empty belt passes */
    assess();
    const double now = (double)belt_nominal_law_flux(&controller.law, BELT_REAL(0.5));
    TEST_ASSERT_TRUE(controller.prediction.inlet.level < BELT_REAL(0.3));
    assert_near(now, (double)safety.proposition.flux_min, ROUNDING); /* as the paper has it */
    assert_near(0.6, (double)safety.sharper.flux_min, ROUNDING);
    for (size_t i = 0; i <= 20u; ++i) {
        density[i] = BELT_HALF;
    }
    begin_loaded(0.2, density);
    assess();
    const belt_real_t last = controller.prediction.inlet.level;
    TEST_ASSERT_TRUE(last > BELT_REAL(0.35));
    const double then = (double)belt_nominal_law_flux(&controller.law, last);
    assert_near(then, (double)safety.proposition.flux_min, ROUNDING);
    assert_near(then, (double)safety.sharper.flux_min, ROUNDING);
}

/** On a line whose speed hangs on the level: the empty belt's rework, by hand. */
static void assert_falling(const double *levels, size_t count) {
    begin_at(levels[0]);
    for (size_t i = 1; i < count; ++i) {
        (void)step_level(levels[i]);
    }
    assess();
    const double lowest = (double)controller.prediction.inlet.level; /* below Q*, then up to it */
    TEST_ASSERT_TRUE(lowest < 0.3);
    const double slope = (double)config.speed_window / (double)config.congestion_scale;
    const double falling = 1.0 + slope * (0.5 - lowest) / crowded(lowest);
    const double flux_max = (double)belt_nominal_law_flux(&controller.law, BELT_REAL(lowest));
    const double fed = 0.25 * crowded(0.5) * flux_max;
    assert_near(fed, (double)safety.sharper.density_max, ROUNDING);
    assert_near(ADDED * falling * fed * rework_of_one(crowded(lowest)), (double)safety.sharper.left,
                MIDPOINTS);
}

static void test_falling_levels_weigh_the_rework_by_the_deepest_fall(void) {
    /* the peak: before the window's end, now, a period ago, before that; a cell passes in ten */
    const double first[] = {0.5, 0.45, 0.475, 0.4, 0.4, 0.4, 0.4, 0.4};
    const double now[] = {0.4, 0.5};
    const double last[] = {0.4, 0.45, 0.5, 0.4};
    const double before[] = {0.4, 0.5, 0.45, 0.42, 0.4};
    config.speed_window = BELT_REAL(0.8);
    config.congestion_scale = BELT_REAL(0.4);
    assert_falling(first, sizeof first / sizeof first[0]);
    assert_falling(now, sizeof now / sizeof now[0]);
    assert_falling(last, sizeof last / sizeof last[0]);
    assert_falling(before, sizeof before / sizeof before[0]);
}

static void test_rework_ahead_does_not_hang_on_how_the_cells_lie(void) {
    begin_at(0.0);
    for (int i = 0; i < 45; ++i) { /* four cells and a half pass, nothing is fed */
        (void)step_level(0.0);
        assess();
        const double fed = 0.25 * crowded(0.3) * 1.2;
        assert_near(ADDED * fed * rework_of_one(1.0), (double)safety.sharper.left, MIDPOINTS);
    }
}

/** Integral of A*y*p2(y + xi), p2 linear between `density` and `fed` behind them, by small steps. */
static double rework_moved(const belt_real_t *density, double fed, double xi) {
    const int steps = 2000;
    const double dx = 2.0 / steps;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double y = ((double)i + 0.5) * dx;
        const double place = (y + xi) * 10.0;
        const size_t node = (size_t)place;
        const double share = place - (double)node;
        sum += y * ((node < 20u)
                        ? (1.0 - share) * (double)density[node] + share * (double)density[node + 1u]
                        : fed);
    }
    return (double)config.rework_rate * sum * dx;
}

static void test_material_that_is_known_moves_on_and_what_is_fed_follows(void) {
    static belt_real_t density[BELT_NODE_CAPACITY + 1];
    config.rework_rate = BELT_REAL(0.001);
    config.loss_rate[0] = BELT_REAL(0);
    for (size_t i = 0; i <= 20u; ++i) { /* a heap near the inlet */
        density[i] = BELT_REAL((i >= 16u) ? 0.8 : 0.02);
    }
    begin_loaded(0.1, density);
    assess();
    const belt_real_t last = controller.prediction.inlet.level;
    TEST_ASSERT_TRUE(last < BELT_REAL(0.3));
    const double fed = 0.25 * crowded(0.3) * (double)belt_nominal_law_flux(&controller.law, last);
    const double at_once = rework_moved(density, fed, 0.0);
    const double at_last = rework_moved(density, fed, 2.0);
    double greatest = 0.0;
    for (int i = 0; i <= 200; ++i) {
        greatest = fmax(greatest, rework_moved(density, fed, 0.01 * i));
    }
    TEST_ASSERT_TRUE(greatest > 1.05 * fmax(at_once, at_last));
    /* the belt's own rework, 0.1 %; the maximum is looked for at the lines of the march: 0.5 % */
    assert_near(ADDED * greatest, (double)safety.sharper.left, 0.005);
    assert_near(0.8, (double)safety.sharper.density_max, 2e-3);
}

static void test_belt_denser_than_what_is_fed_counts_as_it_is(void) {
    static belt_real_t density[BELT_NODE_CAPACITY + 1];
    config.rework_rate = BELT_REAL(0.001);
    config.loss_rate[0] = BELT_REAL(0);
    for (size_t i = 0; i <= 20u; ++i) {
        density[i] = BELT_HALF;
    }
    begin_loaded(0.0, density);
    assess();
    /* nothing is lost, the belt's own rework adds 0.1 %, and the level comes down to Q* again */
    const double last = (double)controller.prediction.inlet.level;
    const double falling = 1.0 + 0.2 * (last - 0.3);
    TEST_ASSERT_TRUE(last > 0.35);
    assert_near(0.5, (double)safety.sharper.density_max, 2e-3);
    assert_near(ADDED * falling * 0.5 * 0.001 * 2.0, (double)safety.sharper.left, 2e-3);
    for (size_t i = 3; i <= 20u; ++i) {
        density[i] = BELT_REAL(0);
    }
    begin_loaded(0.0, density); /* two cells at the outlet only */
    assess();
    assert_near(0.5, (double)safety.sharper.density_max, 2e-3);
}

static void test_jump_is_what_the_first_command_will_put_on_the_belt(void) {
    begin_at(0.0);
    assess();
    /* nothing on the belt: all that arrives must be fed, u(Q*, 0)*P less what is lost on the way */
    assert_near(-0.25 * 1.2 * exp(0.25 * 2.0), (double)safety.jump, 1e-4); /* 20 cells */
    start();
    measurement.present = BELT_HAS_LEVEL;
    (void)begin_at_rest();
    assess();
    /* at rest nothing jumps; 20 cells leave 1.5e-4 of the 0.26 there */
    TEST_ASSERT_DOUBLE_WITHIN(2e-4, 0.0, (double)safety.jump);
}

static void test_disturbance_changes_what_the_law_wants(void) {
    begin_at(0.0);
    controller.model.present.disturbance_flux = BELT_REAL(0.1);
    assess();
    assert_near(0.5, (double)safety.proposition.flux_min, ROUNDING);
    assert_near(0.5, (double)safety.sharper.flux_min, ROUNDING);
    assert_near(0.25 * crowded(0.3) * 1.1, (double)safety.sharper.density_max, ROUNDING);
    const double before = (double)safety.proposition.density_max;
    controller.model.present.disturbance_flux = BELT_REAL(-0.1);
    assess();
    assert_near(0.7, (double)safety.proposition.flux_min, ROUNDING);
    assert_near(before * 1.3 / 1.2, (double)safety.proposition.density_max, ROUNDING);
    controller.model.present.disturbance_flux = BELT_REAL(0.7); /* more than the set-point needs */
    assess();
    TEST_ASSERT_TRUE(safety.proposition.left == BELT_REAL_MAX);
    TEST_ASSERT_TRUE(safety.sharper.right == BELT_REAL(0));
    assert_no_promise();
    assert_all_finite();
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_paper_case_by_hand);
    RUN_TEST(test_heavy_window_has_the_sharper_promise_only);
    RUN_TEST(test_rework_ahead_is_of_second_order_in_the_cells);
    RUN_TEST(test_without_rework_the_margin_is_the_greatest_number);
    RUN_TEST(test_least_flux_is_that_of_the_highest_level_to_come);
    RUN_TEST(test_falling_levels_weigh_the_rework_by_the_deepest_fall);
    RUN_TEST(test_rework_ahead_does_not_hang_on_how_the_cells_lie);
    RUN_TEST(test_material_that_is_known_moves_on_and_what_is_fed_follows);
    RUN_TEST(test_belt_denser_than_what_is_fed_counts_as_it_is);
    RUN_TEST(test_jump_is_what_the_first_command_will_put_on_the_belt);
    RUN_TEST(test_disturbance_changes_what_the_law_wants);
    return UNITY_END();
}
