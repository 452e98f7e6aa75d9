/* SPDX-License-Identifier: MIT */
/* gate_case.h - a gate on the paper's line, all of whose inputs are present and sound. */
#ifndef TESTS_UNIT_GATE_CASE_H
#define TESTS_UNIT_GATE_CASE_H

#include "belt/measurement.h"

#include <math.h>
#include <string.h>

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define ALL_PRESENT                                                                                \
    (BELT_HAS_LEVEL | BELT_HAS_OUTLET_FLUX | BELT_HAS_APPLIED_FLUX | BELT_HAS_DENSITY |            \
     BELT_HAS_SAMPLE_COUNT | BELT_HAS_ELAPSED_TICKS)
#define COMMAND BELT_REAL(0.75)

static belt_config_t config;
static belt_line_t line;
static belt_limits_t limits;
static belt_gate_t memory;
static belt_measurement_t measurement;
static belt_real_t density[BELT_NODE_CAPACITY + 1];

/** Limits of the configuration, and a gate that has seen nothing. */
static inline void begin(void) {
    belt_line_init(&line, &config);
    belt_limits_init(&limits, &config);
    belt_measurement_init(&memory, &limits);
}

/** Sums of powers of two: a level of 0.5, the last good one too, within steps of 0.25. */
static inline void begin_with_all_inputs(void) {
    config = paper_case();
    begin();
    limits.flux_tolerance = BELT_REAL(0.125);
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = BELT_REAL(0.25);
    }
    measurement = (belt_measurement_t){.present = ALL_PRESENT,
                                       .level = BELT_REAL(0.5),
                                       .outlet_flux = BELT_REAL(0.625),
                                       .applied_flux = BELT_REAL(0.875),
                                       .density = density,
                                       .sample_count = 7u,
                                       .elapsed_ticks = 1u};
    memory.level = BELT_REAL(0.5);
    memory.has_level = 1u;
    memory.sample_count = 6u;
}

/** One period, with what the gate remembers. */
static inline belt_trusted_t step(void) {
    belt_trusted_t trusted;
    memset(&trusted, 0xFF, sizeof trusted);
    belt_measurement_gate(&trusted, &memory, &measurement, COMMAND, &line, &limits);
    return trusted;
}

/** One period of a gate that remembers what it did before it. */
static inline belt_trusted_t gate(void) {
    const belt_gate_t before = memory;
    const belt_trusted_t trusted = step();
    memory = before;
    return trusted;
}

#if BELT_REAL_IS_DOUBLE
#define SIGNALLING_NAN 0x7FF0000000000001u
#define QUIET_NAN_NEGATIVE 0xFFF8000000000000u
#define ALL_ONES 0xFFFFFFFFFFFFFFFFu
#else
#define SIGNALLING_NAN 0x7F800001u
#define QUIET_NAN_NEGATIVE 0xFFC00000u
#define ALL_ONES 0xFFFFFFFFu
#endif

/* No numbers at all. Kept as bits: loading a signalling NaN may quieten it. */
static const uint64_t no_numbers[] = {SIGNALLING_NAN, QUIET_NAN_NEGATIVE, ALL_ONES};

static inline void store(belt_real_t *place, uint64_t bits) {
    const belt_word_t word = (belt_word_t)bits;
    memcpy(place, &word, sizeof word);
}

/* Everything that is no number. */
#define SENSELESS_CAPACITY 16
static inline size_t senseless_numbers(belt_real_t *numbers) {
    size_t count = 0;
    for (; count < COUNT(no_numbers); ++count) {
        store(&numbers[count], no_numbers[count]);
    }
    numbers[count++] = BELT_REAL(INFINITY);
    numbers[count++] = BELT_REAL(-INFINITY);
    return count;
}

#define CAP 100u /* BELT_CATCH_UP_PERIODS, written down again */

/** One period after `elapsed` ticks, with a new sample. */
static inline belt_trusted_t step_after(uint32_t elapsed) {
    measurement.elapsed_ticks = elapsed;
    measurement.sample_count += 1u;
    return step();
}

#endif
