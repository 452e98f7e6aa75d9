/* SPDX-License-Identifier: MIT */
#include "fast_forward.h"

/** Loss and rework on one way: loss exponent, rework rate in its middle, density returned, time. */
static inline void move_on(belt_transfer_t *transfer, belt_real_t loss, belt_real_t rework_rate,
                           belt_real_t returned, belt_real_t time) {
    const belt_real_t kept = belt_line_survival(loss);
    const belt_real_t kept_halfway = BELT_REAL(1) - BELT_HALF * loss;
    transfer->survival *= kept;
    transfer->rework = transfer->rework * kept + rework_rate * returned * time * kept_halfway;
}

belt_transfer_t belt_fast_forward(const belt_line_t *line, const belt_passed_t *passed,
                                  belt_real_t place) {
    belt_transfer_t transfer = {BELT_REAL(1), BELT_REAL(0)};
    belt_real_t from = place;
    belt_real_t from_sum = belt_line_loss_sum(line, from);
    for (uint32_t i = 0; i < passed->count; ++i) {
        const belt_real_t width = passed->width[i];
        const belt_real_t pace = passed->pace[i];
        const belt_real_t to = from - width;
        const belt_real_t to_sum = belt_line_loss_sum(line, to);
        move_on(&transfer, (from_sum - to_sum) * pace,
                belt_line_rework(line, BELT_HALF * (from + to)), passed->returned[i], width * pace);
        from = to;
        from_sum = to_sum;
    }
    return transfer;
}

void belt_fast_forward_last(belt_transfer_t *transfer, const belt_line_t *line, belt_real_t place,
                            belt_real_t pace, belt_real_t returned) {
    move_on(transfer, belt_line_loss_sum(line, place) * pace,
            belt_line_rework(line, BELT_HALF * place), returned, place * pace);
}
