/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/* --- the first levels --- */

static void test_without_any_level_nothing_is_fed(void) {
    measurement.present = 0u;
    TEST_ASSERT_EQUAL(BELT_NO_LEVEL, belt_step(&controller, &measurement, &command));
    assert_nothing_is_fed();
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_MISSING, command.error_bits);
    measurement.present = BELT_HAS_LEVEL;
    TEST_ASSERT_EQUAL(BELT_NO_LEVEL, step_level(NAN));
    assert_nothing_is_fed();
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_INVALID, command.error_bits);
}

static void test_first_level_fills_the_whole_window(void) {
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25));
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
    /* 0.25 over 0.2 s: a quantum a level and six roundings. */
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON, 0.05, (double)controller.model.present.congestion);
    TEST_ASSERT_DOUBLE_WITHIN(
        8 * EPSILON, 0.25, (double)belt_level_history_at(&controller.model.history, BELT_REAL(80)));
}

static void test_second_level_is_one_of_many(void) {
    (void)step_level(0.25);
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.5));
    /* Half a period of 0.25 more. */
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, 0.05 + 0.5 * 0.0025 * 0.25,
                              (double)controller.model.present.congestion);
}

static void test_lost_level_is_said_and_the_last_one_stands_in(void) {
    (void)step_level(0.25);
    measurement.present = 0u;
    TEST_ASSERT_EQUAL(BELT_INPUT_REJECTED, belt_step(&controller, &measurement, &command));
    TEST_ASSERT_EQUAL(BELT_MODE_HOLD, command.mode);
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_MISSING, command.error_bits);
    TEST_ASSERT_TRUE(controller.model.present.level == BELT_REAL(0.25));
}

/* --- what is fed reaches the belt --- */

static void test_applied_flux_is_what_lies_on_the_belt_and_not_the_command(void) {
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(command.inlet_flux > BELT_REAL(1)); /* an empty line is asked to be filled */
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX;
    measurement.applied_flux = BELT_REAL(0);
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(on_belt() == 0.0);
    measurement.present = BELT_HAS_LEVEL;
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(on_belt() > 0.0);
}

static void test_first_part_fed_is_as_dense_as_flux_over_speed(void) {
    (void)step_level(0.0);
    const double fed = (double)command.inlet_flux;
    (void)step_level(0.0);
    /* Speed 4 m/s; a period's loss of 1/s at most. */
    TEST_ASSERT_DOUBLE_WITHIN(0.0025 * fed / 4.0, fed / 4.0, on_belt());
}

static void test_inlet_flux_is_limited(void) {
    config.inlet_flux_max = BELT_REAL(0.5);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.5));
}

static void test_measured_density_lies_on_the_belt(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = BELT_REAL(0.25);
    }
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_DENSITY;
    measurement.density = density;
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.0));
    TEST_ASSERT_DOUBLE_WITHIN(20 * EPSILON, 0.25 * 20.0, on_belt());
}

static void test_measured_outlet_flux_is_taken_as_density(void) {
    (void)step_level(0.25);
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_OUTLET_FLUX;
    measurement.outlet_flux = BELT_REAL(0.5);
    (void)step_level(0.25);
    /* 0.5 at 4/1.05 m/s. */
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, 0.5 * 1.05 / 4.0,
                              (double)controller.model.observer.outlet_density);
}

static void test_refused_outlet_flux_leaves_the_observers_own(void) {
    static belt_controller_t without;
    belt_command_t of_without;
    (void)step_level(0.25);
    without = controller;
    measurement.level = BELT_REAL(0.25);
    TEST_ASSERT_EQUAL(BELT_OK, belt_step(&without, &measurement, &of_without));
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_OUTLET_FLUX;
    measurement.outlet_flux = BELT_REAL(-0.5);
    TEST_ASSERT_EQUAL(BELT_INPUT_REJECTED, step());
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_OUTLET_FLUX_INVALID, command.error_bits);
    TEST_ASSERT_TRUE(command.inlet_flux == of_without.inlet_flux);
}

static void test_refused_density_leaves_the_observers_own(void) {
    static belt_controller_t without;
    belt_command_t of_without;
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    memset(density, 0, sizeof density);
    density[7] = BELT_REAL(-0.25);
    (void)step_level(0.25);
    without = controller;
    measurement.level = BELT_REAL(0.25);
    TEST_ASSERT_EQUAL(BELT_OK, belt_step(&without, &measurement, &of_without));
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_DENSITY;
    measurement.density = density;
    TEST_ASSERT_EQUAL(BELT_INPUT_REJECTED, step());
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_DENSITY_RANGE, command.error_bits);
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode); /* the level is as good as before */
    TEST_ASSERT_TRUE(command.inlet_flux == of_without.inlet_flux);
}

static void test_line_at_rest_is_fed_the_flux_that_holds_it(void) {
    const double holding = begin_at_rest();
    /* Second order on 20 cells: 0.0265^2/8 of the belt's density between the nodes, which the law's
     * slope of 22 turns into flux, times the gain of the belt, alpha*density over 0.5 s. */
    TEST_ASSERT_DOUBLE_WITHIN(22.0 * 0.0265 * 0.0265 / 8.0 * 0.3 + 100 * EPSILON, holding, flux());
}

