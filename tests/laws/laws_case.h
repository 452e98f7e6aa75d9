/* SPDX-License-Identifier: MIT */
/* laws_case.h - the other laws in double, for the fine grid of tests/unit/predictor_case.h, which
 * includes it. */
#ifndef TESTS_LAWS_LAWS_CASE_H
#define TESTS_LAWS_LAWS_CASE_H

#include "line_laws.h"

static inline line_t line_of_config(void) {
    line_t line = {0};
    line.belt_length = (double)config.belt_length;
    line.processing_time = (double)config.processing_time;
    line.congestion_scale = (double)config.congestion_scale;
    line.service_time = (double)config.service_time;
    line.rework_rate = (double)config.rework_rate;
    return line;
}

static inline double service(double level) {
    const line_t line = line_of_config();
    return law_service(&line, level, (double)config.service_rate_max);
}

static inline double slowness_at(double congestion) {
    const line_t line = line_of_config();
    return law_slowness(&line, congestion);
}

static inline double rework_at(double x, double v) {
    const line_t line = line_of_config();
    return law_rework(&line, x, v);
}

#endif
