/* SPDX-License-Identifier: MIT */
/*
 * prediction.h - what the march finds, and where it stands while it is on its way.
 */
#ifndef BELT_PREDICTION_H
#define BELT_PREDICTION_H

#include "carried_transfer.h"
#include "internal_model.h"

/** Stretches that a march passes: cells in pairs, at each end a pair or one cell. */
#define BELT_STRETCH_CAPACITY (BELT_NODE_CAPACITY / 2 + 2)
/** The same where the build has another line's laws; else one that nobody reads. */
#define BELT_RETURNED_TABLE (BELT_LINE_HAS_LAWS * (BELT_STRETCH_CAPACITY - 1) + 1)

/** Where the march stands: at a line between two stretches of belt, in the end at the inlet. Times are
 * from now. */
typedef struct {
    belt_real_t level;      /**< p1 [parts]. */
    belt_real_t arrival;    /**< sigma - t; at the inlet the dead time [s]. */
    belt_real_t congestion; /**< p3 [parts s]. */
    belt_real_t pace;       /**< time a spacing takes at p3 [s]. */
    belt_real_t tail;       /**< level that left the window in the last stretch's middle [parts]. */
    belt_real_t rise;       /**< of the level in the last stretch, for each spacing [parts]. */
    belt_carried_t carried; /**< K, I/K: on a plain line at the line, else at the last middle. */
    belt_real_t rework_before; /**< I in the middle of the last pair of whole cells [parts/m]. */
    uint32_t count;            /**< stretches passed. */
} belt_front_t;

/** What the march found. Line 0 is the outlet now, line i + 1 the inlet end of stretch i, the last
 * line the inlet. */
typedef struct {
    belt_real_t level[BELT_STRETCH_CAPACITY + 1];   /**< p1 at the lines [parts]. */
    belt_real_t arrival[BELT_STRETCH_CAPACITY + 1]; /**< sigma - t at the lines [s]. */
    belt_real_t width[BELT_STRETCH_CAPACITY];       /**< of each stretch, at most 2 [spacings]. */
    belt_real_t pace[BELT_STRETCH_CAPACITY];        /**< time each takes for a spacing [s]. */
    belt_real_t outlet_density[BELT_STRETCH_CAPACITY]; /**< p2, its mean over each [parts/m]. */
    belt_real_t returned[BELT_RETURNED_TABLE]; /**< what of it is put back, its mean, where a build
                                                    has another line's laws [parts/m]. */
    belt_real_t present_tail;                  /**< level that leaves the window now [parts]. */
    belt_real_t place;  /**< of that line now, but on a plain line [spacings from the outlet]. */
    uint32_t tail_line; /**< the line at or before the window's end, once that is predicted. */
    belt_front_t inlet; /**< where the march stands, in the end the inlet. */

    belt_real_t inlet_survival; /**< K(D, D): share of what is fed now that will be left, > 0. */
    belt_real_t inlet_rework;   /**< I(D): density it will have picked up by then [parts/m]. */
    belt_real_t inlet_rework_slope; /**< how much more of it a spacing further in [parts/m]. */
} belt_prediction_t;

#endif
