/* SPDX-License-Identifier: MIT */
/*
 * line.h - the numbers of one conveyor and buffer, as the host programs hold them, and the laws that go
 * with them where one is simulated.
 *
 * The scenario reader fills one for the model the controller believes in and one for the plant
 * that is simulated; the two differ when a scenario overrides a key of [line] in [plant].
 */
#ifndef HOST_SIM_LINE_H
#define HOST_SIM_LINE_H

#include <stddef.h>

/** Greatest number of values in a list of a scenario: profiles, set-point times. */
#define LIST_CAPACITY 64

/** Values equally spaced from outlet (first) to inlet (last), linear between; one value: uniform. */
typedef struct {
    double value[LIST_CAPACITY];
    size_t count;
} profile_t;

typedef struct {
    double belt_length;      /**< D: from outlet x = 0 to inlet x = D [m], > 0. */
    double processing_time;  /**< P: time a metre takes on an uncongested line [s/m], > 0. */
    double speed_window;     /**< tau: how far back the level counts for the speed [s], > 0. */
    double congestion_scale; /**< congestion at which the speed is halved [parts s], > 0. */
    double connectivity; /**< alpha: share of the outlet flux that reaches the buffer, (0, 1]. */
    double service_rate_max; /**< mu: greatest rate of service [parts/s], > 0. */
    double service_time;     /**< service is level/service_time below its greatest rate [s], > 0. */
    double level_capacity;   /**< Qmax: parts the buffer holds, > 0. */
    double
        rework_rate; /**< A: density put back at x for each unit leaving, A (D - x) [1/(m s)], >= 0. */
    profile_t loss_rate; /**< C(x): share of the density lost in unit time, below 0 grown [1/s]. */
} line_t;

/** Value of a profile at `place` in [0, length], linear between its equally spaced values. */
double profile_at(const profile_t *profile, double place, double length);

/* The laws of the simulated line; line_laws.h has them, and how another line has others. */

/** omega at a congestion >= 0: 1/(P*(1 + R/congestion_scale)) [m/s]. */
double line_speed(const line_t *line, double congestion);

/** What the buffer gives away at a level, when its greatest rate is `rate_max`: min(level/service_time,
 * rate_max) [parts/s]. */
double line_service(const line_t *line, double level, double rate_max);

/** Density put back at x in [0, belt_length] while `outlet_density` v leaves: A*(D - x)*v
 * [parts/(m s)]. */
double line_rework(const line_t *line, double x, double outlet_density);

/** Its integral over the belt: A*D^2/2*v [parts/s]. */
double line_rework_of_belt(const line_t *line, double outlet_density);

#endif
