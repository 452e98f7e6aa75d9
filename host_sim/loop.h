/* SPDX-License-Identifier: MIT */
/*
 * loop.h - the controller and the plant in one closed loop.
 *
 * loop.c is the only file that sees both sides. It hands every period's row to a sink, and knows
 * nothing of files.
 */
#ifndef HOST_SIM_LOOP_H
#define HOST_SIM_LOOP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "scenario.h"

/** One row of the trace: the plant at the start of a period, before the step, and the step's answer.
 * A period without a step keeps the last answer. */
typedef struct {
    double time;            /**< [s]. */
    double buffer_level;    /**< plant's Q [parts]. */
    double level_setpoint;  /**< Q* in force in this period [parts]. */
    double inlet_flux;      /**< the command, held from this instant on [parts/s]. */
    double outlet_flux;     /**< plant's phi [parts/s]. */
    double congestion;      /**< plant's R [parts s]. */
    double transport_speed; /**< plant's omega(R) [m/s]. */
    double predicted_level; /**< p1(D): controller's, for material fed at `time` [parts]. */
    double arrival_time;    /**< sigma(D): when that material leaves the belt, absolute [s]. */
    double survival;        /**< K(D, D): its share that is not lost on the way, (0, 1]. */
    double level_measured;  /**< what the sensor delivered, any number; NaN: nothing [parts]. */
    double applied_flux;    /**< plant's, in the period before [parts/s]. */
    double disturbance;     /**< controller's estimate of a flow into the buffer [parts/s]. */
    double mode;            /**< of modes.h, as a number. */
    double error_bits;      /**< of measurement.h, as a number. */
    double level_estimate;  /**< the level that the law works with [parts]. */
    double level_quality;   /**< share of good samples of the level, [0, 1]. */
    double observer_error; /**< greatest difference between the controller's density and the plant's
                                 at node_count + 1 equally spaced places [parts/m]. */
} loop_row_t;

/** Receives rows in order of time; `density` holds `density_count` plant densities equally spaced
 * from outlet to inlet [parts/m]. Returning false ends the run (a full disk, an interrupt). */
typedef struct {
    void *context;
    bool wants_density;  /**< false: what `take` gets as densities is 0. */
    bool wants_observer; /**< false: observer_error is 0. */
    bool (*take)(void *context, const loop_row_t *row, const double *density, size_t density_count);
} loop_sink_t;

typedef struct {
    double spilled;       /**< parts lost because the buffer was full. */
    double balance_error; /**< parts in minus all that became of them [parts]. */
    size_t steps;         /**< control steps made. */
    double disturbed;     /**< parts that came into the buffer from elsewhere. */
} loop_totals_t;

typedef enum {
    LOOP_DONE,
    LOOP_CONFIG_REFUSED, /**< a rule of the controller or plant is broken: one line per rule on `messages`. */
    LOOP_STOPPED,    /**< the sink returned false. */
    LOOP_SELF_CHECK, /**< the plant or the controller left its own limits: said on `messages`. */
    LOOP_NO_MEMORY
} loop_status_t;

/** Runs the scenario: round(duration/period) + 1 rows. Messages are whole lines. */
loop_status_t loop_run(const scenario_t *scenario, const loop_sink_t *sink, FILE *messages,
                       loop_totals_t *totals);

#endif
