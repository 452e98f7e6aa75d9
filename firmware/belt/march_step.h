/* SPDX-License-Identifier: MIT */
/*
 * march_step.h - the step that every stretch takes: its mean pace, then level, time and congestion behind
 * it. For the march alone.
 */
#ifndef BELT_MARCH_STEP_H
#define BELT_MARCH_STEP_H

#include "prediction.h"

/** A narrower stretch tells less of how the level changes than its rounding does [spacings]. */
#define BELT_MARCH_WIDTH_TOLD BELT_REAL(0.015625)

/** What leaves with a stretch. */
typedef struct {
    belt_real_t mean; /**< mean outlet density [parts/m]. */
    belt_real_t lead; /**< its first moment about the middle, over width^2: > 0 when more leaves in
                           the first cell than in the second [parts/m]. */
} belt_leaving_t;

/** Predicted level at a time from now, linear between the lines passed and going on with `slope` beyond
 * the last [parts/s]; the window's end only ever moves forward. */
static inline belt_real_t belt_march_predicted_level(belt_prediction_t *prediction,
                                                     const belt_line_t *belt, uint32_t count,
                                                     belt_real_t time, belt_real_t slope) {
    uint32_t line = prediction->tail_line;
    while ((line < count) && (prediction->arrival[line + 1u] <= time)) {
        ++line;
    }
    prediction->tail_line = line;
    if (line >= count) {
        return belt_line_level(belt, prediction->level[count] +
                                         slope * (time - prediction->arrival[count]));
    }
    const belt_real_t rise = prediction->level[line + 1u] - prediction->level[line];
    const belt_real_t duration = prediction->arrival[line + 1u] - prediction->arrival[line];
    return prediction->level[line] + rise * (time - prediction->arrival[line]) / duration;
}

/** The level that leaves the window at a time from now: recorded, or itself predicted (MF5). */
static inline belt_real_t belt_march_level_leaving(belt_prediction_t *prediction,
                                                   const belt_model_t *model,
                                                   const belt_front_t *front, belt_real_t time) {
    const belt_level_history_t *history = &model->history;
    const belt_real_t age = history->window - time * history->rate;
    return (age >= BELT_REAL(0))
               ? belt_level_history_at(history, age)
               : belt_march_predicted_level(prediction, &model->line, front->count,
                                            -age * history->period, front->rise / front->pace);
}

/** The same `later` than the line that the march has reached; a call, where it is asked for often. */
belt_real_t belt_march_tail_at(belt_prediction_t *prediction, const belt_model_t *model,
                               belt_real_t later);

/** Time that a spacing takes [s]. */
static inline belt_real_t belt_march_pace(const belt_line_t *line, belt_real_t congestion) {
    return belt_line_slowness(line, congestion) * line->spacing;
}

/* The level that leaves the window while a stretch passes counts twice: by its mean, front->tail, for the
 * congestion behind the stretch; and for the mean pace, in which what leaves early shows twice as much as
 * what leaves halfway, by the level a third into the stretch, `early`. */

/** Both from one look in the middle: the mean, and `early` by the look before. */
static inline belt_real_t belt_march_seen_once(belt_front_t *front, belt_real_t middle) {
    const belt_real_t early = middle - BELT_REAL(1.0 / 6.0) * (middle - front->tail);
    front->tail = middle;
    return early;
}

/** Mean pace of the stretch ahead (MF6), with levels that go on as they did in the stretch before. */
static inline belt_real_t belt_march_pace_ahead(const belt_line_t *line, const belt_front_t *front,
                                                belt_real_t width, belt_real_t early) {
    const belt_real_t level = front->level + BELT_REAL(1.0 / 3.0) * width * front->rise;
    const belt_real_t growth = line->crowding * BELT_HALF * width * (level - early);
    const belt_real_t then =
        belt_march_pace(line, front->congestion + BELT_REAL(2.0 / 3.0) * growth * front->pace);
    return belt_march_pace(line, front->congestion + growth * then);
}

/** Level, congestion and time behind a stretch (MF3, MF5, MF6). The mean level in time is the level at
 * its near line, half of what it gains, less what is served the more as it does so: with z, the time over
 * service_time, the series of (exp(-z) - 1 + z)/z^2. */
static inline void belt_march_pass(belt_prediction_t *prediction, const belt_model_t *model,
                                   belt_front_t *front, belt_real_t width, belt_real_t pace,
                                   belt_leaving_t leaving) {
    const belt_line_t *line = &model->line;
    const belt_real_t disturbance = model->present.disturbance;
    const belt_real_t dwell = width * pace;
    const belt_real_t gain = line->gain * width;
    const belt_real_t inflow = gain * leaving.mean;
    const belt_real_t net = inflow - (belt_line_service(line, front->level) - disturbance) * dwell;
    const belt_real_t z = dwell * line->service_rate;
    const belt_real_t share = BELT_HALF - z * (BELT_REAL(1.0 / 6.0) - BELT_REAL(1.0 / 24.0) * z);
    const belt_real_t mean =
        belt_line_level(line, front->level + gain * leaving.lead + share * net);
    const belt_real_t outflow = belt_line_service(line, mean) - disturbance;
    const belt_real_t before = front->level;
    front->level = belt_line_level(line, before + inflow - outflow * dwell);
    if (width > BELT_MARCH_WIDTH_TOLD) {
        front->rise = (front->level - before) / width;
    }
    front->arrival += dwell;
    front->congestion += line->crowding * (mean - front->tail) * dwell;
    front->pace = belt_march_pace(line, front->congestion);

    const uint32_t count = front->count;
    prediction->width[count] = width;
    prediction->pace[count] = pace;
    prediction->outlet_density[count] = leaving.mean;
    prediction->level[count + 1u] = front->level;
    prediction->arrival[count + 1u] = front->arrival;
    front->count = count + 1u;
}

#endif
