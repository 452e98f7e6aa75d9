/* SPDX-License-Identifier: MIT */
/*
 * carried_transfer.h - survival and rework where the loss is uniform (MF4, MF7).
 *
 * All material then ages alike, and both are carried along the march with a few operations a cell
 * (fast_forward.h does it for any loss). With the rework as a density that could have been fed instead,
 * p2 = survival*amount, where amount = density + rework, and the loss divides out of the rest:
 *
 *     survival'     = -C*survival                              (' = d/dtime)
 *     rework'       = A*D*amount - rework_slope per spacing
 *     rework_slope' = A*spacing*amount
 */
#ifndef BELT_CARRIED_TRANSFER_H
#define BELT_CARRIED_TRANSFER_H

#include "line_model.h"

/** Survival and rework of the material at a line of the march. */
typedef struct {
    belt_real_t survival;     /**< K [-]. */
    belt_real_t rework;       /**< I/K: what could have been fed instead [parts/m]. */
    belt_real_t rework_slope; /**< how much less of that a spacing further in [parts/m]. */
} belt_carried_t;

/** One cell's factors, the same for all cells of one width and pace. */
typedef struct {
    belt_real_t kept_half; /**< what survives half the cell. */
    belt_real_t width;     /**< [spacings]. */
    belt_real_t middle; /**< amount in the middle per amount at the near line, but for the slope. */
    belt_real_t rework; /**< rework gained in the cell per amount. */
    belt_real_t slope;  /**< slope gained in it per amount. */
} belt_cell_factors_t;

/** For a cell `width` spacings wide that passes the outlet at `pace` seconds a spacing. */
static inline belt_cell_factors_t belt_carried_factors(const belt_line_t *line, belt_real_t width,
                                                       belt_real_t pace) {
    const belt_real_t dwell = width * pace;
    const belt_real_t half_rework = BELT_HALF * line->rework_at_outlet * dwell;
    belt_cell_factors_t factors;
    factors.kept_half = belt_line_survival(BELT_HALF * line->loss_mean * dwell);
    factors.width = width;
    factors.slope = line->rework_per_spacing * dwell;
    /* Half a cell: rework by what enters it and by what that makes, less by the slope it makes. */
    factors.middle = BELT_REAL(1) + half_rework * (BELT_REAL(1) + half_rework) -
                     BELT_REAL(0.125) * width * factors.slope;
    factors.rework = BELT_REAL(2) * half_rework - BELT_HALF * width * factors.slope;
    return factors;
}

/** Behind a cell that left with `amount`. */
static inline void belt_carried_pass_rework(belt_carried_t *carried,
                                            const belt_cell_factors_t *factors,
                                            belt_real_t amount) {
    carried->rework += factors->rework * amount - factors->width * carried->rework_slope;
    carried->rework_slope += factors->slope * amount;
}

/** p2 of one cell, as its middle leaves; the carried values then are behind it. */
static inline belt_real_t belt_carried_density(belt_carried_t *carried,
                                               const belt_cell_factors_t *factors,
                                               belt_real_t density) {
    const belt_real_t amount = factors->middle * (density + carried->rework) -
                               BELT_HALF * factors->width * carried->rework_slope;
    const belt_real_t survival = carried->survival * factors->kept_half;
    carried->survival = survival * factors->kept_half;
    belt_carried_pass_rework(carried, factors, amount);
    return survival * amount;
}

#endif
