/* SPDX-License-Identifier: MIT */
#include "predictor.h"

#include "march_pairs.h"
#include "march_step.h"
#include "march_stretch.h"

/** Density of what is left of the outlet cell, at the age of its own middle. The cell holds it at the
 * age of the cell's middle, or, once that has left, of the outlet. */
static belt_real_t rest_of_outlet(const belt_line_t *line, const belt_observer_t *observer,
                                  belt_real_t pace) {
    const belt_real_t density = belt_observer_rest_of_outlet(observer);
    const belt_real_t rest = BELT_REAL(1) - observer->gone;
    const belt_real_t time = BELT_HALF * ((observer->gone < rest) ? observer->gone : rest) * pace;
    const belt_real_t loss = belt_line_loss(line, 0u) * time;
    return density + density * loss * (BELT_REAL(1) + BELT_HALF * loss) -
           belt_line_returned(density) * belt_line_rework(line, BELT_REAL(0)) * time;
}

/** Whether the outlet cell is the inlet-side one of its pair. */
static bool outlet_is_second(const belt_observer_t *observer) {
    return (observer->outlet & 1u) != 0u;
}

static void start(belt_prediction_t *prediction, const belt_model_t *model) {
    const belt_present_t *present = &model->present;
    const belt_line_t *line = &model->line;
    belt_front_t *front = &prediction->inlet;
    front->level = present->level;
    front->arrival = BELT_REAL(0);
    front->congestion = present->congestion;
    front->pace = belt_march_pace(line, present->congestion);
    prediction->present_tail = belt_level_history_at(&model->history, model->history.window);
    front->tail = prediction->present_tail;
    const belt_real_t net =
        line->gain * model->observer.outlet_density -
        (belt_line_service(line, present->level) - present->disturbance) * front->pace;
    front->rise = belt_line_level(line, present->level + net) - present->level;
    prediction->place = BELT_REAL(0);
    front->carried.survival = BELT_REAL(1);
    front->carried.rework = BELT_REAL(0);
    front->carried.rework_slope = BELT_REAL(0);
    front->rework_before = BELT_REAL(0);
    front->count = 0;
    prediction->level[0] = present->level;
    prediction->arrival[0] = BELT_REAL(0);
    prediction->tail_line = 0;
}

/** The outlet's end: the rest of the outlet cell, with the other one of its pair if that is still
 * on the belt. Returns the ring index of the cell behind. */
static uint32_t march_outlet(belt_prediction_t *prediction, const belt_model_t *model) {
    const belt_observer_t *observer = &model->observer;
    const bool is_pair = !outlet_is_second(observer);
    const uint32_t next = belt_observer_behind(&model->line, observer->outlet, 1u);
    const belt_stretch_t stretch = {
        {rest_of_outlet(&model->line, observer, prediction->inlet.pace), observer->density[next]},
        {BELT_REAL(1) - observer->gone, is_pair ? BELT_REAL(1) : BELT_REAL(0)}};
    belt_march_stretch(prediction, model, &stretch);
    return is_pair ? belt_observer_behind(&model->line, next, 1u) : next;
}

/** Whole cells in pairs; returns the ring index of the cell behind them. */
static uint32_t march_pairs(belt_prediction_t *prediction, const belt_model_t *model, uint32_t cell,
                            uint32_t pairs) {
    belt_front_t *front = &prediction->inlet;
    for (uint32_t i = 0; i < pairs; ++i) {
        const belt_real_t *density = &model->observer.density[cell];
        const belt_stretch_t pair = {{density[0], density[1]}, {BELT_REAL(1), BELT_REAL(1)}};
        belt_march_stretch(prediction, model, &pair);
        front->rework_before = front->carried.survival * front->carried.rework;
        cell = belt_observer_behind(&model->line, cell, 2u);
    }
    return cell;
}

/** The inlet's end: the open cell, with the whole one of its pair if there is one. */
static void march_inlet(belt_prediction_t *prediction, const belt_model_t *model, uint32_t cell,
                        bool is_pair) {
    const belt_observer_t *observer = &model->observer;
    const uint32_t open = is_pair ? belt_observer_behind(&model->line, cell, 1u) : cell;
    const belt_stretch_t stretch = {
        {observer->density[cell], observer->density[open]},
        {is_pair ? BELT_REAL(1) : observer->gone, is_pair ? observer->gone : BELT_REAL(0)}};
    belt_march_stretch(prediction, model, &stretch);
}

/** What (MF1) asks for at the inlet, out of the march's last line. */
static void conclude(belt_prediction_t *prediction) {
    const belt_front_t *inlet = &prediction->inlet;
    const belt_real_t rework = inlet->carried.survival * inlet->carried.rework;
    prediction->inlet_survival = inlet->carried.survival;
    prediction->inlet_rework = rework;
    prediction->inlet_rework_slope =
        (rework - inlet->rework_before) / (BELT_REAL(1) + prediction->width[inlet->count - 1u]);
}

void belt_predictor_march(belt_prediction_t *prediction, const belt_model_t *model) {
    const belt_line_t *line = &model->line;
    /* Of the cells 0 ... node_count the outlet's end takes one or two, the inlet's end the rest. */
    const uint32_t behind = line->node_count - (outlet_is_second(&model->observer) ? 0u : 1u);
    const uint32_t pairs = (behind - 1u) / 2u;
    start(prediction, model);
    uint32_t cell = march_outlet(prediction, model);
    cell = belt_line_is_plain(line) ? belt_march_plain_pairs(prediction, model, cell, pairs)
                                    : march_pairs(prediction, model, cell, pairs);
    march_inlet(prediction, model, cell, behind > 2u * pairs + 1u);
    belt_march_to_inlet(prediction, model);
    conclude(prediction);
}
