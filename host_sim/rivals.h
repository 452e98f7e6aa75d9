/* SPDX-License-Identifier: MIT */
/*
 * rivals.h - the laws that the controller is compared with.
 *
 * They take the place of the controller's own command, under its limit; modes, rate limit and
 * substitute stay the controller's and do not touch them.
 */
#ifndef HOST_SIM_RIVALS_H
#define HOST_SIM_RIVALS_H

#include <stdbool.h>

#include "belt/belt.h"
#include "scenario.h"

typedef struct {
    const scenario_t *scenario;
    double level_setpoint; /**< that `holding_flux` holds [parts]. */
    double holding_flux;   /**< the constant flux of open_loop [parts/s]. */
    bool has_flux;
} rivals_t;

void rivals_begin(rivals_t *self, const scenario_t *scenario);

/** Whether the scenario's law is the controller's own. */
bool rivals_are_out(const scenario_t *scenario);

/** The flux that the scenario's law feeds; `own` is the controller's command of this step,
 * `level_setpoint` is in force [parts/s]. */
double rivals_flux(rivals_t *self, const belt_controller_t *controller, const belt_command_t *own,
                   double level_setpoint);

#endif