/* --- what is left 0 is the paper's law --- */

static void test_without_estimator_a_sound_line_gets_the_papers_bits_whatever_else_is_stated(void) {
    static belt_controller_t stated;
    belt_command_t of_stated;
    config.estimator_time = BELT_REAL(0.6);
    config.flux_rate_max = BELT_REAL(1e5); /* 250 parts/s a step: never reached */
    config.substitute_flux = BELT_REAL(0.4);
    config.level_step_max = BELT_REAL(0.5);
    config.transfer_time = BELT_REAL(1);
    config.sample_periods = 3;
    config.hold_periods = 7;
    config.recovery_samples = 4;
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&stated, &config));
    for (uint32_t i = 0; i < 2000u; ++i) {
        measurement.level = BELT_REAL(0.3 - 0.3 * cos(0.01 * i));
        const belt_status_t status = belt_step(&stated, &measurement, &of_stated);
        TEST_ASSERT_EQUAL(BELT_OK, status);
        TEST_ASSERT_EQUAL(status, step());
        TEST_ASSERT_TRUE(real_bits(command.inlet_flux) == real_bits(of_stated.inlet_flux));
        TEST_ASSERT_TRUE(controller.model.estimator.disturbance == BELT_REAL(0));
        TEST_ASSERT_TRUE(controller.model.present.level == measurement.level);
    }
}

static void test_counts_that_say_all_is_in_order_change_no_bit(void) {
    static belt_controller_t counted;
    belt_command_t of_counted;
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&counted, &config));
    for (uint32_t i = 0; i < 300u; ++i) {
        measurement.present = BELT_HAS_LEVEL;
        measurement.level = BELT_REAL(0.001 * i);
        TEST_ASSERT_EQUAL(BELT_OK, step());
        measurement.present |= BELT_HAS_SAMPLE_COUNT | BELT_HAS_ELAPSED_TICKS;
        measurement.sample_count = UINT32_MAX - 100u + i;
        measurement.elapsed_ticks = 1u;
        TEST_ASSERT_EQUAL(BELT_OK, belt_step(&counted, &measurement, &of_counted));
        TEST_ASSERT_TRUE(real_bits(of_counted.inlet_flux) == real_bits(command.inlet_flux));
    }
}

static void test_counts_that_are_not_present_are_not_read(void) {
    static belt_controller_t counted;
    belt_command_t of_counted;
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&counted, &config));
    for (uint32_t i = 0; i < 300u; ++i) {
        measurement.level = BELT_REAL(0.001 * i);
        measurement.sample_count = 0u;
        measurement.elapsed_ticks = 0u;
        TEST_ASSERT_EQUAL(BELT_OK, step());
        measurement.sample_count = UINT32_MAX - 100u + i;
        measurement.elapsed_ticks = UINT32_MAX - i;
        TEST_ASSERT_EQUAL(BELT_OK, belt_step(&counted, &measurement, &of_counted));
        TEST_ASSERT_TRUE(of_counted.inlet_flux == command.inlet_flux);
    }
}

static void test_estimator_believes_the_models_outlet_flux_and_not_the_measured_one(void) {
    static belt_controller_t other;
    config.estimator = BELT_ESTIMATOR_ON;
    start();
    (void)begin_at_rest();
    steps_level(0.25, 20u);
    other = controller;
    (void)step_level(0.25);
    const belt_estimator_t by_model = controller.model.estimator;
    controller = other;
    measurement.present |= BELT_HAS_OUTLET_FLUX;
    measurement.outlet_flux = BELT_REAL(0.1); /* a third of the model's */
    (void)step_level(0.25);
    TEST_ASSERT_TRUE(controller.model.estimator.level == by_model.level);
    TEST_ASSERT_TRUE(controller.model.estimator.disturbance == by_model.disturbance);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_without_any_level_nothing_is_fed);
    RUN_TEST(test_first_level_fills_the_whole_window);
    RUN_TEST(test_second_level_is_one_of_many);
    RUN_TEST(test_lost_level_is_said_and_the_last_one_stands_in);
    RUN_TEST(test_applied_flux_is_what_lies_on_the_belt_and_not_the_command);
    RUN_TEST(test_first_part_fed_is_as_dense_as_flux_over_speed);
    RUN_TEST(test_inlet_flux_is_limited);
    RUN_TEST(test_measured_density_lies_on_the_belt);
    RUN_TEST(test_measured_outlet_flux_is_taken_as_density);
    RUN_TEST(test_refused_outlet_flux_leaves_the_observers_own);
    RUN_TEST(test_refused_density_leaves_the_observers_own);
    RUN_TEST(test_line_at_rest_is_fed_the_flux_that_holds_it);
    RUN_TEST(test_without_estimator_a_sound_line_gets_the_papers_bits_whatever_else_is_stated);
    RUN_TEST(test_counts_that_say_all_is_in_order_change_no_bit);
    RUN_TEST(test_counts_that_are_not_present_are_not_read);
    RUN_TEST(test_estimator_believes_the_models_outlet_flux_and_not_the_measured_one);
    return UNITY_END();
}
