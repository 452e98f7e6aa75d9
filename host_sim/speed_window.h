/* SPDX-License-Identifier: MIT */
/*
 * speed_window.h - the plant's own memory of its level: R(t), the integral of Q over [t - tau, t].
 *
 * One level a plant step, trapezoids between them. The running sum is made anew each time the ring
 * has gone round, so that it never is older than one window.
 */
#ifndef HOST_SIM_SPEED_WINDOW_H
#define HOST_SIM_SPEED_WINDOW_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    double *level; /**< ring of levels [parts], `length` of them. */
    size_t length; /**< whole + 2. */
    size_t newest;
    size_t whole; /**< whole steps in the window. */
    double part;  /**< rest of it [steps], [0, 1). */
    double step;  /**< the plant step [s]. */
    double sum;   /**< of the whole + 1 newest levels [parts]. */
} speed_window_t;

/** Prepares a window of `window` seconds in steps of `step` seconds, filled with one level. False
 * when memory lacks. */
bool speed_window_create(speed_window_t *self, double window, double step, double level);

void speed_window_destroy(speed_window_t *self);

void speed_window_push(speed_window_t *self, double level);

/** R now [parts s]. */
double speed_window_congestion(const speed_window_t *self);

/** The level that leaves the window now, Q(t - tau) [parts]. */
double speed_window_tail(const speed_window_t *self);

#endif
