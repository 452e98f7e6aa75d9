/* SPDX-License-Identifier: MIT */
/*
 * check.h - what can be said of a scenario before anything runs.
 */
#ifndef HOST_SIM_CHECK_H
#define HOST_SIM_CHECK_H

#include <stdbool.h>
#include <stdio.h>

#include "scenario.h"

/** Prints every rule of the configuration with its value, limit and margin, the range of the dead
 * time, the equilibrium and, as advice, what can be promised of the inlet flux. Returns true when every
 * rule holds. */
bool check_report(const scenario_t *scenario, FILE *out);

#endif
