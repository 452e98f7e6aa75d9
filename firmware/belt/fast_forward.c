/* SPDX-License-Identifier: MIT */
#include "fast_forward.h"

#define HALF BELT_REAL(0.5)

/** Loss and rework on one stretch: loss exponent, middle of the stretch, density leaving, time. */
static void move_on(belt_transfer_t *transfer, belt_real_t loss, belt_real_t rework_rate,
                    belt_real_t left, belt_real_t dwell) {
    const belt_real_t kept = belt_line_survival(loss);
    const belt_real_t kept_halfway = BELT_REAL(1) - HALF * loss;
    transfer->survival *= kept;
    transfer->rework = transfer->rework * kept + rework_rate * left * dwell * kept_halfway;
}

static uint16_t node_below(const belt_line_t *line, belt_real_t place) {
    const uint16_t node = (uint16_t)place;
    return (node < line->node_count) ? node : (uint16_t)(line->node_count - 1);
}

/** Mean loss rate on the way from `place` down by `width` <= 1 spacings. */
static belt_real_t mean_loss(const belt_line_t *line, belt_real_t place, belt_real_t width) {
    const uint16_t node = node_below(line, place);
    const belt_real_t beyond = place - (belt_real_t)node;
    if ((beyond >= width) || (node == 0)) {
        return line->loss[node];
    }
    return line->loss[node - 1] + beyond / width * (line->loss[node] - line->loss[node - 1]);
}

belt_transfer_t belt_fast_forward(const belt_line_t *line, const belt_passed_t *passed,
                                  belt_real_t place) {
    belt_transfer_t transfer = {BELT_REAL(1), BELT_REAL(0)};
    const belt_real_t width = passed->first_width;
    move_on(&transfer, mean_loss(line, place, width) * passed->dwell[0],
            belt_line_rework(line, place - HALF * width), passed->outlet_density[0],
            passed->dwell[0]);

    /* Whole cells now: each moves the material by one spacing, so that its share in the upper of
     * the two spacings it crosses stays the same. */
    const belt_real_t start = place - width;
    uint16_t node = node_below(line, start);
    const belt_real_t beyond = start - (belt_real_t)node;
    belt_real_t rework_rate = belt_line_rework(line, start - HALF);
    for (uint16_t i = 1; (i < passed->count) && (node > 0); ++i, --node) {
        const belt_real_t below = line->loss[node - 1];
        const belt_real_t rate = below + beyond * (line->loss[node] - below);
        move_on(&transfer, rate * passed->dwell[i], rework_rate, passed->outlet_density[i],
                passed->dwell[i]);
        rework_rate += line->rework_per_spacing;
    }
    return transfer;
}

void belt_fast_forward_last(belt_transfer_t *transfer, const belt_line_t *line, belt_real_t place,
                            belt_real_t dwell, belt_real_t left) {
    move_on(transfer, line->loss[0] * dwell, belt_line_rework(line, HALF * place), left, dwell);
}
