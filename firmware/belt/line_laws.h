/* SPDX-License-Identifier: MIT */
/*
 * line_laws.h - the laws of the line that another line may have otherwise: how its speed follows the
 * congestion, how the buffer gives parts away, what rework puts back where.
 *
 * Another line's laws stand in a header of its own, with these four functions; the library and all that
 * include it are then built with -DBELT_LINE_LAWS='"that_header.h"' (CMake: -DBELT_LINE_LAWS=path).
 * No other file changes. What they must keep to, so that the rules of a configuration still hold:
 *
 *     slowness   from `empty` at congestion 0 on, never falling, never steeper than `slope`
 *     service    0 at level 0, never falling, never steeper than `rate`, never above `rate_max`
 *     rework     0 <= rework <= rework_rate*belt_length, its mean along the belt at most half of that
 *     returned   0 for nothing, never falling, never steeper than 1
 *
 * With laws of its own a build takes rework from a table at the nodes, and survival and rework are found
 * for each place by itself, as with a loss profile: docs/COST.md has the cost.
 */
#ifndef BELT_LINE_LAWS_H
#define BELT_LINE_LAWS_H

#include "types.h"

#ifdef BELT_LINE_LAWS
#include BELT_LINE_LAWS

/** What a law is asked of: rounding, or a step that takes a little too much, leaves some numbers below 0. */
static inline belt_real_t belt_law_argument(belt_real_t value) {
    return (value > BELT_REAL(0)) ? value : BELT_REAL(0);
}
#else

static inline belt_real_t belt_law_argument(belt_real_t value) {
    return value; /* the paper's laws go on below 0 */
}

/** Time per length at a congestion >= 0 [s/m]: empty + slope*congestion, which is the paper's speed
 * 1/(P*(1 + R/congestion_scale)) written as its inverse. `empty` is P [s/m], `slope` its rise
 * P/congestion_scale [1/(m parts)]. */
static inline belt_real_t belt_law_slowness(belt_real_t congestion, belt_real_t empty,
                                            belt_real_t slope) {
    return empty + slope * congestion;
}

/** What the buffer gives away at a level >= 0 [parts/s] (eq:buffer3): level*rate, but at most rate_max;
 * `rate` is 1/service_time [1/s]. */
static inline belt_real_t belt_law_service(belt_real_t level, belt_real_t rate,
                                           belt_real_t rate_max) {
    const belt_real_t served = level * rate;
    return (served < rate_max) ? served : rate_max;
}

/** Density put back at place x in a second, per density returned (Mp3): A*(D - x) [1/s]. For the table,
 * at start-up only: it may be as slow as it likes. */
static inline belt_real_t belt_law_rework(belt_real_t x, belt_real_t belt_length,
                                          belt_real_t rework_rate) {
    return rework_rate * (belt_length - x);
}

/** What of a density that leaves takes part in the rework [parts/m]: all of it. In the step, twice a
 * cell and a few times more. */
static inline belt_real_t belt_law_returned(belt_real_t outlet_density) {
    return outlet_density;
}

#endif /* the paper's laws */
#endif
