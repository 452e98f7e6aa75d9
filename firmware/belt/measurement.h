/* SPDX-License-Identifier: MIT */
/*
 * measurement.h - the gate: what of this period's inputs is trusted.
 *
 * Any bits may come in on any input. What passes the gate is finite and within its range, so no
 * stage behind it need ask again. The gate also keeps count of how the level has fared: trusted,
 * doubted (not good now, or not good for long enough again) or lost.
 */
#ifndef BELT_MEASUREMENT_H
#define BELT_MEASUREMENT_H

#include "limits.h"
#include "line_model.h"

/* Which fields of a measurement are present; a field that is not is not read. Without SAMPLE_COUNT
 * every level is a new sample, without ELAPSED_TICKS every step is on time. */
#define BELT_HAS_LEVEL 1u
#define BELT_HAS_OUTLET_FLUX 2u
#define BELT_HAS_APPLIED_FLUX 4u
#define BELT_HAS_DENSITY 8u
#define BELT_HAS_SAMPLE_COUNT 16u
#define BELT_HAS_ELAPSED_TICKS 32u

/* What was wrong in this step, and what stands in for it; bits add up. A value is senseless beyond the
 * bounds of belt_line_t.
 *   LEVEL_MISSING         there is none though one is due; the estimate, without estimator the last good one
 *   LEVEL_INVALID         NaN, or outside the buffer by more than BELT_LEVEL_MARGIN; the same
 *   LEVEL_RANGE           outside [0, level_capacity] by less; the nearer end
 *   LEVEL_STALE           no new sample although one was due; the same as missing
 *   LEVEL_STEP            further than level_step_max from the last good one; the same as missing,
 *                         until recovery_samples such samples in a row agree
 *   OUTLET_FLUX_INVALID   no number, negative or senseless; the observer's
 *   APPLIED_FLUX_INVALID  no number, negative or senseless; the last command
 *   DENSITY_INVALID       no profile, or a value in it no number or senseless; the observer's profile
 *   DENSITY_RANGE         a density below 0; the observer's profile
 *   PERIODS_LATE          2 ... BELT_CATCH_UP_PERIODS periods have passed: all are made up for
 *   PERIODS_LOST          more: so many are made up for, and the level is doubted
 *   PERIOD_REPEATED       none has passed since the last step: nothing is read, nothing moves
 *   FLUX_MISMATCH         for BELT_MISMATCH_PERIODS the flux applied was not the one commanded, by
 *                         more than 5 % of nominal_flux_max
 *   DISTURBANCE_LIMIT     the estimated disturbance is at its limit: the line is not the model
 *   HISTORY_SHORT         after a long stop: the levels of the last speed_window are not all known */
#define BELT_ERROR_LEVEL_MISSING 0x1u
#define BELT_ERROR_LEVEL_INVALID 0x2u
#define BELT_ERROR_LEVEL_RANGE 0x4u
#define BELT_ERROR_OUTLET_FLUX_INVALID 0x8u
#define BELT_ERROR_APPLIED_FLUX_INVALID 0x10u
#define BELT_ERROR_DENSITY_INVALID 0x20u
#define BELT_ERROR_DENSITY_RANGE 0x40u
#define BELT_ERROR_LEVEL_STALE 0x80u
#define BELT_ERROR_LEVEL_STEP 0x100u
#define BELT_ERROR_PERIODS_LATE 0x200u
#define BELT_ERROR_PERIODS_LOST 0x400u
#define BELT_ERROR_PERIOD_REPEATED 0x800u
#define BELT_ERROR_FLUX_MISMATCH 0x1000u
#define BELT_ERROR_DISTURBANCE_LIMIT 0x2000u
#define BELT_ERROR_HISTORY_SHORT 0x4000u

typedef struct {
    uint32_t present;           /**< BELT_HAS_... bits. */
    belt_real_t level;          /**< Q: level of the buffer [parts]. */
    belt_real_t outlet_flux;    /**< phi: flux leaving the belt [parts/s]. */
    belt_real_t applied_flux;   /**< flux really fed since the last step [parts/s]. */
    const belt_real_t *density; /**< rho: node_count + 1 densities, equally spaced, outlet to inlet
                                     [parts/m]; read in the step only. */
    uint32_t sample_count;      /**< changes with each new sample of the level; may wrap. */
    uint32_t elapsed_ticks;     /**< control periods since the last step, 1 on time. */
} belt_measurement_t;

/** How far outside the buffer noise may take a level that is still believed [level_capacity]. */
#define BELT_LEVEL_MARGIN BELT_REAL(0.1)

/** How the level stands. */
typedef enum {
    BELT_LEVEL_TRUSTED, /**< good samples come when they are due. */
    BELT_LEVEL_DOUBTED, /**< the last was not good, or too few good ones came since. */
    BELT_LEVEL_LOST     /**< none was good for hold_periods, and too few good ones came since:
                         recovery_samples in a row are trusted, with gaps they are doubted. */
} belt_level_health_t;

/** What passed. */
typedef struct {
    belt_real_t level;       /**< in [0, level_capacity] [parts]; the last good one if none came. */
    belt_real_t outlet_flux; /**< [parts/s], when has_outlet_flux. */
    belt_real_t applied_flux; /**< [parts/s]; the last command if none came. */
    uint32_t periods;         /**< to be made up for, 0 ... BELT_CATCH_UP_PERIODS. */
    bool level_is_new; /**< a new level passed; after lost periods it is used, and doubted. */
    bool has_outlet_flux;
    bool has_density;
    uint32_t error_bits; /**< BELT_ERROR_... */
} belt_trusted_t;

/** What the gate remembers from period to period. */
typedef struct {
    belt_real_t level;           /**< last good one [parts]. */
    belt_real_t level_elsewhere; /**< last sample further than level_step_max from it [parts]. */
    belt_real_t level_quality;   /**< share of good samples among the last 100 or so, 0 ... 1. */
    uint32_t sample_count;       /**< of the last new sample. */
    uint32_t sample_age;         /**< periods since. */
    uint32_t owed_periods;       /**< passed without a step before a restart, to be made up for. */
    uint32_t agreeing_samples;   /**< samples in a row that agree with level_elsewhere. */
    uint32_t good_samples;       /**< good ones in a row. */
    uint32_t found_samples;    /**< good ones since the level was lost, gaps within hold_periods. */
    uint32_t bad_periods;      /**< periods without a good one in a row. */
    uint32_t mismatch_periods; /**< periods in a row in which command and applied flux differed. */
    belt_level_health_t health;
    uint32_t has_level; /**< 1 once a level has been trusted. */
} belt_gate_t;

/** Periods that command and applied flux differ before it is said: a valve needs its time. */
#define BELT_MISMATCH_PERIODS 5u

/** Before the first sample: the level counts as trusted until something is wrong with it. */
void belt_measurement_init(belt_gate_t *gate, const belt_limits_t *limits);

/** Sorts one period's inputs; `command` is the flux commanded in the last step [parts/s]. O(1), a
 * density profile O(node_count). */
void belt_measurement_gate(belt_trusted_t *trusted, belt_gate_t *gate,
                           const belt_measurement_t *measurement, belt_real_t command,
                           const belt_line_t *line, const belt_limits_t *limits);

#endif
