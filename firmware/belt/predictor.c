/* SPDX-License-Identifier: MIT */
#include "predictor.h"

#include "fast_forward.h"

/** Whole cells in pairs, uniform loss: the loop in which the step spends its time. `before` gets I at
 * the last pair's near line. Returns the ring index of the cell behind them. */
static uint32_t march_pairs(const belt_march_setting_t *at, belt_march_t *start, uint32_t cell,
                            uint32_t pairs, belt_real_t *before) {
    belt_march_t march = *start;
    for (uint32_t i = 0; i < pairs; ++i) {
        const belt_real_t pace = belt_march_pace_ahead(at, &march, BELT_REAL(2));
        const belt_cell_factors_t factors = belt_carried_factors(at->line, BELT_REAL(1), pace);
        *before = march.carried.survival * march.carried.rework;
        const belt_real_t *density = &at->observer->density[cell];
        const belt_real_t first = belt_carried_density(&march.carried, &factors, density[0]);
        const belt_real_t second = belt_carried_density(&march.carried, &factors, density[1]);
        const belt_leaving_t leaving = {BELT_HALF * (first + second),
                                        BELT_REAL(0.125) * (first - second)};
        belt_march_pass(at, &march, BELT_REAL(2), pace, leaving);
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
static void forward(const belt_march_setting_t *at, belt_march_t *march, belt_real_t place,
                    belt_real_t rest, belt_real_t pace, belt_real_t density) {
    const belt_passed_t passed = passed_stretches(at->prediction, march->count);
    belt_transfer_t transfer = belt_fast_forward(at->line, &passed, place);
    const belt_real_t left = transfer.survival * density + transfer.rework;
    belt_fast_forward_last(&transfer, at->line, rest, pace, left);
    march->carried.survival = transfer.survival;
    march->carried.rework = transfer.rework / transfer.survival;
}

/** The pairs again, for any loss: the middle is moved past all before it, the two cells told apart
 * by the loss between them. `before` gets I at the last pair's middle. */
static uint32_t march_pairs_forward(const belt_march_setting_t *at, belt_march_t *march,
                                    uint32_t cell, uint32_t pairs, belt_real_t *before) {
    const belt_line_t *line = at->line;
    for (uint32_t i = 0; i < pairs; ++i) {
        const belt_real_t inner = at->observer->density[cell];
        const belt_real_t outer = at->observer->density[cell + 1u];
        const belt_real_t middle = march->place + BELT_REAL(1);
        const belt_real_t pace = belt_march_pace_ahead(at, march, BELT_REAL(2));
        forward(at, march, middle, BELT_REAL(1), pace, BELT_HALF * (inner + outer));

        const belt_real_t loss = BELT_HALF * line->loss[(int32_t)middle] * pace;
        const belt_real_t more = BELT_REAL(1) + loss + BELT_HALF * loss * loss;
        const belt_real_t less = more - BELT_REAL(2) * loss;
        const belt_real_t first = march->carried.survival * more * inner;
        const belt_real_t second = march->carried.survival * less * outer;
        const belt_leaving_t leaving = {BELT_HALF * (first + second) +
                                            march->carried.survival * march->carried.rework,
                                        BELT_REAL(0.125) * (first - second)};
        belt_march_pass(at, march, BELT_REAL(2), pace, leaving);
        cell = belt_observer_behind(line, cell, 2u);
    }
    *before = march->carried.survival * march->carried.rework;
    return cell;
}

/** p2 of one cell in a stretch at an end of the belt, `ahead` spacings behind the stretch's start. */
static belt_real_t end_density(const belt_march_setting_t *at, belt_march_t *march,
                               belt_real_t density, belt_real_t ahead, belt_real_t width,
                               belt_real_t pace) {
    if (at->line->loss_is_uniform) {
        const belt_cell_factors_t factors = belt_carried_factors(at->line, width, pace);
        return belt_carried_density(&march->carried, &factors, density);
    }
    const belt_real_t rest = ahead + BELT_HALF * width;
    forward(at, march, march->place + rest, rest, pace, density);
    return march->carried.survival * (density + march->carried.rework);
}

/** p2 of what is left of the outlet cell: its centre has less than half a spacing to go, or none. */
static belt_real_t outlet_cell_density(const belt_march_setting_t *at, belt_march_t *march,
                                       belt_real_t width, belt_real_t pace) {
    const belt_real_t to_go = BELT_HALF - at->observer->gone;
    belt_real_t density = belt_observer_rest_of_outlet(at->observer);
    if (to_go > BELT_REAL(0)) {
        belt_transfer_t transfer = {BELT_REAL(1), BELT_REAL(0)};
        belt_fast_forward_last(&transfer, at->line, to_go, pace, density);
        density = transfer.survival * density + transfer.rework;
    }
    const belt_cell_factors_t factors = belt_carried_factors(at->line, width, pace);
    belt_carried_pass_rework(&march->carried, &factors, density / factors.kept_half);
    march->carried.survival = factors.kept_half * factors.kept_half;
    return density;
}

/** Mean and lead of two cells behind each other. */
static belt_leaving_t both(belt_real_t first, belt_real_t first_width, belt_real_t second,
                           belt_real_t second_width) {
    const belt_real_t share = second_width / (first_width + second_width);
    const belt_leaving_t leaving = {
        first + share * (second - first),
        BELT_HALF * share * (BELT_REAL(1) - share) * (first - second),
    };
    return leaving;
}

/** Whether the outlet cell is the inlet-side one of its pair. */
static bool outlet_is_second(const belt_observer_t *observer) {
    return (observer->outlet & 1u) != 0u;
}

/** The outlet's end: the rest of the outlet cell, with the other one of its pair if that is still
 * on the belt. Returns the ring index of the cell behind. */
static uint32_t march_outlet(const belt_march_setting_t *at, belt_march_t *march) {
    const belt_observer_t *observer = at->observer;
    const belt_real_t width = BELT_REAL(1) - observer->gone;
    const uint32_t next = belt_observer_behind(at->line, observer->outlet, 1u);
    if (outlet_is_second(observer)) {
        const belt_real_t pace = belt_march_pace_ahead(at, march, width);
        const belt_leaving_t leaving = {outlet_cell_density(at, march, width, pace), BELT_REAL(0)};
        belt_march_pass(at, march, width, pace, leaving);
        return next;
    }
    const belt_real_t pace = belt_march_pace_ahead(at, march, width + BELT_REAL(1));
    const belt_real_t first = outlet_cell_density(at, march, width, pace);
    const belt_real_t second =
        end_density(at, march, observer->density[next], width, BELT_REAL(1), pace);
    belt_march_pass(at, march, width + BELT_REAL(1), pace,
                    both(first, width, second, BELT_REAL(1)));
    return belt_observer_behind(at->line, next, 1u);
}

/** The inlet's end: the open cell, with the whole one of its pair if there is one. */
static void march_inlet(const belt_march_setting_t *at, belt_march_t *march, uint32_t cell,
                        bool is_pair) {
    const belt_observer_t *observer = at->observer;
    const belt_real_t gone = observer->gone;
    if (!is_pair) {
        const belt_real_t pace = belt_march_pace_ahead(at, march, gone);
        const belt_leaving_t leaving = {
            end_density(at, march, observer->density[cell], BELT_REAL(0), gone, pace),
            BELT_REAL(0)};
        belt_march_pass(at, march, gone, pace, leaving);
        return;
    }
    const uint32_t open = belt_observer_behind(at->line, cell, 1u);
    const belt_real_t pace = belt_march_pace_ahead(at, march, BELT_REAL(1) + gone);
    const belt_real_t first =
        end_density(at, march, observer->density[cell], BELT_REAL(0), BELT_REAL(1), pace);
    const belt_real_t second =
        end_density(at, march, observer->density[open], BELT_REAL(1), gone, pace);
    belt_march_pass(at, march, BELT_REAL(1) + gone, pace, both(first, BELT_REAL(1), second, gone));
}

/** What (MF1) asks for at the inlet, out of the march's last line. `before` is I at the
 * last whole pair: for uniform loss where it begins, else in its middle. */
static void conclude(const belt_march_setting_t *at, belt_march_t *march, belt_real_t before) {
    const belt_line_t *line = at->line;
    belt_prediction_t *p = at->prediction;
    const uint32_t last = march->count - 1u;
    belt_real_t distance = BELT_REAL(2) + p->width[last];
    if (!line->loss_is_uniform) {
        const belt_passed_t passed = passed_stretches(p, last);
        belt_transfer_t transfer = belt_fast_forward(line, &passed, (belt_real_t)line->node_count);
        belt_fast_forward_last(&transfer, line, p->width[last], p->pace[last],
                               p->outlet_density[last]);
        march->carried.survival = transfer.survival;
        march->carried.rework = transfer.rework / transfer.survival;
        distance -= BELT_REAL(1);
    }
    const belt_real_t rework = march->carried.survival * march->carried.rework;
    p->count = march->count;
    p->inlet_level = march->level;
    p->inlet_arrival = march->arrival;
    p->inlet_slowness = march->pace / line->spacing;
    p->inlet_congestion = (p->inlet_slowness - line->slowness_empty) / line->slowness_slope;
    p->inlet_survival = march->carried.survival;
    p->inlet_rework = rework;
    p->inlet_rework_slope = (rework - before) / distance;
    p->inlet_tail = march->tail;
}

static belt_march_t start(const belt_line_t *line, const belt_present_t *present) {
    belt_march_t march;
    march.level = present->level;
    march.arrival = BELT_REAL(0);
    march.pace = belt_line_slowness(line, present->congestion) * line->spacing;
    march.tail = present->level;
    march.place = BELT_REAL(0);
    march.carried.survival = BELT_REAL(1);
    march.carried.rework = BELT_REAL(0);
    march.carried.rework_slope = BELT_REAL(0);
    march.count = 0;
    march.tail_line = 0;
    return march;
}

void belt_predictor_march(belt_prediction_t *prediction, const belt_line_t *line,
                          const belt_level_history_t *history, const belt_observer_t *observer,
                          const belt_present_t *present, belt_prediction_kind_t kind) {
    const belt_real_t pace_slope =
        (kind == BELT_HOLD_CONGESTION) ? BELT_REAL(0) : line->slowness_slope * line->spacing;
    const belt_march_setting_t at = {line,
                                     history,
                                     observer,
                                     prediction,
                                     line->connectivity * line->spacing,
                                     pace_slope,
                                     present->disturbance};
    belt_march_t march = start(line, present);
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
