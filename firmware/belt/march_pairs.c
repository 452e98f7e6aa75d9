/* SPDX-License-Identifier: MIT */
#include "march_pairs.h"

#include "march_step.h"

uint32_t belt_march_plain_pairs(belt_prediction_t *prediction, const belt_model_t *model,
                                uint32_t cell, uint32_t pairs) {
    belt_front_t front = prediction->inlet;
    for (uint32_t i = 0; i < pairs; ++i) {
        const belt_real_t tail =
            belt_march_level_leaving(prediction, model, &front, front.arrival + front.pace);
        const belt_real_t early = belt_march_seen_once(&front, tail);
        const belt_real_t pace = belt_march_pace_ahead(&model->line, &front, BELT_REAL(2), early);
        const belt_cell_factors_t factors = belt_carried_factors(&model->line, BELT_REAL(1), pace);
        const belt_real_t *density = &model->observer.density[cell];
        const belt_real_t first = belt_carried_density(&front.carried, &factors, density[0]);
        front.rework_before = front.carried.survival * front.carried.rework;
        const belt_real_t second = belt_carried_density(&front.carried, &factors, density[1]);
        const belt_leaving_t leaving = {BELT_HALF * (first + second),
                                        BELT_REAL(1.0 / 6.0) * (first - second)};
        belt_march_pass(prediction, model, &front, BELT_REAL(2), pace, leaving);
        cell = belt_observer_behind(&model->line, cell, 2u);
    }
    prediction->inlet = front;
    return cell;
}
