/* SPDX-License-Identifier: MIT */
/*
 * line_model.h - the physics that the stages share: speed, service, rework, loss. What may differ from
 * line to line stands in line_laws.h.
 *
 * Material enters the belt at x = D, moves to x = 0 and leaves into a buffer (eq:buffer1, Mp):
 *
 *     Q'    = alpha*phi - service(Q),        phi = speed(R)*density(0)
 *     rho_t = speed(R)*rho_x + rework(x, density(0)) - C(x)*rho
 *     speed = 1/(P*(1 + R/congestion_scale)),  R = integral of Q over the last speed_window
 *
 * The stages ask for the slowness 1/speed: it is linear in R, so that nothing need be divided.
 */
#ifndef BELT_LINE_MODEL_H
#define BELT_LINE_MODEL_H

#include "config.h"
#include "line_laws.h"

/* Whether a build knows lines whose material does not all age alike. With one loss rate and the paper's
 * laws there are none: tables and all that reads them then fall away. */
#ifdef BELT_LINE_LAWS
#define BELT_LINE_HAS_LAWS 1
#else
#define BELT_LINE_HAS_LAWS 0
#endif
#if (BELT_LOSS_CAPACITY > 1) || (BELT_LINE_HAS_LAWS > 0)
#define BELT_LINE_HAS_TABLES 1
#else
#define BELT_LINE_HAS_TABLES 0
#endif

/* Numbers in a table; one that is not there has one. */
#define BELT_LOSS_TABLE (BELT_LINE_HAS_TABLES * BELT_NODE_CAPACITY + 1)
#define BELT_REWORK_TABLE (BELT_LINE_HAS_LAWS * (BELT_NODE_CAPACITY + 1) + 1)

/** Numbers derived from the configuration, once. Lengths are counted in node spacings where the name
 * says `spacing`: material coordinates then are cell numbers. */
typedef struct {
    belt_real_t spacing;          /**< D/node_count [m]. */
    belt_real_t slowness_empty;   /**< P: slowness of the empty line [s/m]. */
    belt_real_t slowness_slope;   /**< P/congestion_scale: slowness per congestion [1/(m parts)]. */
    belt_real_t service_rate;     /**< 1/service_time [1/s]. */
    belt_real_t service_rate_max; /**< mu [parts/s]. */
    belt_real_t connectivity;     /**< alpha [-]. */
    belt_real_t gain;             /**< level gained per density and spacing, alpha*spacing [m]. */
    belt_real_t crowding; /**< share of its change that a prediction lets the congestion take: 1, or
                               0 to hold it. */
    belt_real_t level_capacity;     /**< Qmax [parts]. */
    belt_real_t rework_at_outlet;   /**< A*D: rework per density leaving, at the outlet [1/s]. */
    belt_real_t rework_per_spacing; /**< A*D/node_count: how much less of it each spacing on. */
    belt_real_t flux_bound;         /**< beyond any flux of a sound line [parts/s]. */
    belt_real_t density_bound;      /**< beyond any of its densities [parts/m]. */
    belt_real_t loss_mean;          /**< mean of C(x) along the belt [1/s]. */
    uint32_t node_count;
    uint32_t cell_slots;  /**< node_count + 1 cells lie on the belt; the next even number. */
    bool loss_is_uniform; /**< one C for the whole belt. */

    /* Tables, last: what stands before them is under the seal. */
    belt_real_t loss[BELT_LOSS_TABLE]; /**< mean of C(x) over each spacing, outlet first; the last
                                                stands twice [1/s]. */
    belt_real_t loss_sum[BELT_LOSS_TABLE]; /**< their sum up to each node [1/s]. */
    belt_real_t rework[BELT_REWORK_TABLE]; /**< at each node; the last stands twice [1/s]. */
} belt_line_t;

/** Derives the line from a configuration that belt_config_check() has passed. */
void belt_line_init(belt_line_t *line, const belt_config_t *config);

/** 1/omega(R) [s/m]. */
static inline belt_real_t belt_line_slowness(const belt_line_t *line, belt_real_t congestion) {
    return belt_law_slowness(belt_law_argument(congestion), line->slowness_empty,
                             line->slowness_slope);
}

