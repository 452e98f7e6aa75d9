/* SPDX-License-Identifier: MIT */
/* other_laws_plant.h - the line of other_laws.h, for the simulated plant. */
#ifndef TESTS_LAWS_OTHER_LAWS_PLANT_H
#define TESTS_LAWS_OTHER_LAWS_PLANT_H

#include "line.h"

static inline double law_slowness(const line_t *line, double congestion) {
    return line->processing_time * (1.0 + congestion / (line->congestion_scale + congestion));
}

static inline double law_service(const line_t *line, double level, double rate_max) {
    const double offered = level / line->service_time;
    return (rate_max > 0.0) ? offered / (1.0 + offered / rate_max) : 0.0;
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
