/* SPDX-License-Identifier: MIT */
/* The assertions of the front door, of snapshots and of the configuration fire. The library proper is
 * built without them, so these sources are compiled here once more, with a BELT_ASSERT that tells
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
#include "belt/snapshot.c"

#include "paper_case.h"
#include "unity.h"

static belt_config_t config;
static belt_controller_t controller;
static belt_measurement_t measurement;
static belt_command_t command;
static belt_snapshot_t slots[2];

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

static void test_mode_and_manual_flux_before_init_stop(void) {
    ASSERT_STOPS(belt_set_mode(&controller, BELT_MODE_OFF));
    ASSERT_STOPS(belt_set_mode(NULL, BELT_MODE_OFF));
    ASSERT_STOPS(belt_set_manual_flux(&controller, BELT_REAL(0.3)));
    ASSERT_STOPS(belt_set_manual_flux(NULL, BELT_REAL(0.3)));
}

static void test_snapshot_without_pointers_stops(void) {
    ASSERT_STOPS(belt_snapshot_take(NULL, slots));
    ASSERT_STOPS(belt_snapshot_take(&controller, NULL));
    ASSERT_STOPS(belt_snapshot_restore(NULL, &config, slots, 0));
    ASSERT_STOPS(belt_snapshot_restore(&controller, NULL, slots, 0));
    ASSERT_STOPS(belt_snapshot_restore(&controller, &config, NULL, 0));
}

static void test_snapshot_of_what_is_not_running_stops_nothing(void) {
    ASSERT_RETURNS(belt_snapshot_take(&controller, slots));
    ASSERT_RETURNS(belt_snapshot_restore(&controller, &config, slots, 0));
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
    ASSERT_RETURNS(belt_set_mode(&controller, (belt_mode_t)77));
    ASSERT_RETURNS(belt_set_manual_flux(&controller, BELT_REAL(0.4)));
}

static void test_memory_that_has_changed_stops_nothing(void) {
    ASSERT_RETURNS(belt_init(&controller, &config));
    controller.limits.hold_periods ^= 1u;
    ASSERT_RETURNS(belt_step(&controller, &measurement, &command));
    ASSERT_RETURNS(belt_step(&controller, &measurement, &command));
    ASSERT_RETURNS(belt_set_mode(&controller, BELT_MODE_OFF));
    ASSERT_RETURNS(belt_set_setpoint(&controller, BELT_REAL(0.4)));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_init_without_pointers_stops);
    RUN_TEST(test_step_without_pointers_stops);
    RUN_TEST(test_step_before_init_stops);
    RUN_TEST(test_setpoint_before_init_stops);
    RUN_TEST(test_mode_and_manual_flux_before_init_stop);
    RUN_TEST(test_snapshot_without_pointers_stops);
    RUN_TEST(test_snapshot_of_what_is_not_running_stops_nothing);
    RUN_TEST(test_check_without_configuration_stops);
    RUN_TEST(test_rule_without_configuration_or_of_no_rule_stops);
    RUN_TEST(test_what_is_wrong_with_the_plant_or_the_configuration_stops_nothing);
    RUN_TEST(test_memory_that_has_changed_stops_nothing);
    return UNITY_END();
}
