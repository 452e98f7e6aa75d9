/* SPDX-License-Identifier: MIT */
#include "predictor.h"

#define HALF BELT_REAL(0.5)

/** The march's own state, at a line between two cells. */
typedef struct {
    const belt_line_t *line;
    const belt_level_history_t *history;
    const belt_observer_t *observer;
    belt_prediction_t *prediction;
    belt_real_t gain;         /**< level gained per density and spacing, alpha*spacing. */
    belt_real_t pace_slope;   /**< change of pace per congestion. */
    belt_real_t level;        /**< p1 [parts]. */
    belt_real_t arrival;      /**< sigma - t [s]. */
    belt_real_t pace;         /**< time a spacing takes, slowness*spacing [s]. */
    belt_real_t tail;         /**< level that leaves the window [parts]. */
    belt_transfer_t transfer; /**< K and I: at the line for uniform loss, else at the last centre. */
    belt_real_t rework_slope; /**< how much less of the rework a spacing on; uniform loss only. */
    uint16_t lines;           /**< lines passed: index of the present one. */
    uint16_t tail_line;       /**< the line at or before the window's end, once it is predicted. */
} march_t;

/** Predicted level at a time from now that lies between lines already passed. */
static belt_real_t predicted_tail(march_t *march, belt_real_t time) {
    const belt_prediction_t *p = march->prediction;
    while ((march->tail_line + 1 < march->lines) && (p->arrival[march->tail_line + 1] <= time)) {
        march->tail_line = (uint16_t)(march->tail_line + 1);
    }
    const uint16_t before = march->tail_line;
    if (before >= march->lines) {
        return p->level[before];
    }
    const belt_real_t share = (time - p->arrival[before]) / p->dwell[before];
    return p->level[before] + share * (p->level[before + 1] - p->level[before]);
}

/** Level that leaves the window at `arrival` from now: recorded, or itself predicted (MF5). */
static belt_real_t level_leaving_window(march_t *march, belt_real_t arrival) {
    const belt_real_t age = march->history->window - arrival * march->history->rate;
    if (age >= BELT_REAL(0)) {
        return belt_level_history_at(march->history, age);
    }
    return predicted_tail(march, -age * march->history->period);
}

/** Time that `width` spacings will take to pass the outlet (MF6): the pace of the middle. */
static belt_real_t dwell_ahead(march_t *march, belt_real_t width) {
    const belt_real_t half = HALF * width;
    march->tail = level_leaving_window(march, march->arrival + half * march->pace);
    const belt_real_t rise = march->pace_slope * (march->level - march->tail) * march->pace;
    return width * (march->pace + half * rise);
}

/** Level, congestion and time behind a cell that leaves with `outlet_density` (MF3, MF5, MF6). */
static void pass_cell(march_t *march, belt_real_t width, belt_real_t dwell,
                      belt_real_t outlet_density) {
    const belt_real_t inflow = march->gain * outlet_density * width;
    const belt_real_t middle =
        march->level + HALF * (inflow - belt_line_service(march->line, march->level) * dwell);
    march->level += inflow - belt_line_service(march->line, middle) * dwell;
    march->arrival += dwell;
    march->pace += march->pace_slope * (middle - march->tail) * dwell;

    belt_prediction_t *p = march->prediction;
    p->outlet_density[march->lines] = outlet_density;
    p->dwell[march->lines] = dwell;
    march->lines = (uint16_t)(march->lines + 1);
    p->level[march->lines] = march->level;
    p->arrival[march->lines] = march->arrival;
}

/* Uniform loss: all material ages alike, so survival and rework are carried along (MF4, MF7):
 *     survival'     = -C*survival                            (' = d/dtime)
 *     rework'       = A*D*p2 - C*rework - rework_slope per spacing
 *     rework_slope' = A*spacing*p2 - C*rework_slope
 */
static void carry_transfer(march_t *march, belt_real_t width, belt_real_t dwell, belt_real_t kept,
                           belt_real_t outlet_density) {
    const belt_real_t left = outlet_density * dwell;
    const belt_real_t slope_gain = march->line->rework_per_spacing * left;
    const belt_real_t slope_middle = kept * march->rework_slope + HALF * slope_gain;
    belt_transfer_t *transfer = &march->transfer;
    transfer->survival *= kept * kept;
    transfer->rework = kept * (kept * transfer->rework + march->line->rework_at_outlet * left -
                               slope_middle * width);
    march->rework_slope = kept * (kept * march->rework_slope + slope_gain);
}

/** p2 of a cell whose centre passes the outlet in the middle of the step; uniform loss. */
static belt_real_t carried_density(march_t *march, belt_real_t width, belt_real_t dwell,
                                   belt_real_t density) {
    const belt_line_t *line = march->line;
    const belt_real_t loss = HALF * line->loss_mean * dwell;
    const belt_real_t kept = belt_line_survival(loss);
    const belt_real_t kept_halfway = BELT_REAL(1) - HALF * loss;
    const belt_real_t before = kept * (march->transfer.survival * density + march->transfer.rework);
    const belt_real_t half_rework = HALF * line->rework_at_outlet * dwell;
    const belt_real_t left = HALF * dwell * before * (BELT_REAL(1) + half_rework);
    const belt_real_t slope =
        kept_halfway * march->rework_slope + HALF * line->rework_per_spacing * left;
    const belt_real_t outlet_density =
        before + kept_halfway * (line->rework_at_outlet * left - HALF * slope * width);
    carry_transfer(march, width, dwell, kept, outlet_density);
    return outlet_density;
}

