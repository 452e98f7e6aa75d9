/* SPDX-License-Identifier: MIT */
/* Faults of period and valve, one period of 1 s after the other. */
#include "task.h"

#include <math.h>

#include "unity.h"
#include "valve.h"

#define PERIODS 10

static scenario_t scenario;
static task_t task;
static task_period_t periods[PERIODS];
static valve_t valve;

void setUp(void) {
    scenario_defaults(&scenario);
    scenario.controller.period = 1.0;
}

void tearDown(void) {
}

static void state(fault_signal_t signal, fault_word_t word, double value) {
    const fault_t fault = {signal, word, value, 3.0, 4.0};
    scenario.run.faults[scenario.run.fault_count] = fault;
    scenario.run.fault_count += 1;
}

static void run_task(void) {
    task_begin(&task, &scenario);
    for (size_t index = 0; index < PERIODS; index++) {
        periods[index] = task_next(&task, index);
    }
}

static void assert_steps(const uint32_t ticks[PERIODS]) {
    for (size_t index = 0; index < PERIODS; index++) {
        TEST_ASSERT_EQUAL(ticks[index] > 0, periods[index].steps);
        if (periods[index].steps) {
            TEST_ASSERT_EQUAL_UINT32(ticks[index], periods[index].elapsed_ticks);
        }
    }
}

static void test_sound_task_steps_once_a_period(void) {
    run_task();
    assert_steps((const uint32_t[PERIODS]){1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    TEST_ASSERT_TRUE(periods[0].has_power);
    TEST_ASSERT_FALSE(periods[0].restarts);
}

static void test_task_that_hung_is_told_how_long(void) {
    state(FAULT_ON_PERIOD, FAULT_STUCK, 0.0);
    run_task();
    assert_steps((const uint32_t[PERIODS]){1, 1, 1, 0, 0, 0, 0, 5, 1, 1});
    TEST_ASSERT_TRUE(periods[3].has_power);
    TEST_ASSERT_FALSE(periods[7].restarts);
}

static void test_power_that_comes_back_restarts_the_task(void) {
    state(FAULT_ON_PERIOD, FAULT_OFF, 0.0);
    run_task();
    assert_steps((const uint32_t[PERIODS]){1, 1, 1, 0, 0, 0, 0, 1, 1, 1});
    for (size_t index = 0; index < PERIODS; index++) {
        TEST_ASSERT_EQUAL(index < 3 || index >= 7, periods[index].has_power);
        TEST_ASSERT_EQUAL(index == 7, periods[index].restarts);
    }
}

static void test_lost_steps_are_told_to_the_next(void) {
    state(FAULT_ON_PERIOD, FAULT_INTERMITTENT, 0.5);
    run_task();
    uint32_t missed = 0;
    uint32_t lost = 0;
    for (size_t index = 0; index < PERIODS; index++) {
        if (periods[index].steps) {
            TEST_ASSERT_EQUAL_UINT32(missed + 1, periods[index].elapsed_ticks);
            missed = 0;
        } else {
            TEST_ASSERT_TRUE(index >= 3 && index < 7);
            missed++;
            lost++;
        }
    }
    TEST_ASSERT_TRUE(lost > 0); /* of four at one half: this seed loses some */
}

static void test_wrong_counter_is_scaled_and_rounded(void) {
    state(FAULT_ON_PERIOD, FAULT_WRONG, 2.5);
    run_task();
    for (size_t index = 0; index < PERIODS; index++) {
        TEST_ASSERT_TRUE(periods[index].steps);
        TEST_ASSERT_EQUAL_UINT32(index >= 3 && index < 7 ? 3 : 1, periods[index].elapsed_ticks);
    }
}

static void test_wrong_counter_scales_the_periods_that_were_missed_too(void) {
    const fault_t hang = {FAULT_ON_PERIOD, FAULT_STUCK, 0.0, 1.0, 2.0};
    state(FAULT_ON_PERIOD, FAULT_WRONG, 2.5);
    scenario.run.faults[1] = hang;
    scenario.run.fault_count = 2;
    run_task();
    assert_steps((const uint32_t[PERIODS]){1, 0, 0, 8, 3, 3, 3, 1, 1, 1}); /* 2.5*3 = 7.5 */
}

static void test_garbage_of_the_counter_stays_within_its_bound(void) {
    scenario.controller.period = 0.001;
    state(FAULT_ON_PERIOD, FAULT_GARBAGE, 0.0);
    task_begin(&task, &scenario);
    uint32_t greatest = 0;
    for (size_t index = 0; index < 7000; index++) {
        const task_period_t period = task_next(&task, index);
        greatest = period.elapsed_ticks > greatest ? period.elapsed_ticks : greatest;
    }
    TEST_ASSERT_EQUAL_UINT32(FAULT_TICKS_MAX, greatest); /* in 4000 draws of 201: e^-20 misses it */
}

static void test_steps_lost_before_a_cut_are_not_told_after_it(void) {
    state(FAULT_ON_PERIOD, FAULT_OFF, 0.0);
    const fault_t hang = {FAULT_ON_PERIOD, FAULT_STUCK, 0.0, 1.0, 2.0};
    scenario.run.faults[1] = hang;
    scenario.run.fault_count = 2;
    run_task();
    assert_steps((const uint32_t[PERIODS]){1, 0, 0, 0, 0, 0, 0, 1, 1, 1});
}

/* A command that counts its periods. */
static void assert_valve(const double expected[PERIODS]) {
    TEST_ASSERT_TRUE(valve_create(&valve, &scenario));
    for (size_t index = 0; index < PERIODS; index++) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, expected[index],
                                  valve_obey(&valve, index, (double)index + 1.0));
    }
    valve_destroy(&valve);
}

