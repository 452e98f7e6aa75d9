/* SPDX-License-Identifier: MIT */
/* nonlinear_rework_plant.h - the line of nonlinear_rework.h, for the simulated plant. */
#ifndef TESTS_LAWS_NONLINEAR_REWORK_PLANT_H
#define TESTS_LAWS_NONLINEAR_REWORK_PLANT_H

#include <math.h>

#include "bench_rework_plant.h"

static inline double law_slowness(const line_t *line, double congestion) {
    return line->processing_time * (1.0 + congestion / line->congestion_scale);
}

static inline double law_service(const line_t *line, double level, double rate_max) {
    return fmin(level / line->service_time, rate_max);
}

#endif
