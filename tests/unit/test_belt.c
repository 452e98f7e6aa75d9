/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/* --- misuse --- */

static void test_null_pointers_are_misuse(void) {
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_init(NULL, &config));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_init(&controller, NULL));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_step(&controller, &measurement, NULL));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_setpoint(NULL, BELT_REAL(0.3)));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_step(NULL, &measurement, &command));
    assert_nothing_is_fed();
    memset(&command, 0xA5, sizeof command);
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_step(&controller, NULL, &command));
    assert_nothing_is_fed();
    TEST_ASSERT_EQUAL_HEX32(0u, command.error_bits);
}

static void test_step_before_init_feeds_nothing(void) {
    const int memories[] = {0x00, 0xFF, 0xA5};
    for (size_t i = 0; i < sizeof memories / sizeof memories[0]; ++i) {
        memset(&controller, memories[i], sizeof controller);
        memset(&command, 0xA5, sizeof command);
        TEST_ASSERT_EQUAL(BELT_MISUSE, step_level(0.1));
        assert_nothing_is_fed();
        TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_setpoint(&controller, BELT_REAL(0.3)));
    }
}

static void test_step_after_a_refused_init_is_misuse(void) {
    memset(&controller, 0, sizeof controller);
    config.period = BELT_REAL(-1);
    TEST_ASSERT_EQUAL(BELT_PERIOD, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_MISUSE, step_level(0.1));
}

static void test_refused_second_init_leaves_the_controller_running(void) {
    (void)step_level(0.1);
    config.period = BELT_REAL(-1);
    TEST_ASSERT_EQUAL(BELT_PERIOD, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.1));
}

static void test_second_init_starts_anew(void) {
    static belt_controller_t fresh;
    for (int i = 0; i < 50; ++i) {
        (void)step_level(0.01 * i);
    }
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&fresh, &config));
    TEST_ASSERT_TRUE(memcmp(&controller, &fresh, sizeof fresh) == 0);
}

/* --- start again --- */

static void test_controller_can_start_again_with_its_own_configuration(void) {
    belt_command_t first;
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.1));
    first = command;
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.2));
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &controller.config));
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.1));
    TEST_ASSERT_TRUE(command.inlet_flux == first.inlet_flux);
}

/* --- the set-point --- */

static void test_refused_setpoint_leaves_the_old_one(void) {
    static belt_controller_t before;
    (void)step_level(0.1);
    before = controller;
    const belt_real_t refused[] = {BELT_REAL(0), BELT_REAL(-1), BELT_REAL(0.6), BELT_REAL(NAN),
                                   BELT_REAL(INFINITY)};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
        TEST_ASSERT_EQUAL(BELT_LEVEL_SETPOINT, belt_set_setpoint(&controller, refused[i]));
        TEST_ASSERT_TRUE(memcmp(&controller, &before, sizeof before) == 0);
    }
}

static void test_setpoint_whose_slope_is_too_steep_leaves_the_old_one(void) {
    /* At 0.004 the least slope is 1.192/0.004 = 298; with the margin of 200 it is too steep. */
    config.slope = BELT_REAL(200);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_PERIOD_PER_SLOPE, belt_set_setpoint(&controller, BELT_REAL(0.004)));
    TEST_ASSERT_TRUE(controller.config.level_setpoint == BELT_REAL(0.3));
    TEST_ASSERT_TRUE(controller.law.level_setpoint == BELT_REAL(0.3));
}

static void test_new_setpoint_is_that_of_a_controller_made_for_it(void) {
    static belt_controller_t other;
    config.level_setpoint = BELT_REAL(0.45);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&other, &config));
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_setpoint(&controller, BELT_REAL(0.45)));
    TEST_ASSERT_TRUE(memcmp(&controller, &other, sizeof other) == 0);
}

static void test_setpoint_change_moves_the_command_no_sooner_than_the_next_step(void) {
    (void)begin_at_rest();
    const belt_real_t before = command.inlet_flux;
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_setpoint(&controller, BELT_REAL(0.45)));
    TEST_ASSERT_TRUE(controller.command.inlet_flux == before);
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.3));
    TEST_ASSERT_TRUE(command.inlet_flux > before);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_null_pointers_are_misuse);
    RUN_TEST(test_step_before_init_feeds_nothing);
    RUN_TEST(test_step_after_a_refused_init_is_misuse);
    RUN_TEST(test_refused_second_init_leaves_the_controller_running);
    RUN_TEST(test_second_init_starts_anew);
    RUN_TEST(test_controller_can_start_again_with_its_own_configuration);
    RUN_TEST(test_refused_setpoint_leaves_the_old_one);
    RUN_TEST(test_setpoint_whose_slope_is_too_steep_leaves_the_old_one);
    RUN_TEST(test_new_setpoint_is_that_of_a_controller_made_for_it);
    RUN_TEST(test_setpoint_change_moves_the_command_no_sooner_than_the_next_step);
    return UNITY_END();
}
