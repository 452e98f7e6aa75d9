/* SPDX-License-Identifier: MIT */
#include "march_step.h"

belt_real_t belt_march_tail_at(belt_prediction_t *prediction, const belt_model_t *model,
                               belt_real_t later) {
    const belt_front_t *front = &prediction->inlet;
    return belt_march_level_leaving(prediction, model, front, front->arrival + later);
}
