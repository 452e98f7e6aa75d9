/* SPDX-License-Identifier: MIT */
/*
 * march_step.h - the midpoint step that every stretch takes: pace in its middle, then level, time and
 * congestion behind it. For march_stretch.c and march_pairs.c.
 */
#ifndef BELT_MARCH_STEP_H
#define BELT_MARCH_STEP_H

#include "prediction.h"

/** What leaves with a stretch. */
typedef struct {
    belt_real_t mean; /**< mean outlet density [parts/m]. */
    belt_real_t lead; /**< its first moment about the middle, over width^2: > 0 when more leaves in
                           the first cell than in the second [parts/m]. */
} belt_leaving_t;

/** Predicted level at a time from now, linear between the lines passed; the window's end only ever moves
 * forward. */
static inline belt_real_t belt_march_predicted_level(belt_prediction_t *prediction, uint32_t count,
                                                     belt_real_t time) {
    uint32_t line = prediction->tail_line;
    while ((line + 1u < count) && (prediction->arrival[line + 1u] <= time)) {
        ++line;
    }
    prediction->tail_line = line;
    if (line >= count) {
        return prediction->level[count];
    }
    const belt_real_t rise = prediction->level[line + 1u] - prediction->level[line];
    const belt_real_t duration = prediction->arrival[line + 1u] - prediction->arrival[line];
    return prediction->level[line] + rise * (time - prediction->arrival[line]) / duration;
}

/** The level that leaves the window at a time from now: recorded, or itself predicted (MF5). */
static inline belt_real_t belt_march_level_leaving(belt_prediction_t *prediction,
                                                   const belt_level_history_t *history,
                                                   uint32_t count, belt_real_t time) {
    const belt_real_t age = history->window - time * history->rate;
    return (age >= BELT_REAL(0))
               ? belt_level_history_at(history, age)
               : belt_march_predicted_level(prediction, count, -age * history->period);
}

/** Time that a spacing takes [s]. */
static inline belt_real_t belt_march_pace(const belt_line_t *line, belt_real_t congestion) {
    return belt_line_slowness(line, congestion) * line->spacing;
}

/** Pace in the middle of the stretch ahead (MF6). */
static inline belt_real_t belt_march_pace_ahead(belt_prediction_t *prediction,
                                                const belt_model_t *model, belt_front_t *front,
                                                belt_real_t width) {
    const belt_line_t *line = &model->line;
    const belt_real_t half = BELT_HALF * width * front->pace;
    front->tail =
        belt_march_level_leaving(prediction, &model->history, front->count, front->arrival + half);
    const belt_real_t rise = line->crowding * (front->level - front->tail) * half;
    return belt_march_pace(line, front->congestion + rise);
}

/** Level, congestion and time behind a stretch (MF3, MF5, MF6). */
static inline void belt_march_pass(belt_prediction_t *prediction, const belt_model_t *model,
                                   belt_front_t *front, belt_real_t width, belt_real_t pace,
                                   belt_leaving_t leaving) {
    const belt_line_t *line = &model->line;
    const belt_real_t disturbance = model->present.disturbance;
    const belt_real_t dwell = width * pace;
    const belt_real_t gain = line->gain * width;
    const belt_real_t inflow = gain * leaving.mean;
    const belt_real_t outflow = (belt_line_service(line, front->level) - disturbance) * dwell;
    const belt_real_t middle =
        belt_line_level(line, front->level + gain * leaving.lead + BELT_HALF * (inflow - outflow));
    front->level = belt_line_level(
        line, front->level + inflow - (belt_line_service(line, middle) - disturbance) * dwell);
    front->arrival += dwell;
    front->place += width;
    front->congestion += line->crowding * (middle - front->tail) * dwell;
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
