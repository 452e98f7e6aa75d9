/* SPDX-License-Identifier: MIT */
#include "snapshot_case.h"

void setUp(void) {
    begin_snapshots();
}

void tearDown(void) {
}

/* --- a stop --- */

static void test_short_stop_is_made_up_for_in_the_next_step(void) {
    belt_command_t answer;
    take();
    const uint32_t stops[] = {1u, 2u, 79u};
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; ++i) {
        TEST_ASSERT_EQUAL(BELT_OK, restore(stops[i]));
        measurement.present = BELT_HAS_LEVEL | BELT_HAS_ELAPSED_TICKS;
        measurement.elapsed_ticks = 1u;
        TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_restored(0.25, &answer));
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIODS_LATE, answer.error_bits);
        TEST_ASSERT_EQUAL_UINT32(stops[i] + 1u, restored.trusted.periods);
        TEST_ASSERT_EQUAL(BELT_OK, step_restored(0.25, &answer));
    }
}

static void test_stop_is_the_same_as_a_late_step(void) {
    belt_command_t answer;
    take();
    TEST_ASSERT_EQUAL(BELT_OK, restore(12u));
    (void)step_restored(0.25, &answer);
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_ELAPSED_TICKS;
    measurement.elapsed_ticks = 13u;
    TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_level(0.25));
    TEST_ASSERT_TRUE(real_bits(answer.inlet_flux) == real_bits(command.inlet_flux));
}

static void test_stop_of_a_whole_window_leaves_a_short_history_until_it_is_refilled(void) {
    belt_command_t answer;
    take();
    /* Window and length are 80 and 82 periods; the next step brings 81 of them. */
    TEST_ASSERT_EQUAL(BELT_OK, restore(80u));
    TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_restored(0.25, &answer));
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIODS_LATE | BELT_ERROR_HISTORY_SHORT, answer.error_bits);
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, answer.mode);
}

static void test_longest_stop_that_is_made_up_for_ends_one_short_of_the_cap(void) {
    belt_command_t answer;
    take();
    TEST_ASSERT_EQUAL(BELT_OK, restore(BELT_CATCH_UP_PERIODS - 1u));
    (void)step_restored(0.25, &answer);
    /* The stop and the step's own period. */
    TEST_ASSERT_EQUAL_UINT32(BELT_CATCH_UP_PERIODS, restored.trusted.periods);
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIODS_LATE | BELT_ERROR_HISTORY_SHORT, answer.error_bits);
    TEST_ASSERT_EQUAL(BELT_SNAPSHOT_OLD, restore(BELT_CATCH_UP_PERIODS));
}

static void test_longer_stop_leaves_an_empty_belt_and_what_the_operator_said(void) {
    belt_command_t answer;
    const uint32_t stops[] = {BELT_CATCH_UP_PERIODS, BELT_CATCH_UP_PERIODS + 1u, UINT32_MAX};
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_setpoint(&controller, BELT_REAL(0.4)));
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.7)));
    run_for(1u);
    take();
    for (size_t i = 0; i < sizeof stops / sizeof stops[0]; ++i) {
        TEST_ASSERT_EQUAL(BELT_SNAPSHOT_OLD, restore(stops[i]));
        TEST_ASSERT_TRUE(restored.config.level_setpoint == BELT_REAL(0.4));
        TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_restored(0.125, &answer));
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_HISTORY_SHORT, answer.error_bits);
        TEST_ASSERT_EQUAL(BELT_MODE_MANUAL, answer.mode);
        TEST_ASSERT_TRUE(answer.inlet_flux == BELT_REAL(0.7));
        TEST_ASSERT_TRUE(belt_level_history_at(&restored.model.history, BELT_REAL(80)) ==
                         belt_level_history_at(&restored.model.history, BELT_REAL(0)));
        TEST_ASSERT_TRUE(restored.model.observer.density[restored.model.observer.outlet] ==
                         BELT_REAL(0));
        for (uint32_t period = 1; period < 82u; ++period) {
            (void)step_restored(0.125, &answer);
            TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_HISTORY_SHORT, answer.error_bits);
        }
        TEST_ASSERT_EQUAL(BELT_OK, step_restored(0.125, &answer));
    }
}

static void test_longer_stop_keeps_the_disturbance(void) {
    belt_command_t answer;
    for (int i = 0; i < 400; ++i) {
        (void)step_level(0.3); /* never less, although nothing much is fed: something flows in */
    }
    take();
    const belt_real_t disturbance = controller.model.estimator.disturbance;
    TEST_ASSERT_TRUE(fabs((double)disturbance) > 0.01);
    TEST_ASSERT_EQUAL(BELT_SNAPSHOT_OLD, restore(UINT32_MAX));
    (void)step_restored(0.3, &answer);
    TEST_ASSERT_TRUE(restored.model.present.disturbance == disturbance);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_short_stop_is_made_up_for_in_the_next_step);
    RUN_TEST(test_stop_is_the_same_as_a_late_step);
    RUN_TEST(test_stop_of_a_whole_window_leaves_a_short_history_until_it_is_refilled);
    RUN_TEST(test_longest_stop_that_is_made_up_for_ends_one_short_of_the_cap);
    RUN_TEST(test_longer_stop_leaves_an_empty_belt_and_what_the_operator_said);
    RUN_TEST(test_longer_stop_keeps_the_disturbance);
    return UNITY_END();
}
