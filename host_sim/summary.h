/* SPDX-License-Identifier: MIT */
/*
 * summary.h - a run in a handful of figures.
 *
 * All are figures of the rows: what holds between two rows is taken as linear, and a set-point as
 * held from its row to the next.
 */
#ifndef HOST_SIM_SUMMARY_H
#define HOST_SIM_SUMMARY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "loop.h"

/** Half the width of the band in which a level counts as settled, as a share of the set-point. */
#define SUMMARY_BAND 0.02

/** Modes of the controller, by their numbers. */
#define SUMMARY_MODES 5

typedef struct {
    bool is_settled;        /**< the last row's level is within the band. */
    double settling_time;   /**< from the last set-point change (else the start) to the first row
                                    from which on the level stays within the band [s]. */
    double overshoot;       /**< greatest way beyond the set-point since its last change, seen from
                                    the level at that change, as a share of the set-point; 0: none;
                                    NaN where the set-point is 0. */
    double iae;             /**< integral of |Q - Q*| over the run, by trapezoids [parts s]. */
    double inlet_flux_peak; /**< greatest command [parts/s]. */
    double inlet_flux_variation; /**< sum of the command's changes, each without sign [parts/s]. */
    double final_error;          /**< Q - Q* in the last row [parts]. */
    double level_peak;           /**< greatest Q [parts]. */
    uint32_t error_bits;         /**< all that any step said. */
    size_t mode_rows[SUMMARY_MODES]; /**< rows in each mode. */
    size_t row_count;

    double change_time;  /**< of the row with the last change of the set-point. */
    double change_level; /**< level in that row: tells which side is beyond. */
    double settled_from; /**< time of the row at which the level last came into the band. */
    loop_row_t last;
} summary_t;

/** Before the first row. */
void summary_begin(summary_t *summary);

/** The next row. */
void summary_take(summary_t *summary, const loop_row_t *row);

/** Writes the figures as one JSON object, a key a line; what has no value is null. Returns false
 * when writing failed, errno says why. */
bool summary_write(const summary_t *summary, const loop_totals_t *totals, FILE *file);

#endif