/** A level that the buffer can have: what is too much is spilled; what is no number is none [parts]. */
static inline belt_real_t belt_line_level(const belt_line_t *line, belt_real_t level) {
    return belt_within(BELT_REAL(0), level, line->level_capacity);
}

/** What the buffer gives away [parts/s]. */
static inline belt_real_t belt_line_service(const belt_line_t *line, belt_real_t level) {
    return belt_law_service(belt_law_argument(level), line->service_rate, line->service_rate_max);
}

/** What of a density that leaves takes part in the rework [parts/m]. */
static inline belt_real_t belt_line_returned(belt_real_t outlet_density) {
    return belt_law_returned(belt_law_argument(outlet_density));
}

/* Density that rework puts back at a place in a second, per density returned [1/s]:
 *   belt_line_rework                by the place, 0 ... node_count [spacings from the outlet]
 *   belt_line_rework_beyond_inlet   by the distance from the inlet, the same [spacings] */
#ifdef BELT_LINE_LAWS
static inline belt_real_t belt_line_rework(const belt_line_t *line, belt_real_t place) {
    /* Whatever it is: a loss of the tables that has changed may make it anything. */
    const int32_t node = (int32_t)belt_within(BELT_REAL(0), place, (belt_real_t)line->node_count);
    const belt_real_t rise = line->rework[node + 1] - line->rework[node];
    return line->rework[node] + (place - (belt_real_t)node) * rise;
}
static inline belt_real_t belt_line_rework_beyond_inlet(const belt_line_t *line,
                                                        belt_real_t distance) {
    return belt_line_rework(line, (belt_real_t)line->node_count - distance);
}
#else
static inline belt_real_t belt_line_rework(const belt_line_t *line, belt_real_t place) {
    return line->rework_at_outlet - line->rework_per_spacing * place;
}
static inline belt_real_t belt_line_rework_beyond_inlet(const belt_line_t *line,
                                                        belt_real_t distance) {
    return line->rework_per_spacing * distance;
}
#endif

/* belt_line_loss       mean loss rate over a spacing, 0 the outlet's ... node_count (the inlet's again) [1/s]
 * belt_line_loss_sum   sum of the loss rates from the outlet to a place, 0 <= place <= node_count
 *                      [spacings]; linear between nodes, so that the losses of a way add up to its own
 *                      whatever the steps [1/s] */
#if BELT_LINE_HAS_TABLES
static inline belt_real_t belt_line_loss(const belt_line_t *line, uint32_t spacing) {
    return line->loss[spacing];
}
static inline belt_real_t belt_line_loss_sum(const belt_line_t *line, belt_real_t place) {
    const int32_t node = (int32_t)place;
    return line->loss_sum[node] + (place - (belt_real_t)node) * line->loss[node];
}
#else
static inline belt_real_t belt_line_loss(const belt_line_t *line, uint32_t spacing) {
    (void)spacing;
    return line->loss_mean;
}
static inline belt_real_t belt_line_loss_sum(const belt_line_t *line, belt_real_t place) {
    return line->loss_mean * place;
}
#endif

/** True where all material ages alike: survival and rework can be carried from one to the next. */
#if BELT_LINE_HAS_LAWS
static inline bool belt_line_is_plain(const belt_line_t *line) {
    (void)line;
    return false;
}
#elif BELT_LINE_HAS_TABLES
static inline bool belt_line_is_plain(const belt_line_t *line) {
    return line->loss_is_uniform;
}
#else
static inline bool belt_line_is_plain(const belt_line_t *line) {
    (void)line;
    return true;
}
#endif

/** 1 - exp(-loss), what is lost: the series up to the third power, for a loss over at most two
 * spacings, which twice BELT_CHANGE_PER_NODE_MAX bounds. Error below loss^4/20. */
static inline belt_real_t belt_line_lost(belt_real_t loss) {
    const belt_real_t third = BELT_REAL(1) / BELT_REAL(3);
    return loss * (BELT_REAL(1) - BELT_HALF * loss * (BELT_REAL(1) - third * loss));
}

/** exp(-loss), what survives. Where it is applied period after period, take off what is lost: a
 * factor so near to 1 would be wrong by the same rounding every time. */
static inline belt_real_t belt_line_survival(belt_real_t loss) {
    return BELT_REAL(1) - belt_line_lost(loss);
}

#endif
