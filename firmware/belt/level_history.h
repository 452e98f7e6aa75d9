/* SPDX-License-Identifier: MIT */
/*
 * level_history.h - the levels of the last speed_window, one a period: the state's own past, which
 * sets the speed now and, while the march goes on, the speed to come.
 *
 * Levels are kept as whole quanta of level_capacity/2^BELT_QUANTA_BITS*(window length), so that the
 * sum of a window fits an integer and is exact: it is moved on by one addition and one subtraction
 * for ever and never drifts. Nor does a flipped bit stay: with every window the sum is begun anew.
 * A quantum is 7.6e-8 of the capacity for 82 levels in float32.
 *
 * Cost: push and congestion about 15 instructions each, a look-back 15, whatever the window's
 * length. Memory: one word a period of the window.
 */
#ifndef BELT_LEVEL_HISTORY_H
#define BELT_LEVEL_HISTORY_H

#include "config.h"

typedef struct {
    /* Derived from the configuration; constant. */
    uint32_t length;      /**< levels in use: whole + 2. */
    uint32_t whole;       /**< whole periods in the window. */
    belt_real_t part;     /**< rest of the window beyond them [periods], [0, 1). */
    belt_real_t window;   /**< the window [periods]. */
    belt_real_t period;   /**< [s]. */
    belt_real_t rate;     /**< 1/period [1/s]. */
    belt_real_t quantum;  /**< level of one quantum [parts]. */
    belt_real_t per_part; /**< quanta in one part [1/parts]. */

    /* State. */
    belt_quanta_t base;       /**< first level; all others are kept less it [quanta]. */
    belt_quanta_t window_sum; /**< sum of the whole intervals' levels, newest included [quanta]. */
    belt_quanta_t check_sum;  /**< the same, begun anew with every window: takes its place once it
                                   has all levels [quanta]. */
    uint32_t check_count;     /**< levels in check_sum. */
    uint32_t newest;          /**< index of the latest level. */
    belt_quanta_t level[BELT_WINDOW_CAPACITY]; /**< ring of levels [quanta]. */
} belt_level_history_t;

/* Sum and difference that wrap: levels never do, but a flipped bit may make them. */
static inline belt_quanta_t belt_quanta_sum(belt_quanta_t a, belt_quanta_t b) {
    return (belt_quanta_t)((belt_word_t)a + (belt_word_t)b);
}
static inline belt_quanta_t belt_quanta_less(belt_quanta_t a, belt_quanta_t b) {
    return (belt_quanta_t)((belt_word_t)a - (belt_word_t)b);
}

/** Prepares a history for a checked configuration: every level 0. O(window). */
void belt_level_history_init(belt_level_history_t *history, const belt_config_t *config);

/** Makes the whole past equal to the first level, 0 <= level <= level_capacity [parts]. Once, after
 * init and before any push. O(1): levels are kept less the first one, and all of them are 0 then. */
void belt_level_history_begin(belt_level_history_t *history, belt_real_t level);

/** Adds the level of this period, 0 <= level <= level_capacity [parts]. */
void belt_level_history_push(belt_level_history_t *history, belt_real_t level);

/** R: integral of the level over the window that ends now, trapezoids [parts s]. */
belt_real_t belt_level_history_congestion(const belt_level_history_t *history);

/** Index of the level `age` whole periods old, 0 <= age < length. */
static inline uint32_t belt_level_history_index(const belt_level_history_t *history, uint32_t age) {
    const uint32_t wrap = (history->newest < age) ? history->length : 0u;
    return history->newest + wrap - age;
}

/** Level `age` periods ago, 0 <= age <= window, linear between periods [parts]. */
static inline belt_real_t belt_level_history_at(const belt_level_history_t *history,
                                                belt_real_t age) {
    const belt_real_t within = (age < history->window) ? age : history->window;
    const uint32_t whole = (uint32_t)(int32_t)within;
    const uint32_t periods = (whole < history->whole) ? whole : history->whole;
    const uint32_t young = belt_level_history_index(history, periods);
    const uint32_t old = (young == 0u) ? history->length - 1u : young - 1u;
    const belt_quanta_t level = history->level[young];
    const belt_real_t between = within - (belt_real_t)(int32_t)periods;
    return ((belt_real_t)belt_quanta_sum(history->base, level) +
            between * (belt_real_t)belt_quanta_less(history->level[old], level)) *
           history->quantum;
}

#endif
