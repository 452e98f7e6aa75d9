/* SPDX-License-Identifier: MIT */
/* observer_case.h - a belt without loss and rework that begins empty, and what lies on it. */
#ifndef TESTS_UNIT_OBSERVER_CASE_H
#define TESTS_UNIT_OBSERVER_CASE_H

#include "belt/observer.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_line_t line;
static belt_observer_t observer;

static inline void begin(void) {
    belt_line_init(&line, &config);
    belt_observer_init(&observer);
}

/* The finest line of these tests; the presets have room for it. */
#define CELLS_NEEDED 40

static inline void set_up_case(void) {
    TEST_ASSERT_TRUE_MESSAGE(BELT_NODE_CAPACITY >= CELLS_NEEDED, "build with a preset");
    config = paper_case();
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
    begin();
}

/** One period of a line on which a spacing takes `pace` seconds. */
static inline void advance_at(double pace, double travel, double fed) {
    belt_passage_t passage = {.fed_density = BELT_REAL(fed), .travel = BELT_REAL(travel)};
    passage.duration = BELT_REAL(pace * travel);
    belt_observer_advance(&observer, &line, &passage);
}

static inline void advance(double travel, double fed) {
    advance_at(0.025, travel, fed);
}

/** The same, with a measured outlet. */
static inline void advance_measured(double pace, double travel, double fed, double left) {
    belt_passage_t passage = {.fed_density = BELT_REAL(fed), .travel = BELT_REAL(travel)};
    passage.duration = BELT_REAL(pace * travel);
    passage.left_density = BELT_REAL(left);
    passage.left_is_measured = true;
    belt_observer_advance(&observer, &line, &passage);
}

/** Cell `i` from the outlet; cell node_count is the open one. */
static inline double cell(uint32_t i) {
    return (double)observer.density[belt_observer_behind(&line, observer.outlet, i)];
}

/** Parts on the belt, in units of density times spacing. */
static inline double on_belt(void) {
    const double gone = (double)observer.gone;
    double sum = (1.0 - gone) * (double)belt_observer_rest_of_outlet(&observer);
    for (uint32_t i = 1; i < line.node_count; ++i) {
        sum += cell(i);
    }
    return sum + gone * cell(line.node_count);
}

/** Cells that hold anything: an open cell of no width does not. */
static inline uint32_t last_cell(void) {
    return (observer.gone > BELT_REAL(0)) ? line.node_count : line.node_count - 1u;
}

/** Where the centre of cell `i` is [spacings from the outlet]; the open cell's filled part is
 * `gone` wide. */
static inline double centre(uint32_t i) {
    const double gone = (double)observer.gone;
    return (i < line.node_count) ? (double)i + 0.5 - gone : (double)i - 0.5 * gone;
}

static inline double left(void) {
    return (double)observer.outlet_density;
}

/** Density leaving, after the belt has filled with `fed` at a constant pace. */
static inline double leaving_after_filling(double pace, double travel, double fed) {
    for (int i = 0; i * travel < 2.0 * config.node_count + 2.0; ++i) {
        advance_at(pace, travel, fed);
    }
    return left();
}

/** What the survival series falls short by: loss^4/24 for each of the ways, at most a period or half
 * a cell long. */
static inline double series_error(double loss, double ways) {
    return ways * loss * loss * loss * loss / 24.0;
}

#endif
