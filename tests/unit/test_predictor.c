/* SPDX-License-Identifier: MIT */
/* Lines whose future is known in closed form. */
#include "predictor_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- exact special cases --- */

static void test_empty_line_takes_its_shortest_dead_time(void) {
    lay(nothing, nothing);
    march();
    TEST_ASSERT_TRUE(prediction.inlet.level == BELT_REAL(0));
    TEST_ASSERT_TRUE(prediction.inlet_rework == BELT_REAL(0));
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.5, (double)prediction.inlet.arrival);
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.25,
                              (double)belt_line_slowness(&model.line, prediction.inlet.congestion));
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.0, (double)prediction.inlet.congestion);
}

static void test_level_of_an_empty_belt_decays(void) {
    hold_speed();
    lay(nothing, level_constant);
    march();
    /* exp(-0.5); midpoint steps of 0.05 s: h^2/6 of the level for every second. */
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 6.0 * 0.5 * 0.4 + rounding(), 0.4 * exp(-0.5),
                              (double)prediction.inlet.level);
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.5, (double)prediction.inlet.arrival);
}

static void test_full_service_takes_parts_at_its_greatest_rate(void) {
    hold_speed();
    config.service_rate_max = BELT_REAL(0.2);
    lay(nothing, level_constant);
    march();
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.4 - 0.2 * 0.5, (double)prediction.inlet.level);
}

static void test_at_constant_speed_without_loss_the_march_is_the_smith_predictor(void) {
    hold_speed();
    forget_loss_and_rework();
    lay(half, level_constant);
    march();
    /* Q' = alpha*omega*rho - Q = 1 - Q for 0.5 s. */
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 6.0 * 0.5 * 0.6 + rounding(), 1.0 - 0.6 * exp(-0.5),
                              (double)prediction.inlet.level);
    TEST_ASSERT_TRUE(prediction.inlet_survival == BELT_REAL(1));
    TEST_ASSERT_TRUE(prediction.inlet_rework == BELT_REAL(0));
    for (uint32_t i = 0; i < prediction.inlet.count; ++i) {
        if (prediction.width[i] > BELT_REAL(0)) { /* nothing leaves with a stretch of no width */
            TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.5, (double)prediction.outlet_density[i]);
        }
    }
}

static void test_without_service_the_level_gains_every_part_on_the_belt(void) {
    hold_speed();
    forget_loss_and_rework();
    config.service_time = BELT_REAL(1e6);
    for (uint16_t nodes = 20; nodes <= 21; ++nodes) {
        config.node_count = nodes;
        lay(wave, nothing);
        double parts = 0.0;
        for (uint32_t i = 0; i < model.line.node_count; ++i) {
            parts += 0.5 * (double)model.line.spacing *
                     (wave((double)model.line.spacing * i) +
                      wave((double)model.line.spacing * (i + 1u)));
        }
        march();
        /* In 0.5 s a millionth of a level of 0.3 is served. */
        TEST_ASSERT_DOUBLE_WITHIN(rounding() + 2e-7, 0.5 * parts, (double)prediction.inlet.level);
    }
}

static void test_jumps_between_the_cells_of_a_pair_are_met_to_second_order(void) {
    hold_speed();
    forget_loss_and_rework();
    for (int first = 0; first <= 1; ++first) {
        lay(nothing, level_constant);
        belt_passage_t passage = {.travel = BELT_REAL(1), .duration = BELT_REAL(0.025)};
        double level = 0.4;
        for (int i = 0; i < 20; ++i) { /* every other cell full; each lasts 0.025 s */
            const double density = ((i + first) % 2 == 0) ? 1.0 : 0.0;
            passage.fed_density = BELT_REAL(density);
            belt_observer_advance(&model.observer, &model.line, &passage);
            level = 2.0 * density + (level - 2.0 * density) * exp(-0.025);
        }
        march();
        /* A pair is taken as of a straight line, whose moment is a third more than that of a jump in its
         * middle: of the 0.1 parts that each pair brings a 24th is put half a pair off, ten times over
         * 0.05 s of service, and h^2/6 of the level's rate, up to 2. */
        TEST_ASSERT_DOUBLE_WITHIN(10 * 0.2 / 24.0 * 0.05 + 0.05 * 0.05 / 6.0 * 0.5 * 2.0 +
                                      rounding(),
                                  level, (double)prediction.inlet.level);
    }
}

static void test_survival_at_constant_speed_is_exponential(void) {
    hold_speed();
    lay(nothing, nothing);
    march();
    /* Series over halves of 0.025: 40*0.0125^4/24. */
    TEST_ASSERT_DOUBLE_WITHIN(5e-8 + rounding(), exp(-0.5), (double)prediction.inlet_survival);
}