static belt_passed_t passed_cells(const march_t *march) {
    belt_passed_t passed;
    passed.dwell = march->prediction->dwell;
    passed.outlet_density = march->prediction->outlet_density;
    passed.count = march->lines;
    passed.first_width = BELT_REAL(1) - march->observer->gone;
    return passed;
}

/** The same for any loss: the cell's centre at `place` is moved past all cells before it. */
static belt_real_t forwarded_density(march_t *march, belt_real_t place, belt_real_t width,
                                     belt_real_t dwell, belt_real_t density) {
    const belt_passed_t passed = passed_cells(march);
    march->transfer = belt_fast_forward(march->line, &passed, place);
    const belt_real_t left = march->transfer.survival * density + march->transfer.rework;
    belt_fast_forward_last(&march->transfer, march->line, HALF * width, HALF * dwell, left);
    return march->transfer.survival * density + march->transfer.rework;
}

static void march_over(march_t *march, uint16_t cell, belt_real_t place, belt_real_t width) {
    const belt_real_t density = march->observer->density[cell];
    const belt_real_t dwell = dwell_ahead(march, width);
    const belt_real_t outlet_density =
        march->line->loss_is_uniform ? carried_density(march, width, dwell, density)
                                     : forwarded_density(march, place, width, dwell, density);
    pass_cell(march, width, dwell, outlet_density);
}

/** The outlet cell: its centre has less than half a spacing to go, or has left. */
static void march_over_outlet_cell(march_t *march) {
    const belt_real_t gone = march->observer->gone;
    const belt_real_t width = BELT_REAL(1) - gone;
    const belt_real_t dwell = dwell_ahead(march, width);
    const belt_real_t rest = belt_observer_rest_of_outlet(march->observer);
    belt_real_t outlet_density = rest;
    if (gone < HALF) {
        belt_transfer_t transfer = {BELT_REAL(1), BELT_REAL(0)};
        const belt_real_t place = HALF - gone;
        belt_fast_forward_last(&transfer, march->line, place, place * march->pace, rest);
        outlet_density = transfer.survival * rest + transfer.rework;
    }
    const belt_real_t kept = belt_line_survival(HALF * march->line->loss_mean * dwell);
    carry_transfer(march, width, dwell, kept, outlet_density);
    pass_cell(march, width, dwell, outlet_density);
}

/** Whole cells from one up to, without, another; returns the last one's ring index. */
static uint16_t march_over_whole_cells(march_t *march, uint16_t cell, uint16_t from, uint16_t to) {
    belt_real_t place = (belt_real_t)from + HALF - march->observer->gone;
    for (uint16_t i = from; i < to; ++i) {
        cell = belt_observer_next(march->line, cell);
        march_over(march, cell, place, BELT_REAL(1));
        place += BELT_REAL(1);
    }
    return cell;
}

/** What (MF1) asks for at the inlet, out of the march's last line. `before` is the rework at a place
 * one cell earlier. */
static void conclude(march_t *march, belt_real_t before) {
    const belt_line_t *line = march->line;
    const belt_real_t gone = march->observer->gone;
    belt_prediction_t *p = march->prediction;
    belt_transfer_t transfer = march->transfer;
    belt_real_t distance = BELT_REAL(1) + gone;
    if (!line->loss_is_uniform) {
        belt_passed_t passed = passed_cells(march);
        passed.count = line->node_count;
        transfer = belt_fast_forward(line, &passed, (belt_real_t)line->node_count);
        belt_fast_forward_last(&transfer, line, gone, p->dwell[line->node_count],
                               p->outlet_density[line->node_count]);
        distance += HALF;
    }
    p->inlet_level = march->level;
    p->inlet_arrival = march->arrival;
    p->inlet_slowness = march->pace / line->spacing;
    p->inlet_congestion = (p->inlet_slowness - line->slowness_empty) / line->slowness_slope;
    p->inlet_survival = transfer.survival;
    p->inlet_rework = transfer.rework;
    p->inlet_rework_slope = (transfer.rework - before) / distance;
    p->inlet_tail = march->tail;
}

void belt_predictor_march(belt_prediction_t *prediction, const belt_line_t *line,
                          const belt_level_history_t *history, const belt_observer_t *observer,
                          const belt_present_t *present, belt_prediction_kind_t kind) {
    march_t march;
    march.line = line;
    march.history = history;
    march.observer = observer;
    march.prediction = prediction;
    march.gain = line->connectivity * line->spacing;
    march.pace_slope =
        (kind == BELT_HOLD_CONGESTION) ? BELT_REAL(0) : line->slowness_slope * line->spacing;
    march.level = present->level;
    march.arrival = BELT_REAL(0);
    march.pace = belt_line_slowness(line, present->congestion) * line->spacing;
    march.transfer.survival = BELT_REAL(1);
    march.transfer.rework = BELT_REAL(0);
    march.rework_slope = BELT_REAL(0);
    march.lines = 0;
    march.tail_line = 0;
    prediction->level[0] = march.level;
    prediction->arrival[0] = march.arrival;

    const uint16_t last_whole = (uint16_t)(line->node_count - 1);
    march_over_outlet_cell(&march);
    uint16_t cell = march_over_whole_cells(&march, observer->outlet, 1, last_whole);
    const belt_real_t rework_before = march.transfer.rework;
    cell = march_over_whole_cells(&march, cell, last_whole, line->node_count);
    cell = belt_observer_next(line, cell);
    march_over(&march, cell, (belt_real_t)line->node_count - HALF * observer->gone,
               observer->gone);
    conclude(&march, rework_before);
}
