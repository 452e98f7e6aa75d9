/* SPDX-License-Identifier: MIT */
/* other_laws_plant.h - the line of other_laws.h, for the simulated plant. */
#ifndef TESTS_LAWS_OTHER_LAWS_PLANT_H
#define TESTS_LAWS_OTHER_LAWS_PLANT_H

#include "bench_rework_plant.h"

static inline double law_slowness(const line_t *line, double congestion) {
    return line->processing_time * (1.0 + congestion / (line->congestion_scale + congestion));
}

static inline double law_service(const line_t *line, double level, double rate_max) {
    const double offered = level / line->service_time;
    return (rate_max > 0.0) ? offered / (1.0 + offered / rate_max) : 0.0;
}

#endif
