/* SPDX-License-Identifier: MIT */
#include "predictor.h"

#define HALF BELT_REAL(0.5)

/** The march's own state, at a line between two stretches of belt. */
typedef struct {
    belt_real_t level;        /**< p1 [parts]. */
    belt_real_t arrival;      /**< sigma - t [s]. */
    belt_real_t pace;         /**< time a spacing takes, slowness*spacing [s]. */
    belt_real_t tail;         /**< level that leaves the window [parts]. */
    belt_real_t survival;     /**< K; at the line for uniform loss, else at the last middle. */
    belt_real_t rework;       /**< I; likewise. */
    belt_real_t rework_slope; /**< how much less of the rework a spacing on; uniform loss only. */
    uint32_t count;           /**< stretches passed. */
    uint32_t tail_line;       /**< the line at or before the window's end, once it is predicted. */
} march_t;

/** What the march reads and where it writes. */
typedef struct {
    const belt_line_t *line;
    const belt_level_history_t *history;
    const belt_observer_t *observer;
    belt_prediction_t *prediction;
    belt_real_t gain;       /**< level gained per density and spacing, alpha*spacing. */
    belt_real_t pace_slope; /**< change of pace per congestion. */
} setting_t;

/** What leaves with a stretch: one cell, or two behind each other. */
typedef struct {
    belt_real_t mean; /**< mean outlet density [parts/m]. */
    belt_real_t lead; /**< a quarter of what the first cell has more of it than the second. */
} leaving_t;

/** Predicted level at a time from now, linear between the lines passed; the window's end only ever
 * moves forward. */
