/* SPDX-License-Identifier: MIT */
/*
 * equilibrium.h - the line at rest at its set-point.
 */
#ifndef HOST_SIM_EQUILIBRIUM_H
#define HOST_SIM_EQUILIBRIUM_H

#include "line.h"

typedef struct {
    double congestion;     /**< R* = Q* tau [parts s]. */
    double dead_time;      /**< D over the speed at R* [s]. */
    double outlet_flux;    /**< service at Q*, over alpha [parts/s]. */
    double inlet_flux;     /**< the constant flux that holds Q* [parts/s]. */
    double inlet_density;  /**< [parts/m]. */
    double outlet_density; /**< [parts/m]. */
} equilibrium_t;

/** Integrates the stationary belt, speed*rho_x = C*rho - rework(x, rho(0)), from the outlet. */
equilibrium_t equilibrium_of(const line_t *line, double level_setpoint);

#endif
