/* SPDX-License-Identifier: MIT */
/*
 * scenario_rules.h - what the values of a scenario must keep together.
 */
#ifndef HOST_SIM_SCENARIO_RULES_H
#define HOST_SIM_SCENARIO_RULES_H

#include <stdbool.h>
#include <stddef.h>

#include "scenario.h"
#include "scenario_keys.h"
#include "scenario_message.h"

/** Looks at a scenario whose every value is in its own range; `list_count` holds how many values each
 * key's list has as stated. Returns false after a message on the first rule broken. */
bool scenario_rules_hold(const scenario_t *scenario, const size_t list_count[SCENARIO_KEY_CAPACITY],
                         const scenario_place_t *place);

#endif
