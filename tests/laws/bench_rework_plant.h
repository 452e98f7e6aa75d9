/* SPDX-License-Identifier: MIT */
/* bench_rework_plant.h - the rework of nonlinear_rework.h and other_laws.h, for the simulated plant. */
#ifndef TESTS_LAWS_BENCH_REWORK_PLANT_H
#define TESTS_LAWS_BENCH_REWORK_PLANT_H

#include "line.h"

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
