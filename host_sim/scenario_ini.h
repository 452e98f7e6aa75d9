/* SPDX-License-Identifier: MIT */
/*
 * scenario_ini.h - the text of a scenario, taken apart by inih into sections, keys and values.
 */
#ifndef HOST_SIM_SCENARIO_INI_H
#define HOST_SIM_SCENARIO_INI_H

#include <stdbool.h>
#include <stddef.h>

#include "scenario_message.h"

/** Receives each `key = value` in the order of the text; returning false, after a message, ends it. */
typedef struct {
    void *context;
    bool (*take)(void *context, const scenario_place_t *place, const scenario_entry_t *entry);
} scenario_taker_t;

/** Refuses, with a message, whatever inih and configparser would read differently (scenario.h). */
bool scenario_ini_read(const char *text, size_t length, const char *name,
                       const scenario_taker_t *taker, FILE *messages);

#endif
