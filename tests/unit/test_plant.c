/* SPDX-License-Identifier: MIT */
/* What comes into the plant's buffer and leaves it, for both schemes. */
#include "plant.h"

#include <math.h>
#include <string.h>

#include "scenario.h"
#include "surroundings.h"
#include "unity.h"

/* Sums of a few thousand roundings of numbers of size 1. */
#define ROUNDING 1e-12

static scenario_t scenario;
static plant_t plant;
static bool is_there;

void setUp(void) {
    scenario_defaults(&scenario);
    is_there = false;
}

void tearDown(void) {
    if (is_there) {
        plant_destroy(&plant);
    }
}

static void begin(const scheme_t *scheme, double level) {
    const plant_setup_t setup = {&scenario.plant.line,     0.0025, 1, 80, SCENARIO_NO_LIMIT, level,
                                 &scenario.initial.density};
    if (is_there) {
        plant_destroy(&plant);
    }
    is_there = plant_create(&plant, &setup, scheme);
    TEST_ASSERT_TRUE(is_there);
}

static void run(size_t periods, double flux) {
    for (size_t index = 0; index < periods; index++) {
        plant_advance(&plant, flux);
    }
}

static void test_disturbance_alone_fills_the_buffer_to_its_own_balance(void) {
    const scheme_t *const schemes[] = {&scheme_characteristics, &scheme_upwind};
    for (size_t index = 0; index < 2; index++) {
        begin(schemes[index], 0.0);
        plant_disturb(&plant, 0.25);
        run(4000, 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.25 * 10.0, plant.account.disturbed);
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, plant_balance_error(&plant));
        /* service_time*disturbance, up to what e^-10 leaves */
        TEST_ASSERT_DOUBLE_WITHIN(1e-4, 0.25, plant.level);
    }
}

static void test_parts_balance_while_line_disturbance_and_service_change(void) {
    begin(&scheme_upwind, 0.3); /* whose own balance is exact */
    for (size_t index = 0; index < 400; index++) {
        plant_disturb(&plant, 0.3 * sin((double)index));
        plant_change_service(&plant, 0.1 + 0.01 * (double)(index % 50));
        run(10, 0.9);
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, plant_balance_error(&plant));
    }
}

static void test_negative_disturbance_takes_no_more_than_there_is(void) {
    begin(&scheme_characteristics, 0.1);
    plant_disturb(&plant, -1.0);
    run(400, 0.0);
    TEST_ASSERT_TRUE(plant.level >= 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, plant.level);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, -0.1, plant.account.disturbed - plant.account.served);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, plant_balance_error(&plant));
}

static void test_disturbance_beyond_the_capacity_is_spilled(void) {
    begin(&scheme_characteristics, 0.9);
    plant_disturb(&plant, 2.0);
    run(400, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 1.0, plant.level);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.9 + 2.0 - plant.account.served - 1.0,
                              plant.account.spilled);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, plant_balance_error(&plant));
}

static void test_service_is_bounded_by_the_rate_of_now(void) {
    begin(&scheme_characteristics, 0.5);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.5, plant_service(&plant, 0.5));
    plant_change_service(&plant, 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.1, plant_service(&plant, 0.5));
    run(400, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.1, plant.account.served);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.4, plant.level);
    plant_change_service(&plant, 0.0);
    run(400, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.4, plant.level);
}

static void test_surroundings_change_in_the_first_period_that_starts_at_their_time(void) {
    const schedule_t disturbance = {{0.005, 0.0075}, {0.2, -0.1}, 2};
    const schedule_t service = {{0.004}, {0.1}, 1};
    scenario.plant.disturbance = disturbance;
    scenario.plant.service = service;
    static const double flows[] = {0.0, 0.0, 0.2, -0.1, -0.1};
    static const double rates[] = {0.8, 0.8, 0.1, 0.1, 0.1};
    surroundings_t surroundings;
    surroundings_begin(&surroundings, &scenario);
    begin(&scheme_characteristics, 0.0);
    for (size_t index = 0; index < 5; index++) {
        surroundings_change(&surroundings, &plant, index);
        TEST_ASSERT_DOUBLE_WITHIN(0.0, flows[index], plant.disturbance);
        TEST_ASSERT_DOUBLE_WITHIN(0.0, rates[index], plant.service_rate_max);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_disturbance_alone_fills_the_buffer_to_its_own_balance);
    RUN_TEST(test_parts_balance_while_line_disturbance_and_service_change);
    RUN_TEST(test_negative_disturbance_takes_no_more_than_there_is);
    RUN_TEST(test_disturbance_beyond_the_capacity_is_spilled);
    RUN_TEST(test_service_is_bounded_by_the_rate_of_now);
    RUN_TEST(test_surroundings_change_in_the_first_period_that_starts_at_their_time);
    return UNITY_END();
}
