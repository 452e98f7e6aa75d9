/* SPDX-License-Identifier: MIT */
#include "equilibrium.h"

#define STEPS 6400

/** rho_x of the stationary belt. */
static double density_slope(const line_t *line, double speed, double x, double density,
                            double outlet_density) {
    const double loss = profile_at(&line->loss_rate, x, line->belt_length);
    const double rework = line_rework(line, x, outlet_density);
    return (loss * density - rework) / speed;
}

equilibrium_t equilibrium_of(const line_t *line, double level_setpoint) {
    equilibrium_t rest;
    rest.congestion = level_setpoint * line->speed_window;
    const double speed = line_speed(line, rest.congestion);
    rest.dead_time = line->belt_length / speed;
    rest.outlet_flux =
        line_service(line, level_setpoint, line->service_rate_max) / line->connectivity;
    rest.outlet_density = rest.outlet_flux / speed;
    const double dx = line->belt_length / STEPS;
    double density = rest.outlet_density;
    for (int i = 0; i < STEPS; ++i) { /* Heun's second-order steps */
        const double x = i * dx;
        const double before = density_slope(line, speed, x, density, rest.outlet_density);
        const double after =
            density_slope(line, speed, x + dx, density + dx * before, rest.outlet_density);
        density += 0.5 * dx * (before + after);
    }
    rest.inlet_density = density;
    rest.inlet_flux = speed * density;
    return rest;
}
