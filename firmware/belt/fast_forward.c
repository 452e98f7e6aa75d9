/* SPDX-License-Identifier: MIT */
#include "fast_forward.h"

/** Loss and rework on a way of `width` spacings that ends at `to`: loss exponent, density returned, time.
 * Of the rework on the way there stays (1 - exp(-loss))/loss; more of what comes late does, so its rate
 * is taken a little nearer to the way's end than to its middle. */
static inline void move_on(belt_transfer_t *transfer, const belt_line_t *line, belt_real_t to,
                           belt_real_t width, belt_real_t loss, belt_real_t returned,
                           belt_real_t time) {
    const belt_real_t third = BELT_REAL(1.0 / 3.0);
    const belt_real_t twelfth = BELT_REAL(1.0 / 12.0);
    const belt_real_t staying =
        BELT_REAL(1) -
        BELT_HALF * loss * (BELT_REAL(1) - third * loss * (BELT_REAL(1) - BELT_REAL(0.25) * loss));
    const belt_real_t kept = BELT_REAL(1) - loss * staying;
    const belt_real_t rate = belt_line_rework(line, to + width * (BELT_HALF - twelfth * loss));
    transfer->survival *= kept;
    transfer->rework = transfer->rework * kept + rate * returned * time * staying;
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
        move_on(&transfer, line, to, width, (from_sum - to_sum) * pace, passed->returned[i],
                width * pace);
        from = to;
        from_sum = to_sum;
    }
    return transfer;
}

void belt_fast_forward_last(belt_transfer_t *transfer, const belt_line_t *line, belt_real_t place,
                            belt_real_t pace, belt_real_t returned) {
    move_on(transfer, line, BELT_REAL(0), place, belt_line_loss_sum(line, place) * pace, returned,
            place * pace);
}
