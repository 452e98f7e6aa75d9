/* SPDX-License-Identifier: MIT */
#include "sensors.h"

#include <math.h>
#include <string.h>

#include "unity.h"

static scenario_t scenario;
static sensors_t sensors;
static plant_t plant;
static readings_t readings;

void setUp(void) {
    scenario_defaults(&scenario);
    scenario.controller.period = 1.0;
    memset(&plant, 0, sizeof plant);
    memset(&sensors, 0, sizeof sensors);
}

void tearDown(void) {
    sensors_destroy(&sensors);
}

static void begin(void) {
    sensors_destroy(&sensors);
    TEST_ASSERT_TRUE(sensors_create(&sensors, &scenario));
}

static double level_read(size_t index, double level) {
    plant.level = level;
    readings = sensors_read(&sensors, &plant, index);
    return readings.level.value[0];
}

/* Numbers that pass unchanged are compared as they are: exact. */
static void assert_number(double expected, double actual) {
    TEST_ASSERT_TRUE(fabs(expected - actual) <= 0.0);
}

static void test_sound_sensor_gives_the_level_and_counts_the_periods(void) {
    begin();
    for (size_t index = 0; index < 5; index++) {
        assert_number(0.1 * (double)index, level_read(index, 0.1 * (double)index));
        TEST_ASSERT_EQUAL_UINT32(index, readings.level.sample_count);
        TEST_ASSERT_TRUE(readings.level.is_present);
    }
}

static void test_sound_run_draws_no_random_number(void) {
    begin();
    const chance_t before = sensors.noise;
    (void)level_read(0, 0.3);
    (void)level_read(1, 0.3);
    TEST_ASSERT_EQUAL_MEMORY(&before, &sensors.noise, sizeof before);
}

static void test_applied_flux_is_there_from_the_second_period_on(void) {
    begin();
    plant.applied_flux = 0.7;
    (void)level_read(0, 0.0);
    TEST_ASSERT_FALSE(readings.applied_flux.is_present);
    (void)level_read(1, 0.0);
    TEST_ASSERT_TRUE(readings.applied_flux.is_present);
    assert_number(0.7, readings.applied_flux.value[0]);
}

static void test_what_the_controller_does_not_get_is_absent(void) {
    begin();
    (void)level_read(0, 0.0);
    TEST_ASSERT_FALSE(readings.outlet_flux.is_present);
    TEST_ASSERT_FALSE(readings.density.is_present);
}

static void test_level_between_two_samples_stands_with_its_count(void) {
    static const uint32_t counts[] = {0, 0, 0, 1, 1,
                                      2, 2, 2, 3}; /* samples due at 0, 2.5, 5, 7.5 */
    static const double levels[] = {0, 0, 0, 3, 3, 5, 5, 5, 8};
    scenario.plant.level_sample_time = 2.5;
    begin();
    for (size_t index = 0; index < 9; index++) {
        assert_number(levels[index], level_read(index, (double)index));
        TEST_ASSERT_EQUAL_UINT32(counts[index], readings.level.sample_count);
    }
}

/* 0.3/0.1 is less than 3, and 3*0.1 more than 0.3, by a rounding. */
static void test_sample_is_due_at_a_multiple_of_the_period_whatever_the_rounding(void) {
    scenario.controller.period = 0.1;
    scenario.plant.level_sample_time = 0.3;
    begin();
    for (size_t index = 0; index < 3000; index++) {
        (void)level_read(index, 0.0);
        TEST_ASSERT_EQUAL_UINT32(index / 3, readings.level.sample_count);
    }
}

static void test_level_is_rounded_to_the_nearest_multiple_of_the_quantum(void) {
    scenario.plant.level_quantum = 0.25;
    begin();
    assert_number(0.25, level_read(0, 0.3));
    assert_number(0.5, level_read(1, 0.375));
    assert_number(0.0, level_read(2, 0.124));
}

static void test_noise_has_the_stated_size_and_is_the_seeds(void) {
    enum { MANY = 20000 };
    double squares = 0.0;
    scenario.plant.level_noise = 0.01;
    begin();
    const double first = level_read(0, 0.3);
    for (size_t index = 1; index < MANY; index++) {
        const double noise = level_read(index, 0.3) - 0.3;
        squares += noise * noise;
    }
    /* four standard deviations of a variance over so many: 4*sqrt(2/20000) */
    TEST_ASSERT_DOUBLE_WITHIN(0.04, 1.0, squares / (MANY - 1) / 1e-4);
    begin();
    assert_number(first, level_read(0, 0.3));
    scenario.plant.seed = 2;
    begin();
    TEST_ASSERT_TRUE(fabs(first - level_read(0, 0.3)) > 0.0);
}

static void test_noise_stands_between_two_samples(void) {
    scenario.plant.level_noise = 0.01;
    scenario.plant.level_sample_time = 3.0;
    begin();
    const double first = level_read(0, 0.3);
    assert_number(first, level_read(1, 0.3));
    assert_number(first, level_read(2, 0.3));
    TEST_ASSERT_TRUE(fabs(first - level_read(3, 0.3)) > 0.0);
}

static void test_fault_does_not_change_the_noise(void) {
    scenario.plant.level_noise = 0.01;
    begin();
    (void)level_read(0, 0.3);
    const double expected = level_read(1, 0.3);
    const fault_t fault = {FAULT_ON_BUFFER_LEVEL, FAULT_GARBAGE, 0.0, 0.0, 1.0};
    scenario.run.faults[0] = fault;
    scenario.run.fault_count = 1;
    begin();
    (void)level_read(0, 0.3);
    TEST_ASSERT_TRUE(readings.level.is_garbage);
    assert_number(expected, level_read(1, 0.3));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_sound_sensor_gives_the_level_and_counts_the_periods);
    RUN_TEST(test_sound_run_draws_no_random_number);
    RUN_TEST(test_applied_flux_is_there_from_the_second_period_on);
    RUN_TEST(test_what_the_controller_does_not_get_is_absent);
    RUN_TEST(test_level_between_two_samples_stands_with_its_count);
    RUN_TEST(test_sample_is_due_at_a_multiple_of_the_period_whatever_the_rounding);
    RUN_TEST(test_level_is_rounded_to_the_nearest_multiple_of_the_quantum);
    RUN_TEST(test_noise_has_the_stated_size_and_is_the_seeds);
    RUN_TEST(test_noise_stands_between_two_samples);
    RUN_TEST(test_fault_does_not_change_the_noise);
    return UNITY_END();
}
