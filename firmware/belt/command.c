/* SPDX-License-Identifier: MIT */
#include "command.h"

belt_real_t belt_command_limit(belt_real_t flux, belt_real_t limit) {
    return belt_within(BELT_REAL(0), flux, limit);
}

belt_real_t belt_command_solve(const belt_prediction_t *prediction, const belt_model_t *model,
                               const belt_nominal_law_t *law) {
    const belt_line_t *line = &model->line;
    const belt_present_t *present = &model->present;
    const belt_front_t *inlet = &prediction->inlet;
    /* Feeding: the middle of the hold. */
    const belt_real_t half_hold = BELT_HALF * model->history.period;
    const belt_real_t feeding = belt_line_slowness(
        line, present->congestion + half_hold * (present->level - prediction->present_tail));

    /* Arrival: half a hold of travel behind the last material fed, at the pace of then. */
    const belt_real_t travel = half_hold / belt_line_slowness(line, present->congestion);
    const belt_real_t gap = travel * belt_line_slowness(line, inlet->congestion);
    const belt_real_t inflow =
        line->connectivity * belt_command_wanted(law, present, inlet->level) + present->disturbance;
    const belt_real_t level = inlet->level + gap * (inflow - belt_line_service(line, inlet->level));
    const belt_real_t arriving =
        belt_line_slowness(line, inlet->congestion + gap * (inlet->level - inlet->tail));
    const belt_real_t survival =
        prediction->inlet_survival * (BELT_REAL(1) - line->loss_mean * (gap - half_hold));

    const belt_real_t rework =
        prediction->inlet_rework + travel / line->spacing * prediction->inlet_rework_slope;

    const belt_real_t wanted = arriving * belt_command_wanted(law, present, level);
    return (wanted - rework) / (survival * feeding);
}