/** Settles the belt at rest by feeding it, until the outlet is `gone` into a cell. */
static rest_t settle(double travel, int more) {
    const rest_t rest = line_at_rest(&config);
    lay(nothing, level_setpoint);
    const double pace = rest.slowness * (double)model.line.spacing;
    belt_passage_t passage = {.travel = BELT_REAL(travel), .duration = BELT_REAL(travel * pace)};
    passage.fed_density = BELT_REAL(rest.inlet_flux * rest.slowness);
    passage.left_is_measured = true; /* the observer's own loop has its own tests */
    passage.left_density = BELT_REAL(rest.outlet_density);
    for (int i = 0; i < (int)(2.0 * config.node_count / travel) + more; ++i) {
        belt_observer_advance(&model.observer, &model.line, &passage);
    }
    return rest;
}

static void assert_rest_predicts_itself(const rest_t *rest) {
    /* Second order in the loss of a spacing, C*dwell: its square, of each number. */
    const double dwell = rest->dead_time / config.node_count * (double)config.loss_rate[0];
    const double part = dwell * dwell + rounding();
    const double survival = exp(-rest->dead_time * (double)config.loss_rate[0]);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.3, 0.3, (double)prediction.inlet.level);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.53, rest->dead_time, (double)prediction.inlet.arrival);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.265, rest->slowness,
                              (double)belt_line_slowness(&model.line, prediction.inlet.congestion));
    TEST_ASSERT_DOUBLE_WITHIN(part, rest->congestion, (double)prediction.inlet.congestion);
    TEST_ASSERT_DOUBLE_WITHIN(part, survival, (double)prediction.inlet_survival);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.159,
                              rest->outlet_density - survival * rest->inlet_flux * rest->slowness,
                              (double)prediction.inlet_rework);
    for (uint32_t i = 0; i < prediction.inlet.count; ++i) {
        if (prediction.width[i] > BELT_REAL(0)) { /* nothing leaves with a stretch of no width */
            TEST_ASSERT_DOUBLE_WITHIN(part * 0.159, rest->outlet_density,
                                      (double)prediction.outlet_density[i]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(part * 0.3, 0.3, (double)prediction.level[i + 1u]);
    }
}

static void test_line_at_rest_predicts_itself(void) {
    for (uint16_t nodes = 19; nodes <= 22; ++nodes) {
        config.node_count = nodes;
        const rest_t rest = settle(0.5, 2 * nodes % 2);
        march();
        assert_rest_predicts_itself(&rest);
    }
}

static void test_line_at_rest_predicts_itself_wherever_the_outlet_is_in_a_cell(void) {
    for (int more = 0; more < 40; ++more) { /* two cells, so both of a pair */
        const rest_t rest = settle(0.0625, more);
        march();
        assert_rest_predicts_itself(&rest);
    }
}

/* --- the shape of what the march hands on --- */

static void test_lines_and_stretches_add_up(void) {
    lay(wave, level_falling);
    for (int i = 0; i < 50; ++i) {
        belt_passage_t passage = {.travel = BELT_REAL(0.125),
                                  .duration = BELT_REAL(0.0034),
                                  .fed_density = BELT_REAL(0.25)};
        belt_observer_advance(&model.observer, &model.line, &passage);
        march();
        double width = 0.0;
        double time = 0.0;
        for (uint32_t k = 0; k < prediction.inlet.count; ++k) {
            TEST_ASSERT_DOUBLE_WITHIN(rounding(), time, (double)prediction.arrival[k]);
            width += (double)prediction.width[k];
            time += (double)prediction.width[k] * (double)prediction.pace[k];
        }
        TEST_ASSERT_DOUBLE_WITHIN(rounding() * 20.0, 20.0, width);
        TEST_ASSERT_DOUBLE_WITHIN(rounding(), time, (double)prediction.inlet.arrival);
        TEST_ASSERT_TRUE(prediction.level[0] == model.present.level);
        TEST_ASSERT_TRUE(prediction.level[prediction.inlet.count] == prediction.inlet.level);
        TEST_ASSERT_TRUE(prediction.arrival[prediction.inlet.count] == prediction.inlet.arrival);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_empty_line_takes_its_shortest_dead_time);
    RUN_TEST(test_level_of_an_empty_belt_decays);
    RUN_TEST(test_full_service_takes_parts_at_its_greatest_rate);
    RUN_TEST(test_at_constant_speed_without_loss_the_march_is_the_smith_predictor);
    RUN_TEST(test_without_service_the_level_gains_every_part_on_the_belt);
    RUN_TEST(test_jumps_between_the_cells_of_a_pair_are_met_to_second_order);
    RUN_TEST(test_survival_at_constant_speed_is_exponential);
    RUN_TEST(test_line_at_rest_predicts_itself);
    RUN_TEST(test_line_at_rest_predicts_itself_wherever_the_outlet_is_in_a_cell);
    RUN_TEST(test_lines_and_stretches_add_up);
    return UNITY_END();
}
