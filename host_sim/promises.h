/* SPDX-License-Identifier: MIT */
/*
 * promises.h - what can be promised of the inlet flux for a scenario's start. Advice, no rule: a bound
 * that does not hold says nothing against the line.
 */
#ifndef HOST_SIM_PROMISES_H
#define HOST_SIM_PROMISES_H

#include <stdio.h>

#include "belt/belt.h"
#include "scenario.h"

/** Prints Proposition 2, the sharper bound and the jump at the inlet (firmware/belt/safety.h) for what
 * the controller is told at the start, before any fault. `config` has passed its check. */
void promises_report(const scenario_t *scenario, const belt_config_t *config, FILE *out);

#endif
