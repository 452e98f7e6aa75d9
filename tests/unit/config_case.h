/* SPDX-License-Identifier: MIT */
/* config_case.h - the paper's configuration, its fields with their rules, and what a check says. */
#ifndef TESTS_UNIT_CONFIG_CASE_H
#define TESTS_UNIT_CONFIG_CASE_H

#include "belt/belt.h"

#include <stddef.h>
#include <string.h>

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

static belt_config_t config;
static belt_controller_t controller;

/* The finest line of these tests; the presets have room for it. */
#define CELLS_NEEDED 64

static inline void begin_with_papers_case(void) {
    TEST_ASSERT_TRUE_MESSAGE(BELT_NODE_CAPACITY >= CELLS_NEEDED, "build with a preset");
    config = paper_case();
}

/* Fields that are numbers, each with the rule whose value it is. */
typedef struct {
    belt_status_t code;
    size_t offset;
} field_t;

static const field_t fields[] = {
    {BELT_BELT_LENGTH, offsetof(belt_config_t, belt_length)},
    {BELT_PROCESSING_TIME, offsetof(belt_config_t, processing_time)},
    {BELT_SPEED_WINDOW, offsetof(belt_config_t, speed_window)},
    {BELT_CONGESTION_SCALE, offsetof(belt_config_t, congestion_scale)},
    {BELT_CONNECTIVITY, offsetof(belt_config_t, connectivity)},
    {BELT_SERVICE_RATE_MAX, offsetof(belt_config_t, service_rate_max)},
    {BELT_SERVICE_TIME, offsetof(belt_config_t, service_time)},
    {BELT_LEVEL_CAPACITY, offsetof(belt_config_t, level_capacity)},
    {BELT_REWORK_RATE, offsetof(belt_config_t, rework_rate)},
    {BELT_LOSS_RATE, offsetof(belt_config_t, loss_rate)},
    {BELT_PERIOD, offsetof(belt_config_t, period)},
    {BELT_NOMINAL_FLUX_MAX, offsetof(belt_config_t, nominal_flux_max)},
    {BELT_LEVEL_SETPOINT, offsetof(belt_config_t, level_setpoint)},
    {BELT_INLET_FLUX_MAX, offsetof(belt_config_t, inlet_flux_max)},
    {BELT_FLUX_RATE_MAX, offsetof(belt_config_t, flux_rate_max)},
    {BELT_SUBSTITUTE_FLUX, offsetof(belt_config_t, substitute_flux)},
    {BELT_LEVEL_STEP_MAX, offsetof(belt_config_t, level_step_max)},
    {BELT_TRANSFER_TIME, offsetof(belt_config_t, transfer_time)},
};

static inline void set(const field_t *field, belt_real_t value) {
    memcpy((unsigned char *)&config + field->offset, &value, sizeof value);
}

static inline belt_real_t value_of(const field_t *field) {
    belt_real_t value;
    memcpy(&value, (const unsigned char *)&config + field->offset, sizeof value);
    return value;
}

static inline bool breaks(belt_status_t code) {
    uint64_t broken = 0;
    (void)belt_config_check(&config, &broken);
    return (broken & BELT_RULE_BIT(code)) != 0u;
}

static inline void assert_breaks_nothing_but(belt_status_t code) {
    uint64_t broken = 0;
    TEST_ASSERT_EQUAL_STRING(belt_status_name(code),
                             belt_status_name(belt_config_check(&config, &broken)));
    TEST_ASSERT_EQUAL_HEX64((code == BELT_OK) ? 0u : BELT_RULE_BIT(code), broken);
}

static inline void assert_limits(belt_status_t code, belt_real_t lower, belt_real_t upper) {
    const belt_rule_t rule = belt_config_rule(&config, code);
    TEST_ASSERT_EQUAL_DOUBLE((double)lower, (double)rule.lower);
    TEST_ASSERT_EQUAL_DOUBLE((double)upper, (double)rule.upper);
}

static inline void assert_refused_and_untouched(belt_status_t status) {
    static belt_controller_t before;
    memset(&controller, 0xA5, sizeof controller);
    memset(&before, 0xA5, sizeof before);
    TEST_ASSERT_EQUAL_STRING(belt_status_name(status),
                             belt_status_name(belt_init(&controller, &config)));
    TEST_ASSERT_TRUE(memcmp(&controller, &before, sizeof controller) == 0);
}

#endif
