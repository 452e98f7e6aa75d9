/* SPDX-License-Identifier: MIT */
/*
 * predictor.h - the march along the belt, from the outlet to the last part fed.
 *
 * At each place x it answers, for the moment at which the material now at x reaches the outlet: what
 * will the buffer hold (p1), which density will leave (p2), how congested will the line be (p3), and
 * when (sigma)? In the paper (MF3)-(MF7), (C1)-(C3), with the speed written as its inverse:
 *
 *     sigma_x = slowness(p3)
 *     p1_x    = alpha*p2 - service(p1)*slowness(p3)
 *     p3_x    = (p1 - level at sigma - speed_window)*slowness(p3)
 *     p2      = survival*density + rework picked up on the way
 *
 * Level, time and congestion take one midpoint step for a pair of cells, survival and rework one for
 * each cell: second order, also where the density jumps between them. Pairs are pairs of material, so
 * that the prediction changes smoothly while the belt moves on. The window of p3 slides out of the
 * recorded levels into the predicted ones once sigma - speed_window lies in the future.
 *
 * Cost: uniform loss about 85 instructions a cell, some 500 for the ends and the rest; a loss profile
 * adds some 25 for each two stretches (node_count^2/8 of them). Stack: about 250 bytes.
 */
#ifndef BELT_PREDICTOR_H
#define BELT_PREDICTOR_H

#include "fast_forward.h"
#include "level_history.h"
#include "observer.h"

/** Stretches that a march passes: cells in pairs, at each end a pair or one cell. */
#define BELT_STRETCH_CAPACITY (BELT_NODE_CAPACITY / 2 + 2)

/** What the march found. Line 0 is the outlet now, line i + 1 the inlet end of stretch i, the last
 * line the inlet. Times are from now. */
typedef struct {
    belt_real_t level[BELT_STRETCH_CAPACITY + 1];   /**< p1 at the lines [parts]. */
    belt_real_t arrival[BELT_STRETCH_CAPACITY + 1]; /**< sigma - t at the lines [s]. */
    belt_real_t width[BELT_STRETCH_CAPACITY];       /**< of each stretch, at most 2 [spacings]. */
    belt_real_t
        pace[BELT_STRETCH_CAPACITY]; /**< time for a spacing as each passes the outlet [s]. */
    belt_real_t outlet_density[BELT_STRETCH_CAPACITY]; /**< p2, its mean over each [parts/m]. */
    uint32_t count;                                    /**< stretches. */

    belt_real_t inlet_level;      /**< p1(D) [parts]. */
    belt_real_t inlet_arrival;    /**< sigma(D) - t: the dead time [s]. */
    belt_real_t inlet_slowness;   /**< P (1 + p3(D)) [s/m]. */
    belt_real_t inlet_congestion; /**< p3(D) [parts s]. */
    belt_real_t inlet_survival;   /**< K(D, D): share of what is fed now that will leave, (0, 1]. */
    belt_real_t inlet_rework;     /**< I(D): density it will have picked up by then [parts/m]. */
    belt_real_t inlet_rework_slope; /**< how much more of it a spacing further in [parts/m]. */
    belt_real_t inlet_tail;         /**< level that leaves the window when it arrives [parts]. */
} belt_prediction_t;

/** What the march starts from. */
typedef struct {
    belt_real_t level;      /**< Q(t) [parts]. */
    belt_real_t congestion; /**< R(t) [parts s]. */
} belt_present_t;

/** Marches. `kind` says whether the speed follows the predicted congestion. */
void belt_predictor_march(belt_prediction_t *prediction, const belt_line_t *line,
                          const belt_level_history_t *history, const belt_observer_t *observer,
                          const belt_present_t *present, belt_prediction_kind_t kind);

#endif
