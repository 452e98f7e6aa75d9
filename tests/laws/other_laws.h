/* SPDX-License-Identifier: MIT */
/*
 * other_laws.h - a line with laws of its own, for a controller:
 *
 *     slowness   P*(1 + R/(R0 + R)), R0 = congestion_scale: never more than half as fast as empty
 *     service    y/(1 + y/mu), y = Q/service_time: bends to mu instead of breaking off at it
 *     rework     g(x, v) = 3*A*x*(1 - x/D)*v/(1 + v/v0), v0 = 0.2 parts/m: most in the middle of the belt,
 *                and less than in proportion when much leaves
 */
#ifndef TESTS_LAWS_OTHER_LAWS_H
#define TESTS_LAWS_OTHER_LAWS_H

static inline belt_real_t belt_law_slowness(belt_real_t congestion, belt_real_t empty,
                                            belt_real_t slope) {
    const belt_real_t more = slope * congestion;
    return empty + empty * more / (empty + more);
}

static inline belt_real_t belt_law_service(belt_real_t level, belt_real_t rate,
                                           belt_real_t rate_max) {
    const belt_real_t offered = level * rate;
    return offered * rate_max / (rate_max + offered);
}

static inline belt_real_t belt_law_rework(belt_real_t x, belt_real_t belt_length,
                                          belt_real_t rework_rate) {
    return BELT_REAL(3) * rework_rate * x * (BELT_REAL(1) - x / belt_length);
}

static inline belt_real_t belt_law_returned(belt_real_t outlet_density) {
    return outlet_density / (BELT_REAL(1) + BELT_REAL(5) * outlet_density);
}

#endif
