/* SPDX-License-Identifier: MIT */
/*
 * measurement.h - the gate: what of this period's inputs is trusted.
 *
 * Any bits may come in on any input. What passes the gate is finite and within its range, so no
 * stage behind it need ask again.
 */
#ifndef BELT_MEASUREMENT_H
#define BELT_MEASUREMENT_H

#include "line_model.h"

/* Which fields of a measurement are present; a field that is not is not read. */
#define BELT_HAS_LEVEL 1u
#define BELT_HAS_OUTLET_FLUX 2u
#define BELT_HAS_APPLIED_FLUX 4u
#define BELT_HAS_DENSITY 8u

/* Why an input was not trusted in this step, and what stands in for it. A value is senseless beyond
 * the bounds of belt_line_t.
 *   LEVEL_MISSING         there is none; the last good one
 *   LEVEL_INVALID         NaN or infinite; the last good one
 *   LEVEL_RANGE           outside [0, level_capacity]; the nearer end
 *   OUTLET_FLUX_INVALID   no number, negative or senseless; the observer's
 *   APPLIED_FLUX_INVALID  no number, negative or senseless; the last command
 *   DENSITY_INVALID       no profile, or a value in it no number or senseless; the observer's profile
 *   DENSITY_RANGE         a density below 0; the observer's profile */
#define BELT_ERROR_LEVEL_MISSING 1u
#define BELT_ERROR_LEVEL_INVALID 2u
#define BELT_ERROR_LEVEL_RANGE 4u
#define BELT_ERROR_OUTLET_FLUX_INVALID 8u
#define BELT_ERROR_APPLIED_FLUX_INVALID 16u
#define BELT_ERROR_DENSITY_INVALID 32u
#define BELT_ERROR_DENSITY_RANGE 64u

typedef struct {
    uint32_t present;           /**< BELT_HAS_... bits. */
    belt_real_t level;          /**< Q: level of the buffer [parts]. */
    belt_real_t outlet_flux;    /**< phi: flux leaving the belt [parts/s]. */
    belt_real_t applied_flux;   /**< flux really fed since the last step [parts/s]. */
    const belt_real_t *density; /**< rho: node_count + 1 densities, equally spaced, outlet to inlet
                                     [parts/m]; read in the step only. */
    uint32_t sample_count;  /**< goes up with each new sample of the level. Carried for later. */
    uint32_t elapsed_ticks; /**< control periods since the last step, 1 on time. Carried for
                                   later: every step counts as one period. */
} belt_measurement_t;

/** What passed. */
typedef struct {
    belt_real_t level;       /**< in [0, level_capacity] [parts]; the last good one if none came. */
    belt_real_t outlet_flux; /**< [parts/s], when has_outlet_flux. */
    belt_real_t applied_flux; /**< [parts/s]; the last command if none came. */
    bool level_is_new;        /**< a level of this period was trusted. */
    bool has_outlet_flux;
    bool has_density;
    uint32_t error_bits; /**< BELT_ERROR_... */
} belt_trusted_t;

/** Sorts one period's inputs; `last` is what was trusted before, `command` the last command. */
belt_trusted_t belt_measurement_gate(const belt_measurement_t *measurement,
                                     const belt_trusted_t *last, belt_real_t command,
                                     const belt_line_t *line);

#endif
