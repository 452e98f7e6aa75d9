/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/* --- what is asked for --- */

static void test_automatic_is_asked_for_at_first(void) {
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, controller.supervisor.requested);
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.1));
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
}

static void test_unknown_modes_are_refused_and_the_old_request_stands(void) {
    static belt_controller_t before;
    const belt_mode_t unknown[] = {BELT_MODE_HOLD, BELT_MODE_SUBSTITUTE, (belt_mode_t)5,
                                   (belt_mode_t)255};
    ask(BELT_MODE_MANUAL);
    before = controller;
    for (size_t i = 0; i < sizeof unknown / sizeof unknown[0]; ++i) {
        TEST_ASSERT_EQUAL(BELT_UNKNOWN_MODE, belt_set_mode(&controller, unknown[i]));
        TEST_ASSERT_TRUE(memcmp(&before, &controller, sizeof before) == 0);
    }
}

static void test_manual_flux_is_refused_unless_manual_is_asked_for(void) {
    TEST_ASSERT_EQUAL(BELT_NOT_MANUAL, belt_set_manual_flux(&controller, BELT_REAL(0.5)));
    ask(BELT_MODE_OFF);
    TEST_ASSERT_EQUAL(BELT_NOT_MANUAL, belt_set_manual_flux(&controller, BELT_REAL(0.5)));
    TEST_ASSERT_TRUE(controller.supervisor.manual_flux == BELT_REAL(0));
}

static void test_manual_flux_outside_the_limits_is_refused_and_the_old_one_stands(void) {
    config.inlet_flux_max = BELT_REAL(1.5);
    start();
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(1.5)));
    const belt_real_t refused[] = {real_next(BELT_REAL(1.5), BELT_REAL(2)), BELT_REAL(-1e-30),
                                   BELT_REAL(NAN), BELT_REAL(INFINITY)};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
        TEST_ASSERT_EQUAL(BELT_MANUAL_FLUX, belt_set_manual_flux(&controller, refused[i]));
        TEST_ASSERT_TRUE(controller.supervisor.manual_flux == BELT_REAL(1.5));
    }
}

static void test_misuse_of_the_calls_from_outside_changes_nothing(void) {
    static belt_controller_t empty;
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_mode(NULL, BELT_MODE_OFF));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_manual_flux(NULL, BELT_REAL(0)));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_mode(&empty, BELT_MODE_OFF));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_manual_flux(&empty, BELT_REAL(0)));
    TEST_ASSERT_FALSE(belt_is_running(NULL));
    TEST_ASSERT_FALSE(belt_is_running(&empty));
    TEST_ASSERT_FALSE(belt_is_running(&controller)); /* no level yet */
    (void)step_level(0.1);
    TEST_ASSERT_TRUE(belt_is_running(&controller));
}

/* --- off --- */

static void test_off_is_nothing_at_once(void) {
    (void)begin_at_rest();
    ask(BELT_MODE_OFF);
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.3));
    assert_nothing_is_fed();
}

static void test_off_closes_within_the_rate_limit_and_stays_closed(void) {
    config.flux_rate_max = BELT_REAL(40); /* 0.1 parts/s a step */
    start();
    steps_level(0.2, 100u);
    ask(BELT_MODE_OFF);
    for (double last = flux(); last > 0.0; last = flux()) {
        (void)step_level(0.2);
        TEST_ASSERT_EQUAL(BELT_MODE_OFF, command.mode);
        /* A rounding of a flux of up to 2. */
        TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON, fmax(0.0, last - 0.1), flux());
    }
    steps_level(0.2, 10u);
    assert_nothing_is_fed();
}

static void test_controller_that_is_off_follows_the_belt(void) {
    (void)begin_at_rest();
    const double full = on_belt();
    ask(BELT_MODE_OFF);
    steps_level(0.3, 250u); /* the dead time is 212 periods */
    TEST_ASSERT_TRUE(full > 1.0);
    /* Rework puts a twentieth of what leaves back on the belt: A D P D/2. */
    TEST_ASSERT_TRUE(on_belt() < 0.06 * full);
}

/* --- manual --- */

static void test_manual_begins_with_the_last_command_and_keeps_it(void) {
    steps_level(0.2, 50u);
    const double last = flux();
    ask(BELT_MODE_MANUAL);
    for (int i = 0; i < 100; ++i) {
        (void)step_level(0.2 + 0.002 * i);
        TEST_ASSERT_EQUAL(BELT_MODE_MANUAL, command.mode);
        TEST_ASSERT_TRUE(flux() == last);
    }
}

static void test_manual_flux_is_fed_at_once_within_the_rate_limit(void) {
    (void)begin_at_rest();
    ask(BELT_MODE_MANUAL);
    (void)step_level(0.3);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.25)));
    (void)step_level(0.3);
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.25));
}

static void test_manual_works_with_a_dead_sensor_from_a_cold_start(void) {
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.75)));
    for (int i = 0; i < 300; ++i) {
        TEST_ASSERT_EQUAL(BELT_NO_LEVEL, step_blind());
        TEST_ASSERT_EQUAL(BELT_MODE_MANUAL, command.mode);
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_MISSING, command.error_bits);
        TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.75));
    }
    ask(BELT_MODE_AUTOMATIC);
    TEST_ASSERT_EQUAL(BELT_NO_LEVEL, step_blind());
    assert_nothing_is_fed();
}

static void test_manual_works_under_every_error(void) {
    steps_level(0.2, 20u);
    ask(BELT_MODE_MANUAL);
    (void)step_level(0.2);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.75)));
    const double levels[] = {NAN, INFINITY, -1.0, 0.9, 2.0};
    for (int i = 0; i < 300; ++i) {
        TEST_ASSERT_EQUAL(BELT_INPUT_REJECTED, step_level(levels[i % 5]));
        TEST_ASSERT_EQUAL(BELT_MODE_MANUAL, command.mode);
        TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.75));
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_automatic_is_asked_for_at_first);
    RUN_TEST(test_unknown_modes_are_refused_and_the_old_request_stands);
    RUN_TEST(test_manual_flux_is_refused_unless_manual_is_asked_for);
    RUN_TEST(test_manual_flux_outside_the_limits_is_refused_and_the_old_one_stands);
    RUN_TEST(test_misuse_of_the_calls_from_outside_changes_nothing);
    RUN_TEST(test_off_is_nothing_at_once);
    RUN_TEST(test_off_closes_within_the_rate_limit_and_stays_closed);
    RUN_TEST(test_controller_that_is_off_follows_the_belt);
    RUN_TEST(test_manual_begins_with_the_last_command_and_keeps_it);
    RUN_TEST(test_manual_flux_is_fed_at_once_within_the_rate_limit);
    RUN_TEST(test_manual_works_with_a_dead_sensor_from_a_cold_start);
    RUN_TEST(test_manual_works_under_every_error);
    return UNITY_END();
}
