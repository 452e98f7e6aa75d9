/* SPDX-License-Identifier: MIT */
/* nonlinear_rework_plant.h - the line of nonlinear_rework.h, for the simulated plant. */
#ifndef TESTS_LAWS_NONLINEAR_REWORK_PLANT_H
#define TESTS_LAWS_NONLINEAR_REWORK_PLANT_H

#include <math.h>

#include "line.h"

static inline double law_slowness(const line_t *line, double congestion) {
    return line->processing_time * (1.0 + congestion / line->congestion_scale);
}

static inline double law_service(const line_t *line, double level, double rate_max) {
    return fmin(level / line->service_time, rate_max);
}

static inline double law_returned(double outlet_density) {
    return outlet_density / (1.0 + 5.0 * outlet_density);
}

static inline double law_rework(const line_t *line, double x, double outlet_density) {
    return 3.0 * line->rework_rate * x * (1.0 - x / line->belt_length) *
           law_returned(outlet_density);
}

static inline double law_rework_of_belt(const line_t *line, double outlet_density) {
    return 0.5 * line->rework_rate * line->belt_length * line->belt_length *
           law_returned(outlet_density);
}

#endif
