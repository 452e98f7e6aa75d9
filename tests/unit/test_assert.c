/* SPDX-License-Identifier: MIT */
/* The assertions of the front door and of the configuration fire. The library proper is built
 * without them, so these two sources are compiled here once more, with a BELT_ASSERT that tells
 * which claim was broken and, as a board's would, does not return. */
#include <setjmp.h>
#include <string.h>

static jmp_buf caller;
static const char *volatile broken_claim;

static void stop(const char *claim) {
    broken_claim = claim;
    longjmp(caller, 1);
}

#define BELT_ASSERT(claim) ((claim) ? (void)0 : stop(#claim))
#include "belt/belt.c"
#include "belt/config.c"

#include "paper_case.h"
#include "unity.h"

static belt_config_t config;
static belt_controller_t controller;
static belt_measurement_t measurement;
static belt_command_t command;

void setUp(void) {
    config = paper_case();
    broken_claim = NULL;
    memset(&controller, 0, sizeof controller);
    measurement = (belt_measurement_t){.present = BELT_HAS_LEVEL};
}

void tearDown(void) {
}

#define CALL(call)                                                                                 \
    do {                                                                                           \
        broken_claim = NULL;                                                                       \
        if (setjmp(caller) == 0) {                                                                 \
            (void)(call);                                                                          \
        }                                                                                          \
    } while (0)

#define ASSERT_STOPS(call)                                                                         \
    do {                                                                                           \
        CALL(call);                                                                                \
        TEST_ASSERT_NOT_NULL(broken_claim);                                                        \
    } while (0)

#define ASSERT_RETURNS(call)                                                                       \
    do {                                                                                           \
        CALL(call);                                                                                \
        TEST_ASSERT_NULL(broken_claim);                                                            \
    } while (0)

static void test_init_without_pointers_stops(void) {
    ASSERT_STOPS(belt_init(NULL, &config));
    ASSERT_STOPS(belt_init(&controller, NULL));
}

static void test_step_without_pointers_stops(void) {
    ASSERT_RETURNS(belt_init(&controller, &config));
    ASSERT_STOPS(belt_step(NULL, &measurement, &command));
    ASSERT_STOPS(belt_step(&controller, NULL, &command));
    ASSERT_STOPS(belt_step(&controller, &measurement, NULL));
}

static void test_step_before_init_stops(void) {
    ASSERT_STOPS(belt_step(&controller, &measurement, &command));
}

static void test_setpoint_before_init_stops(void) {
    ASSERT_STOPS(belt_set_setpoint(&controller, BELT_REAL(0.3)));
    ASSERT_STOPS(belt_set_setpoint(NULL, BELT_REAL(0.3)));
}

static void test_check_without_configuration_stops(void) {
    ASSERT_STOPS(belt_config_check(NULL, NULL));
}

static void test_rule_without_configuration_or_of_no_rule_stops(void) {
    ASSERT_STOPS(belt_config_rule(NULL, BELT_PERIOD));
    ASSERT_STOPS(belt_config_rule(&config, BELT_OK));
    ASSERT_STOPS(belt_config_rule(&config, BELT_MISUSE));
    ASSERT_RETURNS(belt_config_rule(&config, BELT_RULE_FIRST));
    ASSERT_RETURNS(belt_config_rule(&config, BELT_RULE_LAST));
}

static void test_what_is_wrong_with_the_plant_or_the_configuration_stops_nothing(void) {
    config.period = BELT_REAL(NAN);
    ASSERT_RETURNS(belt_init(&controller, &config));
    config = paper_case();
    ASSERT_RETURNS(belt_init(&controller, &config));
    measurement.level = BELT_REAL(NAN);
    ASSERT_RETURNS(belt_step(&controller, &measurement, &command));
    measurement.level = BELT_REAL(0.1);
    ASSERT_RETURNS(belt_step(&controller, &measurement, &command));
    ASSERT_RETURNS(belt_set_setpoint(&controller, BELT_REAL(-1)));
    ASSERT_RETURNS(belt_set_setpoint(&controller, BELT_REAL(0.4)));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_init_without_pointers_stops);
    RUN_TEST(test_step_without_pointers_stops);
    RUN_TEST(test_step_before_init_stops);
    RUN_TEST(test_setpoint_before_init_stops);
    RUN_TEST(test_check_without_configuration_stops);
    RUN_TEST(test_rule_without_configuration_or_of_no_rule_stops);
    RUN_TEST(test_what_is_wrong_with_the_plant_or_the_configuration_stops_nothing);
    return UNITY_END();
}
