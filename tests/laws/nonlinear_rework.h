/* SPDX-License-Identifier: MIT */
/*
 * nonlinear_rework.h - rework for a controller that puts parts back in the middle of the belt, and less
 * than in proportion when much leaves: g(x, v) = 3*A*x*(1 - x/D)*v/(1 + v/v0), v0 = 0.2 parts/m. Speed and
 * service are the paper's.
 */
#ifndef TESTS_LAWS_NONLINEAR_REWORK_H
#define TESTS_LAWS_NONLINEAR_REWORK_H

static inline belt_real_t belt_law_slowness(belt_real_t congestion, belt_real_t empty,
                                            belt_real_t slope) {
    return empty + slope * congestion;
}

static inline belt_real_t belt_law_service(belt_real_t level, belt_real_t rate,
                                           belt_real_t rate_max) {
    const belt_real_t served = level * rate;
    return (served < rate_max) ? served : rate_max;
}

/** At most 0.75*A*D, in the middle; its mean is A*D/2, as the contract allows. */
static inline belt_real_t belt_law_rework(belt_real_t x, belt_real_t belt_length,
                                          belt_real_t rework_rate) {
    return BELT_REAL(3) * rework_rate * x * (BELT_REAL(1) - x / belt_length);
}

/** At most v0: the rework bench is busy. */
static inline belt_real_t belt_law_returned(belt_real_t outlet_density) {
    return outlet_density / (BELT_REAL(1) + BELT_REAL(5) * outlet_density);
}

#endif
