/* SPDX-License-Identifier: MIT */
#include "level_history.h"

void belt_level_history_init(belt_level_history_t *history, const belt_config_t *config) {
    history->period = config->period;
    history->rate = BELT_REAL(1) / config->period;
    /* A window of n periods that rounding left a hair short of n is n periods. */
    const belt_real_t hair = BELT_REAL(4) * BELT_REAL_EPSILON;
    history->window = config->speed_window / config->period * (BELT_REAL(1) + hair);
    history->whole = (uint32_t)history->window;
    history->part = history->window - (belt_real_t)history->whole;
    history->length = history->whole + 2u;
    const belt_real_t most = (belt_real_t)((belt_word_t)1 << BELT_QUANTA_BITS);
    history->per_part = most / (config->level_capacity * (belt_real_t)history->length);
    history->quantum = BELT_REAL(1) / history->per_part;
    for (uint32_t i = 0; i < history->length; ++i) {
        history->level[i] = 0;
    }
    history->newest = 0;
    history->window_sum = 0;
    history->check_sum = 0;
    history->check_count = 0;
    history->base = 0;
}

static belt_quanta_t in_quanta(const belt_level_history_t *history, belt_real_t level) {
    return (belt_quanta_t)(level * history->per_part + BELT_HALF);
}

void belt_level_history_begin(belt_level_history_t *history, belt_real_t level) {
    history->base = in_quanta(history, level);
}

void belt_level_history_push(belt_level_history_t *history, belt_real_t level) {
    const belt_quanta_t quanta = belt_quanta_less(in_quanta(history, level), history->base);
    const uint32_t leaving = belt_level_history_index(history, history->whole);
    history->window_sum =
        belt_quanta_sum(history->window_sum, belt_quanta_less(quanta, history->level[leaving]));
    history->check_sum = belt_quanta_sum(history->check_sum, quanta);
    history->check_count = history->check_count + 1u;
    if (history->check_count > history->whole) {
        history->window_sum = history->check_sum;
        history->check_sum = 0;
        history->check_count = 0;
    }
    history->newest = history->newest + 1u;
    if (history->newest >= history->length) {
        history->newest = 0;
    }
    history->level[history->newest] = quanta;
}

belt_real_t belt_level_history_congestion(const belt_level_history_t *history) {
    const belt_quanta_t first = history->level[history->newest];
    const belt_quanta_t last = history->level[belt_level_history_index(history, history->whole)];
    const belt_quanta_t beyond =
        history->level[belt_level_history_index(history, history->whole + 1u)];
    const belt_real_t trapezoids =
        (belt_real_t)history->window_sum - BELT_HALF * (belt_real_t)belt_quanta_sum(first, last);
    const belt_real_t rest =
        history->part * ((belt_real_t)last +
                         BELT_HALF * history->part * (belt_real_t)belt_quanta_less(beyond, last));
    return (trapezoids + rest + (belt_real_t)history->base * history->window) *
           (history->period * history->quantum);
}