static void test_sound_valve_obeys(void) {
    assert_valve((const double[PERIODS]){1, 2, 3, 4, 5, 6, 7, 8, 9, 10});
}

static void test_valve_that_is_off_is_closed(void) {
    state(FAULT_ON_VALVE, FAULT_OFF, 0.0);
    assert_valve((const double[PERIODS]){1, 2, 3, 0, 0, 0, 0, 8, 9, 10});
}

static void test_stuck_valve_stays_where_it_is(void) {
    state(FAULT_ON_VALVE, FAULT_STUCK, 0.0);
    assert_valve((const double[PERIODS]){1, 2, 3, 3, 3, 3, 3, 8, 9, 10});
}

static void test_valve_that_no_command_reaches_stays_where_it_is(void) {
    state(FAULT_ON_VALVE, FAULT_INTERMITTENT, 1.0);
    assert_valve((const double[PERIODS]){1, 2, 3, 3, 3, 3, 3, 8, 9, 10});
}

static void test_valve_late_from_the_start_is_closed_until_the_first_command_reaches_it(void) {
    const fault_t late = {FAULT_ON_VALVE, FAULT_DELAYED, 2.0, 0.0, 100.0};
    scenario.run.faults[0] = late;
    scenario.run.fault_count = 1;
    assert_valve((const double[PERIODS]){0, 0, 1, 2, 3, 4, 5, 6, 7, 8});
}

static void test_valve_stuck_from_the_start_is_closed(void) {
    const fault_t stuck = {FAULT_ON_VALVE, FAULT_STUCK, 0.0, 0.0, 2.0};
    scenario.run.faults[0] = stuck;
    scenario.run.fault_count = 1;
    assert_valve((const double[PERIODS]){0, 0, 3, 4, 5, 6, 7, 8, 9, 10});
}

static void test_valve_without_power_closes_and_forgets(void) {
    const fault_t slow = {FAULT_ON_VALVE, FAULT_SLOW, 1.0, 0.0, 100.0};
    scenario.run.faults[0] = slow;
    scenario.run.fault_count = 1;
    TEST_ASSERT_TRUE(valve_create(&valve, &scenario));
    /* a time constant of one period: half the way from closed */
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0, valve_obey(&valve, 0, 2.0));
    TEST_ASSERT_DOUBLE_WITHIN(0.0, 0.0, valve_close(&valve));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0, valve_obey(&valve, 2, 2.0));
    valve_destroy(&valve);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_sound_task_steps_once_a_period);
    RUN_TEST(test_task_that_hung_is_told_how_long);
    RUN_TEST(test_power_that_comes_back_restarts_the_task);
    RUN_TEST(test_lost_steps_are_told_to_the_next);
    RUN_TEST(test_wrong_counter_is_scaled_and_rounded);
    RUN_TEST(test_wrong_counter_scales_the_periods_that_were_missed_too);
    RUN_TEST(test_garbage_of_the_counter_stays_within_its_bound);
    RUN_TEST(test_steps_lost_before_a_cut_are_not_told_after_it);
    RUN_TEST(test_sound_valve_obeys);
    RUN_TEST(test_valve_that_is_off_is_closed);
    RUN_TEST(test_stuck_valve_stays_where_it_is);
    RUN_TEST(test_valve_that_no_command_reaches_stays_where_it_is);
    RUN_TEST(test_valve_late_from_the_start_is_closed_until_the_first_command_reaches_it);
    RUN_TEST(test_valve_stuck_from_the_start_is_closed);
    RUN_TEST(test_valve_without_power_closes_and_forgets);
    return UNITY_END();
}
