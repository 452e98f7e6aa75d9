/* SPDX-License-Identifier: MIT */
/* belt_case.h - one controller of the paper's line, driven by hand: what the tests of belt.h share. */
#ifndef TESTS_UNIT_BELT_CASE_H
#define TESTS_UNIT_BELT_CASE_H

#include "belt/belt.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_controller_t controller;
static belt_measurement_t measurement;
static belt_command_t command;

/** Starts the controller with what `config` says now. */
static inline void start(void) {
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
}

static inline void begin_case(void) {
    config = paper_case();
    memset(&controller, 0, sizeof controller);
    memset(&command, 0xA5, sizeof command);
    start();
    measurement = (belt_measurement_t){.present = BELT_HAS_LEVEL};
}

static inline belt_status_t step(void) {
    return belt_step(&controller, &measurement, &command);
}

static inline belt_status_t step_level(double level) {
    measurement.level = BELT_REAL(level);
    return step();
}

/** A period without a level. */
static inline belt_status_t step_blind(void) {
    const uint32_t present = measurement.present;
    measurement.present = present & ~(uint32_t)BELT_HAS_LEVEL;
    const belt_status_t status = step();
    measurement.present = present;
    return status;
}

static inline void steps_level(double level, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
        (void)step_level(level);
    }
}

static inline void steps_blind(unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
        (void)step_blind();
    }
}

static inline void ask(belt_mode_t mode) {
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_mode(&controller, mode));
}

static inline double flux(void) {
    return (double)command.inlet_flux;
}

static inline void assert_nothing_is_fed(void) {
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0));
    TEST_ASSERT_EQUAL(BELT_MODE_OFF, command.mode);
}

/** Sum of the densities of all cells. */
static inline double on_belt(void) {
    double sum = 0.0;
    for (uint32_t i = 0; i < controller.model.line.cell_slots; ++i) {
        sum += (double)controller.model.observer.density[i];
    }
    return sum;
}

/** The line at rest at its set-point: density, level and history; returns the flux that holds it. */
static inline double begin_at_rest(void) {
    const rest_t rest = line_at_rest(&config);
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    const double spacing = (double)config.belt_length / (double)config.node_count;
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = BELT_REAL(rest_density(&config, &rest, spacing * (double)i));
    }
    const uint32_t present = measurement.present;
    measurement.present = present | BELT_HAS_DENSITY;
    measurement.density = density;
    TEST_ASSERT_EQUAL(BELT_OK, step_level((double)config.level_setpoint));
    measurement.present = present;
    measurement.density = NULL;
    return rest.inlet_flux;
}

#endif
