/* SPDX-License-Identifier: MIT */
/*
 * march.h - one step of the march: level, time and congestion while a stretch of belt passes the
 * outlet. For predictor.c alone; its results, belt_prediction_t, are everybody's.
 */
#ifndef BELT_MARCH_H
#define BELT_MARCH_H

#include "carried_transfer.h"
#include "level_history.h"
#include "observer.h"

/** Stretches that a march passes: cells in pairs, at each end a pair or one cell. */
#define BELT_STRETCH_CAPACITY (BELT_NODE_CAPACITY / 2 + 2)

/** What the march found. Line 0 is the outlet now, line i + 1 the inlet end of stretch i, the last
 * line the inlet. Times are from now. */
typedef struct {
    belt_real_t level[BELT_STRETCH_CAPACITY + 1];   /**< p1 at the lines [parts]. */
    belt_real_t arrival[BELT_STRETCH_CAPACITY + 1]; /**< sigma - t at the lines [s]. */
    belt_real_t width[BELT_STRETCH_CAPACITY];       /**< of each stretch, at most 2 [spacings]. */
    belt_real_t pace[BELT_STRETCH_CAPACITY];        /**< time each takes for a spacing [s]. */
    belt_real_t outlet_density[BELT_STRETCH_CAPACITY]; /**< p2, its mean over each [parts/m]. */
    uint32_t count;                                    /**< stretches. */

    belt_real_t inlet_level;      /**< p1(D) [parts]. */
    belt_real_t inlet_arrival;    /**< sigma(D) - t: the dead time [s]. */
    belt_real_t inlet_slowness;   /**< P (1 + p3(D)) [s/m]. */
    belt_real_t inlet_congestion; /**< p3(D) [parts s]. */
    belt_real_t inlet_survival;   /**< K(D, D): share of what is fed now that will leave, (0, 1]. */
    belt_real_t inlet_rework;     /**< I(D): density it will have picked up by then [parts/m]. */
    belt_real_t inlet_rework_slope; /**< how much more of it a spacing further in [parts/m]. */
    belt_real_t inlet_tail;         /**< level that leaves the window when it arrives [parts]. */
} belt_prediction_t;

/** The march's own state, at a line between two stretches of belt. */
typedef struct {
    belt_real_t level;      /**< p1 [parts]. */
    belt_real_t arrival;    /**< sigma - t [s]. */
    belt_real_t pace;       /**< time a spacing takes, slowness*spacing [s]. */
    belt_real_t tail;       /**< level that leaves the window [parts]. */
    belt_real_t place;      /**< of the line, now [spacings from the outlet]. */
    belt_carried_t carried; /**< K, I/K: at the line for uniform loss, else at the last middle. */
    uint32_t count;         /**< stretches passed. */
    uint32_t tail_line;     /**< the line at or before the window's end, once it is predicted. */
} belt_march_t;

/** What the march reads and where it writes. */
typedef struct {
    const belt_line_t *line;
    const belt_level_history_t *history;
    const belt_observer_t *observer;
    belt_prediction_t *prediction;
    belt_real_t gain;        /**< level gained per density and spacing, alpha*spacing. */
    belt_real_t pace_slope;  /**< change of pace per congestion. */
    belt_real_t disturbance; /**< flow into the buffer besides [parts/s]. */
} belt_march_setting_t;

/** What leaves with a stretch: one cell, or two behind each other. */
typedef struct {
    belt_real_t mean; /**< mean outlet density [parts/m]. */
    belt_real_t lead; /**< its first moment about the middle, over width^2: > 0 when more leaves in
                           the first cell than in the second [parts/m]. */
} belt_leaving_t;

/** Predicted level at a time from now, linear between the lines passed; the window's end only ever
 * moves forward. */
static inline belt_real_t belt_march_predicted_level(const belt_prediction_t *prediction,
                                                     belt_march_t *march, belt_real_t time) {
    uint32_t line = march->tail_line;
    while ((line + 1u < march->count) && (prediction->arrival[line + 1u] <= time)) {
        ++line;
    }
    march->tail_line = line;
    if (line >= march->count) {
        return march->level;
    }
    const belt_real_t rise = prediction->level[line + 1u] - prediction->level[line];
    const belt_real_t duration = prediction->arrival[line + 1u] - prediction->arrival[line];
    return prediction->level[line] + rise * (time - prediction->arrival[line]) / duration;
}

/** Pace in the middle of the stretch ahead (MF6). Finds the level that leaves the window there:
 * recorded, or itself predicted (MF5). */
static inline belt_real_t belt_march_pace_ahead(const belt_march_setting_t *at, belt_march_t *march,
                                                belt_real_t width) {
    const belt_real_t arrival = march->arrival + BELT_HALF * width * march->pace;
    const belt_real_t age = at->history->window - arrival * at->history->rate;
    march->tail = (age >= BELT_REAL(0)) ? belt_level_history_at(at->history, age)
                                        : belt_march_predicted_level(at->prediction, march,
                                                                     -age * at->history->period);
    const belt_real_t rise = at->pace_slope * (march->level - march->tail) * march->pace;
    return march->pace + BELT_HALF * width * rise;
}

/** Level, congestion and time behind a stretch (MF3, MF5, MF6). */
static inline void belt_march_pass(const belt_march_setting_t *at, belt_march_t *march,
                                   belt_real_t width, belt_real_t pace, belt_leaving_t leaving) {
    const belt_real_t dwell = width * pace;
    const belt_real_t gain = at->gain * width;
    const belt_real_t inflow = gain * leaving.mean;
    const belt_real_t outflow =
        (belt_line_service(at->line, march->level) - at->disturbance) * dwell;
    const belt_real_t middle = belt_line_level(at->line, march->level + gain * leaving.lead +
                                                             BELT_HALF * (inflow - outflow));
    march->level = belt_line_level(
        at->line,
        march->level + inflow - (belt_line_service(at->line, middle) - at->disturbance) * dwell);
    march->arrival += dwell;
    march->place += width;
    march->pace += at->pace_slope * (middle - march->tail) * dwell;

    belt_prediction_t *p = at->prediction;
    const uint32_t count = march->count;
    p->width[count] = width;
    p->pace[count] = pace;
    p->outlet_density[count] = leaving.mean;
    p->level[count + 1u] = march->level;
    p->arrival[count + 1u] = march->arrival;
    march->count = count + 1u;
}

#endif
