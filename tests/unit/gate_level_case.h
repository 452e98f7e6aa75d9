/* SPDX-License-Identifier: MIT */
/* gate_level_case.h - a gate on a level that comes with a count, period by period. */
#ifndef TESTS_UNIT_GATE_LEVEL_CASE_H
#define TESTS_UNIT_GATE_LEVEL_CASE_H

/* How the level fares from period to period: stale, stepping, doubted, lost, and back. */
#include "gate_case.h"

#define RECOVERY 3u
#define HOLD 5u

static inline void set_up_case(void) {
    config = paper_case();
    config.recovery_samples = RECOVERY;
    config.hold_periods = HOLD;
    begin();
    measurement = (belt_measurement_t){.present = BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT,
                                       .level = BELT_REAL(0.5)};
}

/** One period with a new sample of the level; its error bits. */
static inline uint32_t sample(double level) {
    measurement.present |= BELT_HAS_LEVEL;
    measurement.sample_count += 1u;
    measurement.level = BELT_REAL(level);
    return step().error_bits;
}

/** One period without a level. */
static inline uint32_t miss(void) {
    measurement.present &= ~BELT_HAS_LEVEL;
    return step().error_bits;
}

static inline void assert_health(belt_level_health_t health) {
    TEST_ASSERT_EQUAL(health, memory.health);
}

static inline void assert_level(double level) {
    TEST_ASSERT_EQUAL_DOUBLE(level, (double)memory.level);
}

#endif