static belt_real_t predicted_level(const belt_prediction_t *prediction, march_t *march,
                                   belt_real_t time) {
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
static inline belt_real_t pace_ahead(const setting_t *at, march_t *march, belt_real_t width) {
    const belt_real_t arrival = march->arrival + HALF * width * march->pace;
    const belt_real_t age = at->history->window - arrival * at->history->rate;
    march->tail = (age >= BELT_REAL(0))
                      ? belt_level_history_at(at->history, age)
                      : predicted_level(at->prediction, march, -age * at->history->period);
    const belt_real_t rise = at->pace_slope * (march->level - march->tail) * march->pace;
    return march->pace + HALF * width * rise;
}

/** Level, congestion and time behind a stretch (MF3, MF5, MF6). */
static inline void pass(const setting_t *at, march_t *march, belt_real_t width, belt_real_t pace,
                        leaving_t leaving) {
    const belt_real_t dwell = width * pace;
    const belt_real_t gain = at->gain * width;
    const belt_real_t inflow = gain * leaving.mean;
    const belt_real_t outflow = belt_line_service(at->line, march->level) * dwell;
    const belt_real_t middle = march->level + gain * leaving.lead + HALF * (inflow - outflow);
    march->level += inflow - belt_line_service(at->line, middle) * dwell;
    march->arrival += dwell;
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

/* Uniform loss: all material ages alike, so survival and rework are carried along (MF4, MF7):
 *     survival'     = -C*survival                            (' = d/dtime)
 *     rework'       = A*D*p2 - C*rework - rework_slope per spacing
 *     rework_slope' = A*spacing*p2 - C*rework_slope
 */

/** One cell's factors, the same for cells of one width and pace. */
typedef struct {
    belt_real_t width;        /**< [spacings]. */
    belt_real_t kept;         /**< survives half the cell. */
    belt_real_t kept_halfway; /**< survives a quarter. */
    belt_real_t half_dwell;   /**< half the time it takes, rework in it included [s]. */
    belt_real_t rework;       /**< A*D*dwell: rework of the whole cell per density leaving. */
    belt_real_t slope;        /**< A*spacing*dwell: its change a spacing on. */
} factors_t;

static inline factors_t factors_of(const belt_line_t *line, belt_real_t width, belt_real_t pace) {
    const belt_real_t dwell = width * pace;
    const belt_real_t loss = HALF * line->loss_mean * dwell;
    factors_t factors;
    factors.width = width;
    factors.kept = belt_line_survival(loss);
    factors.kept_halfway = BELT_REAL(1) - HALF * loss;
    factors.rework = line->rework_at_outlet * dwell;
    factors.slope = line->rework_per_spacing * dwell;
    factors.half_dwell = HALF + BELT_REAL(0.25) * factors.rework;
    return factors;
}

/** Behind a cell that leaves with `density`. */
static inline void carry(march_t *march, const factors_t *factors, belt_real_t density) {
    const belt_real_t kept = factors->kept;
    const belt_real_t slope_gain = factors->slope * density;
    const belt_real_t slope_kept = kept * march->rework_slope;
    march->survival *= kept * kept;
    march->rework = kept * (kept * march->rework + factors->rework * density -
                            (slope_kept + HALF * slope_gain) * factors->width);
    march->rework_slope = kept * (slope_kept + slope_gain);
}

/** p2 of one cell, in its middle: half a step, with what leaves in it and the slope at a quarter. */
static inline belt_real_t carried_density(march_t *march, const factors_t *factors,
                                          belt_real_t density) {
    const belt_real_t before = factors->kept * (march->survival * density + march->rework);
    const belt_real_t left = factors->half_dwell * before;
    const belt_real_t slope =
        factors->kept_halfway * march->rework_slope + HALF * factors->slope * left;
    const belt_real_t outlet_density =
        before +
        factors->kept_halfway * (factors->rework * left - HALF * slope * factors->width);
    carry(march, factors, outlet_density);
    return outlet_density;
}

/** Whole cells in pairs, uniform loss: the loop in which the step spends its time. */
static uint32_t march_pairs(const setting_t *at, march_t *start, uint32_t cell, uint32_t pairs) {
    const belt_line_t *line = at->line;
    march_t march = *start;
    for (uint32_t i = 0; i < pairs; ++i) {
        const belt_real_t pace = pace_ahead(at, &march, BELT_REAL(2));
        const factors_t factors = factors_of(line, BELT_REAL(1), pace);
        const belt_real_t first = carried_density(&march, &factors, at->observer->density[cell]);
        cell = belt_observer_next(line, cell);
        const belt_real_t second = carried_density(&march, &factors, at->observer->density[cell]);
        cell = belt_observer_next(line, cell);
        const leaving_t leaving = {HALF * (first + second), BELT_REAL(0.125) * (first - second)};
        pass(at, &march, BELT_REAL(2), pace, leaving);
    }
    *start = march;
    return cell;
}

static belt_passed_t passed_stretches(const belt_prediction_t *prediction, uint32_t count) {
    const belt_passed_t passed = {prediction->width, prediction->pace, prediction->outlet_density,
                                  count};
    return passed;
}

/** Any loss: survival and rework of the material that passes the outlet in the middle of a stretch
 * `width` wide, from `place`. */
static void forward(const setting_t *at, march_t *march, belt_real_t place, belt_real_t width,
                    belt_real_t pace, belt_real_t density) {
    const belt_passed_t passed = passed_stretches(at->prediction, march->count);
    belt_transfer_t transfer = belt_fast_forward(at->line, &passed, place);
    const belt_real_t left = transfer.survival * density + transfer.rework;
    belt_fast_forward_last(&transfer, at->line, HALF * width, pace, left);
    march->survival = transfer.survival;
    march->rework = transfer.rework;
}

/** The pairs again, for any loss: the middle is moved past all before it, the two cells told apart
 * by the loss between them. */
static uint32_t march_pairs_forward(const setting_t *at, march_t *march, uint32_t cell,
                                    uint32_t pairs, belt_real_t place) {
    const belt_line_t *line = at->line;
    for (uint32_t i = 0; i < pairs; ++i) {
        const uint32_t inner = cell;
        const uint32_t outer = belt_observer_next(line, cell);
        const belt_real_t pace = pace_ahead(at, march, BELT_REAL(2));
        const belt_real_t middle = place + (belt_real_t)(2u * i + 1u);
        const belt_real_t sum = at->observer->density[inner] + at->observer->density[outer];
        forward(at, march, middle, BELT_REAL(2), pace, HALF * sum);

        const belt_real_t loss = HALF * line->loss[(int32_t)middle] * pace;
        const belt_real_t more = BELT_REAL(1) + loss + HALF * loss * loss;
        const belt_real_t less = more - BELT_REAL(2) * loss;
        const belt_real_t first = march->survival * more * at->observer->density[inner];
        const belt_real_t second = march->survival * less * at->observer->density[outer];
        const leaving_t leaving = {HALF * (first + second) + march->rework,
                                   BELT_REAL(0.125) * (first - second)};
        pass(at, march, BELT_REAL(2), pace, leaving);
        cell = belt_observer_next(line, outer);
    }
    return cell;
}

/** One cell by itself, `width` wide, its middle at `place`. */
static void march_single(const setting_t *at, march_t *march, uint32_t cell, belt_real_t place,
                         belt_real_t width) {
    const belt_real_t density = at->observer->density[cell];
    const belt_real_t pace = pace_ahead(at, march, width);
    leaving_t leaving = {BELT_REAL(0), BELT_REAL(0)};
    if (at->line->loss_is_uniform) {
        const factors_t factors = factors_of(at->line, width, pace);
        leaving.mean = carried_density(march, &factors, density);
    } else {
        forward(at, march, place, width, pace, density);
        leaving.mean = march->survival * density + march->rework;
    }
    pass(at, march, width, pace, leaving);
}

/** The outlet cell: its centre has less than half a spacing to go, or has left. */
static void march_outlet_cell(const setting_t *at, march_t *march) {
    const belt_real_t gone = at->observer->gone;
    const belt_real_t width = BELT_REAL(1) - gone;
    const belt_real_t pace = pace_ahead(at, march, width);
    const belt_real_t rest = belt_observer_rest_of_outlet(at->observer);
    leaving_t leaving = {rest, BELT_REAL(0)};
    if (gone < HALF) {
        belt_transfer_t transfer = {BELT_REAL(1), BELT_REAL(0)};
        belt_fast_forward_last(&transfer, at->line, HALF - gone, pace, rest);
        leaving.mean = transfer.survival * rest + transfer.rework;
    }
    const factors_t factors = factors_of(at->line, width, pace);
    carry(march, &factors, leaving.mean);
    pass(at, march, width, pace, leaving);
}

/** Whole cells 1 ... node_count - 1; `before` gets the rework before the last of them. Returns the
 * open cell's ring index. */
static uint32_t march_whole_cells(const setting_t *at, march_t *march, belt_real_t *before) {
    const belt_line_t *line = at->line;
    const uint32_t pairs = (line->node_count - 2u) / 2u;
    belt_real_t place = BELT_REAL(1) - at->observer->gone;
    uint32_t cell = belt_observer_next(line, at->observer->outlet);
    if ((line->node_count & 1u) != 0u) {
        march_single(at, march, cell, place + HALF, BELT_REAL(1));
        place += BELT_REAL(1);
        cell = belt_observer_next(line, cell);
    }
    cell = line->loss_is_uniform ? march_pairs(at, march, cell, pairs)
                                 : march_pairs_forward(at, march, cell, pairs, place);
    *before = march->rework;
    place += (belt_real_t)(2u * pairs);
    march_single(at, march, cell, place + HALF, BELT_REAL(1));
    return belt_observer_next(line, cell);
}

/** What (MF1) asks for at the inlet, out of the march's last line. `before` is the rework of the
 * material where the last whole cell begins, or where the pair before it has its middle. */
static void conclude(const setting_t *at, march_t *march, belt_real_t before) {
    const belt_line_t *line = at->line;
    belt_prediction_t *p = at->prediction;
    const uint32_t last = march->count - 1u;
    belt_real_t distance = BELT_REAL(1) + p->width[last];
    if (!line->loss_is_uniform) {
        const belt_passed_t passed = passed_stretches(p, last);
        belt_transfer_t transfer =
            belt_fast_forward(line, &passed, (belt_real_t)line->node_count);
        belt_fast_forward_last(&transfer, line, p->width[last], p->pace[last],
                               p->outlet_density[last]);
        march->survival = transfer.survival;
        march->rework = transfer.rework;
        distance += BELT_REAL(1);
    }
    p->count = march->count;
    p->inlet_level = march->level;
    p->inlet_arrival = march->arrival;
    p->inlet_slowness = march->pace / line->spacing;
    p->inlet_congestion = (p->inlet_slowness - line->slowness_empty) / line->slowness_slope;
    p->inlet_survival = march->survival;
    p->inlet_rework = march->rework;
    p->inlet_rework_slope = (march->rework - before) / distance;
    p->inlet_tail = march->tail;
}

void belt_predictor_march(belt_prediction_t *prediction, const belt_line_t *line,
                          const belt_level_history_t *history, const belt_observer_t *observer,
                          const belt_present_t *present, belt_prediction_kind_t kind) {
    const belt_real_t pace_slope =
        (kind == BELT_HOLD_CONGESTION) ? BELT_REAL(0) : line->slowness_slope * line->spacing;
    const setting_t at = {line, history, observer, prediction, line->connectivity * line->spacing,
                          pace_slope};
    march_t march = {0};
    march.level = present->level;
    march.pace = belt_line_slowness(line, present->congestion) * line->spacing;
    march.survival = BELT_REAL(1);
    prediction->level[0] = march.level;
    prediction->arrival[0] = march.arrival;

    belt_real_t rework_before = BELT_REAL(0);
    march_outlet_cell(&at, &march);
    const uint32_t open = march_whole_cells(&at, &march, &rework_before);
    march_single(&at, &march, open, (belt_real_t)line->node_count - HALF * observer->gone,
                 observer->gone);
    conclude(&at, &march, rework_before);
}
