/* SPDX-License-Identifier: MIT */
#include "level_history.h"

/** Index of the level `age` whole periods old, 0 <= age < length. */
static uint16_t index_of(const belt_level_history_t *history, uint16_t age) {
    const uint16_t wrap = (history->newest < age) ? history->length : 0;
    return (uint16_t)(history->newest + wrap - age);
}

void belt_level_history_init(belt_level_history_t *history, const belt_config_t *config) {
    history->period = config->period;
    history->rate = BELT_REAL(1) / config->period;
    /* A window of n periods that rounding left a hair short of n is n periods. */
    const belt_real_t hair = BELT_REAL(4) * BELT_REAL_EPSILON;
    history->window = config->speed_window / config->period * (BELT_REAL(1) + hair);
    history->whole = (uint16_t)history->window;
    history->part = history->window - (belt_real_t)history->whole;
    history->length = (uint16_t)(history->whole + 2);
    const belt_real_t most = (belt_real_t)((belt_word_t)1 << BELT_QUANTA_BITS);
    history->per_part = most / (config->level_capacity * (belt_real_t)history->length);
    history->quantum = BELT_REAL(1) / history->per_part;
    belt_level_history_fill(history, BELT_REAL(0));
}

static belt_quanta_t in_quanta(const belt_level_history_t *history, belt_real_t level) {
    return (belt_quanta_t)(level * history->per_part + BELT_REAL(0.5));
}

void belt_level_history_fill(belt_level_history_t *history, belt_real_t level) {
    const belt_quanta_t quanta = in_quanta(history, level);
    for (uint16_t i = 0; i < history->length; ++i) {
        history->level[i] = quanta;
    }
    history->newest = 0;
    history->window_sum = quanta * (belt_quanta_t)(history->whole + 1);
}

void belt_level_history_push(belt_level_history_t *history, belt_real_t level) {
    const belt_quanta_t quanta = in_quanta(history, level);
    history->window_sum += quanta - history->level[index_of(history, history->whole)];
    history->newest = (uint16_t)(history->newest + 1);
    if (history->newest >= history->length) {
        history->newest = 0;
    }
    history->level[history->newest] = quanta;
}

belt_real_t belt_level_history_congestion(const belt_level_history_t *history) {
    const belt_quanta_t first = history->level[history->newest];
    const belt_quanta_t last = history->level[index_of(history, history->whole)];
    const belt_quanta_t beyond = history->level[index_of(history, (uint16_t)(history->whole + 1))];
    const belt_real_t trapezoids =
        (belt_real_t)history->window_sum - BELT_REAL(0.5) * (belt_real_t)(first + last);
    const belt_real_t rest =
        history->part * ((belt_real_t)last +
                         BELT_REAL(0.5) * history->part * (belt_real_t)(beyond - last));
    return (trapezoids + rest) * (history->period * history->quantum);
}

belt_real_t belt_level_history_at(const belt_level_history_t *history, belt_real_t age) {
    const belt_real_t oldest = (belt_real_t)(history->whole + 1);
    belt_real_t within = (age > BELT_REAL(0)) ? age : BELT_REAL(0);
    within = (within < oldest) ? within : oldest;
    uint16_t periods = (uint16_t)within;
    periods = (periods > history->whole) ? history->whole : periods;
    const belt_quanta_t younger = history->level[index_of(history, periods)];
    const belt_quanta_t older = history->level[index_of(history, (uint16_t)(periods + 1))];
    const belt_real_t between = within - (belt_real_t)periods;
    return ((belt_real_t)younger + between * (belt_real_t)(older - younger)) * history->quantum;
}
