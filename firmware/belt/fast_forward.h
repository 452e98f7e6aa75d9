/* SPDX-License-Identifier: MIT */
/*
 * fast_forward.h - loss and rework on the way of one piece of material to the outlet, for a belt
 * whose loss differs from place to place (MF4, MF7).
 *
 * Where the loss is uniform all material ages alike, and the march carries survival and rework along
 * with a few operations a stretch. Here each piece is moved past every stretch that leaves before it:
 * about 25 instructions for each two stretches, node_count^2/8 of those a march.
 */
#ifndef BELT_FAST_FORWARD_H
#define BELT_FAST_FORWARD_H

#include "line_model.h"

/** How a density at some place turns into one at the outlet: survival*density + rework. */
typedef struct {
    belt_real_t survival; /**< K: share that is left, > 0; above 1 of what has grown. */
    belt_real_t rework;   /**< I: density picked up on the way [parts/m]. */
} belt_transfer_t;

/** The stretches of belt that the march has passed already, from the outlet on. */
typedef struct {
    const belt_real_t *width;    /**< of each, at most 2 [spacings]. */
    const belt_real_t *pace;     /**< time each takes for one spacing [s]. */
    const belt_real_t *returned; /**< density put back while each left [parts/m]. */
    uint32_t count;              /**< how many. */
} belt_passed_t;

/** Moves material from `place` [spacings from the outlet] on while all of `passed` leaves. */
belt_transfer_t belt_fast_forward(const belt_line_t *line, const belt_passed_t *passed,
                                  belt_real_t place);

/** Adds the last way, from `place` <= 2 spacings to the outlet at `pace`, while `returned` is
 * put back. */
void belt_fast_forward_last(belt_transfer_t *transfer, const belt_line_t *line, belt_real_t place,
                            belt_real_t pace, belt_real_t returned);

#endif
