/* SPDX-License-Identifier: MIT */
#include "predictor.h"

#define HALF BELT_REAL(0.5)

/** The march's own state, at a line between two stretches of belt. */
typedef struct {
    belt_real_t level;        /**< p1 [parts]. */
    belt_real_t arrival;      /**< sigma - t [s]. */
    belt_real_t pace;         /**< time a spacing takes, slowness*spacing [s]. */
    belt_real_t tail;         /**< level that leaves the window [parts]. */
    belt_real_t place;        /**< of the line, now [spacings from the outlet]. */
    belt_real_t survival;     /**< K; at the line for uniform loss, else at the last middle. */
    belt_real_t rework;       /**< I/K: what could have been fed instead; likewise. */
    belt_real_t rework_slope; /**< how much less of that a spacing on; uniform loss only. */
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

/* Uniform loss: all material ages alike, so survival and rework are carried along (MF4, MF7). With
 * the rework as a density that could have been fed instead, p2 = survival*amount, where amount =
 * density + rework, and the loss divides out of the rest:
 *     survival'     = -C*survival                              (' = d/dtime)
 *     rework'       = A*D*amount - rework_slope per spacing
 *     rework_slope' = A*spacing*amount
 */
typedef struct {
    belt_real_t kept_half; /**< what survives half the cell. */
    belt_real_t width;     /**< [spacings]. */
    belt_real_t middle; /**< amount in the middle per amount at the near line, but for the slope. */
    belt_real_t rework; /**< rework gained in the cell per amount. */
    belt_real_t slope;  /**< slope gained in it per amount. */
} factors_t;

static inline factors_t factors_of(const belt_line_t *line, belt_real_t width, belt_real_t pace) {
    const belt_real_t dwell = width * pace;
    const belt_real_t half_rework = HALF * line->rework_at_outlet * dwell;
    factors_t factors;
    factors.kept_half = belt_line_survival(HALF * line->loss_mean * dwell);
    factors.width = width;
    factors.slope = line->rework_per_spacing * dwell;
    /* Half a cell: rework by what enters it and by what that makes, less by the slope it makes. */
    factors.middle = BELT_REAL(1) + half_rework * (BELT_REAL(1) + half_rework) -
                     BELT_REAL(0.125) * width * factors.slope;
    factors.rework = BELT_REAL(2) * half_rework - HALF * width * factors.slope;
    return factors;
}

/** Behind a cell that left with `amount`. */
static inline void carry_rework(march_t *march, const factors_t *factors, belt_real_t amount) {
    march->rework += factors->rework * amount - factors->width * march->rework_slope;
    march->rework_slope += factors->slope * amount;
}

/** p2 of one cell, as its middle leaves; the march then is behind it. */
static inline belt_real_t carried_density(march_t *march, const factors_t *factors,
                                          belt_real_t density) {
    const belt_real_t amount =
        factors->middle * (density + march->rework) - HALF * factors->width * march->rework_slope;
    const belt_real_t survival = march->survival * factors->kept_half;
    march->survival = survival * factors->kept_half;
    carry_rework(march, factors, amount);
    return survival * amount;
}

/** Whole cells in pairs, uniform loss: the loop in which the step spends its time. `before` gets I at
 * the last pair's near line. Returns the ring index of the cell behind them. */
static uint32_t march_pairs(const setting_t *at, march_t *start, uint32_t cell, uint32_t pairs,
                            belt_real_t *before) {
    march_t march = *start;
    for (uint32_t i = 0; i < pairs; ++i) {
        const belt_real_t pace = pace_ahead(at, &march, BELT_REAL(2));
        const factors_t factors = factors_of(at->line, BELT_REAL(1), pace);
        *before = march.survival * march.rework;
        const belt_real_t *density = &at->observer->density[cell];
        const belt_real_t first = carried_density(&march, &factors, density[0]);
        const belt_real_t second = carried_density(&march, &factors, density[1]);
        const leaving_t leaving = {HALF * (first + second), BELT_REAL(0.125) * (first - second)};
        pass(at, &march, BELT_REAL(2), pace, leaving);
        cell = belt_observer_behind(at->line, cell, 2u);
    }
    *start = march;
    return cell;
}

static belt_passed_t passed_stretches(const belt_prediction_t *prediction, uint32_t count) {
    const belt_passed_t passed = {prediction->width, prediction->pace, prediction->outlet_density,
                                  count};
    return passed;
}

/** Any loss: survival and rework of the material at `place`, past all stretches before and then
 * `rest` spacings more at `pace`. */
static void forward(const setting_t *at, march_t *march, belt_real_t place, belt_real_t rest,
                    belt_real_t pace, belt_real_t density) {
    const belt_passed_t passed = passed_stretches(at->prediction, march->count);
    belt_transfer_t transfer = belt_fast_forward(at->line, &passed, place);
    const belt_real_t left = transfer.survival * density + transfer.rework;
    belt_fast_forward_last(&transfer, at->line, rest, pace, left);
    march->survival = transfer.survival;
    march->rework = transfer.rework / transfer.survival;
}

/** The pairs again, for any loss: the middle is moved past all before it, the two cells told apart
 * by the loss between them. `before` gets I at the last pair's middle. */
static uint32_t march_pairs_forward(const setting_t *at, march_t *march, uint32_t cell,
                                    uint32_t pairs, belt_real_t *before) {
    const belt_line_t *line = at->line;
    for (uint32_t i = 0; i < pairs; ++i) {
        const belt_real_t inner = at->observer->density[cell];
        const belt_real_t outer = at->observer->density[cell + 1u];
        const belt_real_t middle = march->place + BELT_REAL(1);
        const belt_real_t pace = pace_ahead(at, march, BELT_REAL(2));
        forward(at, march, middle, BELT_REAL(1), pace, HALF * (inner + outer));

        const belt_real_t loss = HALF * line->loss[(int32_t)middle] * pace;
        const belt_real_t more = BELT_REAL(1) + loss + HALF * loss * loss;
        const belt_real_t less = more - BELT_REAL(2) * loss;
        const belt_real_t first = march->survival * more * inner;
        const belt_real_t second = march->survival * less * outer;
        const leaving_t leaving = {HALF * (first + second) + march->survival * march->rework,
                                   BELT_REAL(0.125) * (first - second)};
        pass(at, march, BELT_REAL(2), pace, leaving);
        cell = belt_observer_behind(line, cell, 2u);
    }
    *before = march->survival * march->rework;
    return cell;
}

/** p2 of one cell in a stretch at an end of the belt, `ahead` spacings behind the stretch's start. */
static belt_real_t end_density(const setting_t *at, march_t *march, belt_real_t density,
                               belt_real_t ahead, belt_real_t width, belt_real_t pace) {
    if (at->line->loss_is_uniform) {
        const factors_t factors = factors_of(at->line, width, pace);
        return carried_density(march, &factors, density);
    }
    const belt_real_t rest = ahead + HALF * width;
    forward(at, march, march->place + rest, rest, pace, density);
    return march->survival * (density + march->rework);
}

/** p2 of what is left of the outlet cell: its centre has less than half a spacing to go, or none. */
static belt_real_t outlet_cell_density(const setting_t *at, march_t *march, belt_real_t width,
                                       belt_real_t pace) {
    const belt_real_t to_go = HALF - at->observer->gone;
    belt_real_t density = belt_observer_rest_of_outlet(at->observer);
    if (to_go > BELT_REAL(0)) {
        belt_transfer_t transfer = {BELT_REAL(1), BELT_REAL(0)};
        belt_fast_forward_last(&transfer, at->line, to_go, pace, density);
        density = transfer.survival * density + transfer.rework;
    }
    const factors_t factors = factors_of(at->line, width, pace);
    carry_rework(march, &factors, density / factors.kept_half);
    march->survival = factors.kept_half * factors.kept_half;
    return density;
}

/** Mean and lead of two cells behind each other. */
static leaving_t both(belt_real_t first, belt_real_t first_width, belt_real_t second,
                      belt_real_t second_width) {
    const belt_real_t share = second_width / (first_width + second_width);
    const leaving_t leaving = {
        first + share * (second - first),
        HALF * share * (BELT_REAL(1) - share) * (first - second),
    };
    return leaving;
}

/** Whether the outlet cell is the inlet-side one of its pair. */
static bool outlet_is_second(const belt_observer_t *observer) {
    return (observer->outlet & 1u) != 0u;
}

/** The outlet's end: the rest of the outlet cell, with the other one of its pair if that is still
 * on the belt. Returns the ring index of the cell behind. */
static uint32_t march_outlet(const setting_t *at, march_t *march) {
    const belt_observer_t *observer = at->observer;
    const belt_real_t width = BELT_REAL(1) - observer->gone;
    const uint32_t next = belt_observer_behind(at->line, observer->outlet, 1u);
    if (outlet_is_second(observer)) {
        const belt_real_t pace = pace_ahead(at, march, width);
        const leaving_t leaving = {outlet_cell_density(at, march, width, pace), BELT_REAL(0)};
        pass(at, march, width, pace, leaving);
        return next;
    }
    const belt_real_t pace = pace_ahead(at, march, width + BELT_REAL(1));
    const belt_real_t first = outlet_cell_density(at, march, width, pace);
    const belt_real_t second =
        end_density(at, march, observer->density[next], width, BELT_REAL(1), pace);
    pass(at, march, width + BELT_REAL(1), pace, both(first, width, second, BELT_REAL(1)));
    return belt_observer_behind(at->line, next, 1u);
}

/** The inlet's end: the open cell, with the whole one of its pair if there is one. */
static void march_inlet(const setting_t *at, march_t *march, uint32_t cell, bool is_pair) {
    const belt_observer_t *observer = at->observer;
    const belt_real_t gone = observer->gone;
    if (!is_pair) {
        const belt_real_t pace = pace_ahead(at, march, gone);
        const leaving_t leaving = {
            end_density(at, march, observer->density[cell], BELT_REAL(0), gone, pace),
            BELT_REAL(0)};
        pass(at, march, gone, pace, leaving);
        return;
    }
    const uint32_t open = belt_observer_behind(at->line, cell, 1u);
    const belt_real_t pace = pace_ahead(at, march, BELT_REAL(1) + gone);
    const belt_real_t first =
        end_density(at, march, observer->density[cell], BELT_REAL(0), BELT_REAL(1), pace);
    const belt_real_t second =
        end_density(at, march, observer->density[open], BELT_REAL(1), gone, pace);
    pass(at, march, BELT_REAL(1) + gone, pace, both(first, BELT_REAL(1), second, gone));
}

/** What (MF1) asks for at the inlet, out of the march's last line. `before` is I at the
 * last whole pair: for uniform loss where it begins, else in its middle. */
static void conclude(const setting_t *at, march_t *march, belt_real_t before) {
    const belt_line_t *line = at->line;
    belt_prediction_t *p = at->prediction;
    const uint32_t last = march->count - 1u;
    belt_real_t distance = BELT_REAL(2) + p->width[last];
    if (!line->loss_is_uniform) {
        const belt_passed_t passed = passed_stretches(p, last);
        belt_transfer_t transfer = belt_fast_forward(line, &passed, (belt_real_t)line->node_count);
        belt_fast_forward_last(&transfer, line, p->width[last], p->pace[last],
                               p->outlet_density[last]);
        march->survival = transfer.survival;
        march->rework = transfer.rework / transfer.survival;
        distance -= BELT_REAL(1);
    }
    const belt_real_t rework = march->survival * march->rework;
    p->count = march->count;
    p->inlet_level = march->level;
    p->inlet_arrival = march->arrival;
    p->inlet_slowness = march->pace / line->spacing;
    p->inlet_congestion = (p->inlet_slowness - line->slowness_empty) / line->slowness_slope;
    p->inlet_survival = march->survival;
    p->inlet_rework = rework;
    p->inlet_rework_slope = (rework - before) / distance;
    p->inlet_tail = march->tail;
}

static march_t start(const belt_line_t *line, const belt_present_t *present) {
    march_t march;
    march.level = present->level;
    march.arrival = BELT_REAL(0);
    march.pace = belt_line_slowness(line, present->congestion) * line->spacing;
    march.tail = present->level;
    march.place = BELT_REAL(0);
    march.survival = BELT_REAL(1);
    march.rework = BELT_REAL(0);
    march.rework_slope = BELT_REAL(0);
    march.count = 0;
    march.tail_line = 0;
    return march;
}

void belt_predictor_march(belt_prediction_t *prediction, const belt_line_t *line,
                          const belt_level_history_t *history, const belt_observer_t *observer,
                          const belt_present_t *present, belt_prediction_kind_t kind) {
    const belt_real_t pace_slope =
        (kind == BELT_HOLD_CONGESTION) ? BELT_REAL(0) : line->slowness_slope * line->spacing;
    const setting_t at = {
        line, history, observer, prediction, line->connectivity * line->spacing, pace_slope};
    march_t march = start(line, present);
    prediction->level[0] = march.level;
    prediction->arrival[0] = march.arrival;

    /* Of the cells 0 ... node_count the outlet's end takes one or two, the inlet's end the rest. */
    const uint32_t behind = line->node_count - (outlet_is_second(observer) ? 0u : 1u);
    const uint32_t pairs = (behind - 1u) / 2u;
    belt_real_t before = BELT_REAL(0);
    uint32_t cell = march_outlet(&at, &march);
    cell = line->loss_is_uniform ? march_pairs(&at, &march, cell, pairs, &before)
                                 : march_pairs_forward(&at, &march, cell, pairs, &before);
    march_inlet(&at, &march, cell, behind > 2u * pairs + 1u);
    conclude(&at, &march, before);
}
