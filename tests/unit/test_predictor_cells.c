/* SPDX-License-Identifier: MIT */
/* The march wherever in a cell the outlet is: half a pair, an open cell, both. */
#include "predictor_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/** Moves the belt on by a quarter of a cell, `count` times, and feeds a saw. */
static void move_on(int count) {
    for (int i = 0; i < count; ++i) {
        const belt_passage_t passage = {.travel = BELT_REAL(0.25),
                                        .duration =
                                            BELT_REAL(0.25 * 0.25 * (double)model.line.spacing),
                                        .fed_density = BELT_REAL(0.125 * ((i * 5) % 8))};
        belt_observer_advance(&model.observer, &model.line, &passage);
    }
}

/** Parts on the belt. */
static double on_belt(void) {
    const double gone = (double)model.observer.gone;
    double sum = (1.0 - gone) * (double)belt_observer_rest_of_outlet(&model.observer);
    for (uint32_t i = 1; i < model.line.node_count; ++i) {
        sum +=
            (double)
                model.observer.density[belt_observer_behind(&model.line, model.observer.outlet, i)];
    }
    const uint32_t open =
        belt_observer_behind(&model.line, model.observer.outlet, model.line.node_count);
    return (double)model.line.spacing * (sum + gone * (double)model.observer.density[open]);
}

static void test_without_service_every_part_arrives_wherever_the_outlet_is(void) {
    hold_speed();
    forget_loss_and_rework();
    config.service_time = BELT_REAL(1e6);
    for (uint16_t nodes = 20; nodes <= 21; ++nodes) {
        config.node_count = nodes;
        lay(wave, nothing);
        for (int i = 0; i < 60; ++i) {
            move_on(1 + i % 3);
            march();
            /* In 0.5 s a millionth of a level of 0.5 is served. */
            TEST_ASSERT_DOUBLE_WITHIN(rounding() + 3e-7, 0.5 * on_belt(),
                                      (double)prediction.inlet.level);
        }
    }
}

static void test_level_follows_what_is_still_to_leave(void) {
    /* The same, line by line: each adds what its stretch holds. */
    hold_speed();
    forget_loss_and_rework();
    config.service_time = BELT_REAL(1e6);
    lay(wave, nothing);
    move_on(27);
    march();
    double level = 0.0;
    for (uint32_t i = 0; i < prediction.inlet.count; ++i) {
        level += 0.5 * (double)model.line.spacing * (double)prediction.width[i] *
                 (double)prediction.outlet_density[i];
        TEST_ASSERT_DOUBLE_WITHIN(rounding() + 3e-7, level, (double)prediction.level[i + 1u]);
    }
}

static future_t found(void) {
    const future_t future = {(double)prediction.inlet.level, (double)prediction.inlet.arrival,
                             (double)prediction.inlet.congestion, (double)prediction.inlet_survival,
                             (double)prediction.inlet_rework};
    return future;
}

static void test_profile_of_nearly_equal_values_is_the_uniform_loss_wherever_the_outlet_is(void) {
    config.loss_count = 2;
    config.loss_rate[1] = real_next(config.loss_rate[0], BELT_REAL(2));
    for (uint16_t nodes = 20; nodes <= 21; ++nodes) {
        config.node_count = nodes;
        lay(wave, level_falling);
        for (int i = 0; i < 40; ++i) {
            move_on(1);
            model.line.loss_is_uniform = false;
            march();
            const future_t profile = found();
            const double slope = (double)prediction.inlet_rework_slope;
            model.line.loss_is_uniform = true;
            march();
            /* Two second-order ways to the same: a twentieth of loss a pair, its square over 12. */
            TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 12.0 + rounding(), 0.0, distance(&profile));
            TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 + rounding(), slope,
                                      (double)prediction.inlet_rework_slope);
        }
    }
}

static void test_survival_is_that_of_the_whole_way_wherever_the_outlet_is(void) {
    hold_speed();
    for (uint16_t kinds = 1; kinds <= 2; ++kinds) {
        config.loss_count = kinds;
        config.loss_rate[1] = BELT_REAL(2); /* mean 1 or 1.5 over 0.5 s */
        lay(nothing, nothing);
        const double survival = exp((kinds == 1) ? -0.5 : -0.75);
        for (int i = 0; i < 40; ++i) {
            move_on(1);
            march();
            /* Series over at most two spacings of 0.05: 10*0.1^4/24. */
            TEST_ASSERT_DOUBLE_WITHIN(5e-5 + rounding(), survival,
                                      (double)prediction.inlet_survival);
        }
    }
}

/** What leaves of the outlet cell, by itself: moved on from where the cell's density counts, its own middle
 * or, once that has left, the outlet, to the middle of its rest, and from there to the outlet. */
static void assert_rest_of_outlet_leaves_with(double gone, double exponent, double close) {
    model.observer.outlet = 1u; /* the second of its pair: it leaves alone */
    model.observer.gone = BELT_REAL(gone);
    march();
    TEST_ASSERT_DOUBLE_WITHIN(0.5 * close + rounding(), 0.5 * exp(exponent),
                              (double)prediction.outlet_density[0]);
}

/** The greatest loss that a configuration may have, a quarter on a spacing. Of the quarter or so of a cell
 * in between the loss is 1/32: exp() up to its cube; the series of the rest's own way to the fourth. */
static void test_rest_of_the_outlet_cell_leaves_at_the_age_of_its_own_middle(void) {
    hold_speed();
    forget_loss_and_rework();
    config.loss_rate[0] = BELT_REAL(10);
    lay(half, nothing);
    const double loss = 10.0 * 0.025;
    const double between = 0.125 * loss;
    const double close = between * between * between + pow(0.375 * loss, 4.0) / 20.0;
    assert_rest_of_outlet_leaves_with(0.25, -0.25 * loss, close);
    assert_rest_of_outlet_leaves_with(0.75, 0.0, close);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_without_service_every_part_arrives_wherever_the_outlet_is);
    RUN_TEST(test_level_follows_what_is_still_to_leave);
    RUN_TEST(test_profile_of_nearly_equal_values_is_the_uniform_loss_wherever_the_outlet_is);
    RUN_TEST(test_survival_is_that_of_the_whole_way_wherever_the_outlet_is);
    RUN_TEST(test_rest_of_the_outlet_cell_leaves_at_the_age_of_its_own_middle);
    return UNITY_END();
}
