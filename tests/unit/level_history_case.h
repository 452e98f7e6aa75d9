/* SPDX-License-Identifier: MIT */
/* level_history_case.h - a history of the paper's window, and levels to put into it. */
#ifndef TESTS_UNIT_LEVEL_HISTORY_CASE_H
#define TESTS_UNIT_LEVEL_HISTORY_CASE_H

#include "belt/level_history.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_level_history_t history;

static inline void begin(double window, double period) {
    config.speed_window = BELT_REAL(window);
    config.period = BELT_REAL(period);
    belt_level_history_init(&history, &config);
}

static inline void set_up_case(void) {
    config = paper_case();
    begin(0.2, 0.0025);
}

/** Rounding of a level to quanta. */
static inline double half_quantum(void) {
    return 0.5 * (double)history.quantum;
}

/** What congestion may be off: half a quantum a level over the window, six roundings of the result
 * on the way from the integers, and the window's end, a hair of 4 EPSILON and two roundings. */
static inline double tolerance(double congestion) {
    return (half_quantum() + 6 * EPSILON) * (double)config.speed_window + 6 * EPSILON * congestion;
}

static inline double congestion(void) {
    return (double)belt_level_history_congestion(&history);
}

static inline double level_at(double age) {
    return (double)belt_level_history_at(&history, BELT_REAL(age));
}

/** Levels on a line through time: `slope` a period up to `newest` now. */
static inline void push_ramp(double newest, double slope, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
        belt_level_history_push(&history, BELT_REAL(newest - slope * (double)(count - 1u - i)));
    }
}

#endif
