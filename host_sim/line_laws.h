/* SPDX-License-Identifier: MIT */
/*
 * line_laws.h - the simulated line's laws, for line.c alone: what line.h says of each function holds here.
 *
 * Another line's laws stand in a header of its own, with these four functions; host_sim is then built with
 * -DSIM_LINE_LAWS='"that_header.h"'. What is simulated and what the controller believes in are told apart
 * at compile time too: the controller's laws are those of its own line_laws.h.
 */
#ifndef HOST_SIM_LINE_LAWS_H
#define HOST_SIM_LINE_LAWS_H

#include "line.h"

#ifdef SIM_LINE_LAWS
#include SIM_LINE_LAWS
#else

#include <math.h>

static inline double law_slowness(const line_t *line, double congestion) {
    return line->processing_time * (1.0 + congestion / line->congestion_scale);
}

static inline double law_service(const line_t *line, double level, double rate_max) {
    return fmin(level / line->service_time, rate_max);
}

static inline double law_rework(const line_t *line, double x, double outlet_density) {
    return line->rework_rate * (line->belt_length - x) * outlet_density;
}

static inline double law_rework_of_belt(const line_t *line, double outlet_density) {
    return 0.5 * line->rework_rate * line->belt_length * line->belt_length * outlet_density;
}

#endif /* the paper's laws */
#endif
