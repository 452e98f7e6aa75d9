/* SPDX-License-Identifier: MIT */
/*
 * model.h - what a scenario tells the controller: its configuration, and the rules it must keep.
 */
#ifndef HOST_SIM_MODEL_H
#define HOST_SIM_MODEL_H

#include <stdbool.h>
#include <stdio.h>

#include "belt/belt.h"
#include "scenario.h"

/** The controller's configuration, in the controller's own numbers. */
void model_config(const scenario_t *scenario, belt_config_t *config);

/** A double in the controller's numbers; what is beyond them becomes their greatest. */
belt_real_t model_real(double value);

/** Whether a step of this scenario may say this. Without faults, noise, disturbance and difference
 * between plant and model nothing but BELT_OK is sound; a command that is not the controller's own
 * (laws to compare with) deviates from it too. */
bool model_expects(const scenario_t *scenario, belt_status_t status);

/** Prints every rule, one a line: its value, its limits and how far the nearer one is. Returns how
 * many are broken. */
int model_print_rules(const belt_config_t *config, FILE *out);

/** Whether the controller refuses the scenario's `index`-th set-point to come; then prints the broken
 * rules, with its time. */
bool model_refuses_setpoint(const scenario_t *scenario, size_t index, FILE *messages);

/** Prints the broken rules, one a line with value and limits, `name` before each. */
void model_print_refusals(const belt_config_t *config, const char *name, FILE *messages);

#endif
