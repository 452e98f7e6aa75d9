/* SPDX-License-Identifier: MIT */
/*
 * scenario_value.h - the text behind a key becomes a value in the scenario.
 */
#ifndef HOST_SIM_SCENARIO_VALUE_H
#define HOST_SIM_SCENARIO_VALUE_H

#include <stdbool.h>

#include "scenario.h"
#include "scenario_keys.h"
#include "scenario_message.h"

/** Reads `text` as the key's kind, checks its range and stores it. Returns false after a message;
 * the scenario's value is then untouched. Blanks around the text do not count. */
bool scenario_value_store(const scenario_key_t *key, const char *text,
                          const scenario_place_t *place, scenario_t *scenario);

/** Adds what `text` holds to a list, behind what it holds already. Otherwise as scenario_value_store(). */
bool scenario_value_add(const scenario_key_t *key, const char *text, const scenario_place_t *place,
                        scenario_t *scenario);

/** Copies the value of one key to another of the same kind. */
void scenario_value_copy(const scenario_key_t *from, const scenario_key_t *to,
                         scenario_t *scenario);

/** Number of values a list holds; 0 for what is no list. */
size_t scenario_value_count(const scenario_key_t *key, const scenario_t *scenario);

#endif
