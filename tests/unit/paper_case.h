/* SPDX-License-Identifier: MIT */
/* paper_case.h - the paper's configuration, and the line at rest in closed form. */
#ifndef TESTS_UNIT_PAPER_CASE_H
#define TESTS_UNIT_PAPER_CASE_H

#include "belt/config.h"

#include <math.h>

/** The paper's line and law, on 20 cells. */
static inline belt_config_t paper_case(void) {
    const belt_config_t config = {
        .belt_length = BELT_REAL(2),
        .processing_time = BELT_REAL(0.25),
        .speed_window = BELT_REAL(0.2),
        .congestion_scale = BELT_REAL(1),
        .connectivity = BELT_REAL(0.5),
        .service_rate_max = BELT_REAL(0.8),
        .service_time = BELT_REAL(1),
        .level_capacity = BELT_REAL(1),
        .rework_rate = BELT_REAL(0.1),
        .loss_rate = {BELT_REAL(1)},
        .loss_count = 1,
        .level_setpoint = BELT_REAL(0.3),
        .nominal_flux_max = BELT_REAL(1.2),
        .slope_kind = BELT_SLOPE_MARGIN,
        .slope = BELT_REAL(20),
        .node_count = 20,
        .period = BELT_REAL(0.0025),
        .inlet_flux_max = BELT_NO_FLUX_LIMIT,
        .prediction = BELT_PREDICT_CONGESTION,
    };
    return config;
}

/** The line at rest at its set-point: stationary belt, constant level. Uniform loss > 0. */
typedef struct {
    double congestion;     /**< R = Q* tau [parts s]. */
    double slowness;       /**< 1/omega [s/m]. */
    double dead_time;      /**< [s]. */
    double outlet_density; /**< [parts/m]. */
    double inlet_flux;     /**< U [parts/s]. */
} rest_t;

/** Stationary density at x [m]: omega*rho_x = C*rho - A*(D - x)*v, rho(0) = v, solved by hand:
 * rho = E*(v - v*A*slowness*J), E = exp(c*x), c = C*slowness,
 * J = integral of (D - y)*exp(-c*y) over [0, x]. */
static inline double rest_density(const belt_config_t *config, const rest_t *rest, double x) {
    const double c = (double)config->loss_rate[0] * rest->slowness;
    const double decay = exp(-c * x);
    const double length = (double)config->belt_length;
    const double integral = (length - (length - x) * decay) / c - (1.0 - decay) / (c * c);
    return rest->outlet_density * (1.0 - (double)config->rework_rate * rest->slowness * integral) /
           decay;
}

static inline rest_t line_at_rest(const belt_config_t *config) {
    rest_t rest;
    const double level = (double)config->level_setpoint;
    const double out = fmin(level / (double)config->service_time, (double)config->service_rate_max);
    rest.congestion = level * (double)config->speed_window;
    rest.slowness = (double)config->processing_time *
                    (1.0 + rest.congestion / (double)config->congestion_scale);
    rest.dead_time = rest.slowness * (double)config->belt_length;
    rest.outlet_density = out / (double)config->connectivity * rest.slowness;
    rest.inlet_flux = rest_density(config, &rest, (double)config->belt_length) / rest.slowness;
    return rest;
}

#endif
