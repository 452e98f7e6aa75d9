/* SPDX-License-Identifier: MIT */
/* papers_laws.h - the paper's own laws, by the way that another line's take: rework from a table. */
#ifndef TESTS_LAWS_PAPERS_LAWS_H
#define TESTS_LAWS_PAPERS_LAWS_H

static inline belt_real_t belt_law_slowness(belt_real_t congestion, belt_real_t empty,
                                            belt_real_t slope) {
    return empty + slope * congestion;
}

static inline belt_real_t belt_law_service(belt_real_t level, belt_real_t rate,
                                           belt_real_t rate_max) {
    const belt_real_t served = level * rate;
    return (served < rate_max) ? served : rate_max;
}

static inline belt_real_t belt_law_rework(belt_real_t x, belt_real_t belt_length,
                                          belt_real_t rework_rate) {
    return rework_rate * (belt_length - x);
}

static inline belt_real_t belt_law_returned(belt_real_t outlet_density) {
    return outlet_density;
}

#endif
