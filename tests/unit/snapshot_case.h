/* SPDX-License-Identifier: MIT */
/* snapshot_case.h - a controller that has run for a while, two slots and one that is restored. */
#ifndef TESTS_UNIT_SNAPSHOT_CASE_H
#define TESTS_UNIT_SNAPSHOT_CASE_H

#include "belt/snapshot.h"

#include "belt_case.h"

/** A slot of 3 KB is tested at every byte; where a build's capacities make it 40 KB and more, the
 * levels of its ring at every 509th and the rest at every 7th. */
static inline size_t stride_at(size_t byte) {
    const size_t ring = offsetof(belt_snapshot_t, state) + offsetof(belt_level_history_t, level) -
                        offsetof(belt_level_history_t, base);
    const bool is_in_ring = (byte >= ring) && (byte < ring + sizeof controller.model.history.level);
    if (sizeof(belt_snapshot_t) <= 8192u) {
        return 1u;
    }
    return is_in_ring ? 509u : 7u;
}

static belt_snapshot_t slots[2];
static belt_controller_t restored;

static inline void run_for(unsigned count) {
    static unsigned period = 0;
    for (unsigned i = 0; i < count; ++i) {
        (void)step_level(0.25 + 0.05 * sin(0.02 * ++period));
    }
}

static inline void take(void) {
    belt_snapshot_take(&controller, slots);
}

static inline belt_status_t restore(uint32_t down_periods) {
    memset(&restored, 0, sizeof restored);
    return belt_snapshot_restore(&restored, &config, slots, down_periods);
}

static inline void seal(belt_snapshot_t *slot) {
    slot->crc = belt_snapshot_crc(0, slot, offsetof(belt_snapshot_t, crc));
}

/** Whether two controllers know the same. */
static inline bool know_the_same(const belt_controller_t *a, const belt_controller_t *b) {
    return (memcmp(&a->model.history, &b->model.history, BELT_STATE_SIZE) == 0) &&
           (a->config.level_setpoint == b->config.level_setpoint) &&
           (memcmp(&a->law, &b->law, sizeof a->law) == 0);
}

static inline void begin_snapshots(void) {
    begin_case();
    memset(slots, 0, sizeof slots);
    config.estimator = BELT_ESTIMATOR_ON;
    config.substitute_flux = BELT_REAL(0.4);
    start();
    run_for(300u);
}

static inline belt_status_t step_restored(double level, belt_command_t *answer) {
    measurement.level = BELT_REAL(level);
    return belt_step(&restored, &measurement, answer);
}

#endif
