/* SPDX-License-Identifier: MIT */
/*
 * scenario_file.h - scenarios on the disk: the user's by path, the shipped ones by name.
 *
 * Shipped scenarios are found from any working directory: in the folder named by the environment
 * variable BELT_SIM_SCENARIOS when it is set, else where the program was built from.
 */
#ifndef HOST_SIM_SCENARIO_FILE_H
#define HOST_SIM_SCENARIO_FILE_H

#include <stdbool.h>
#include <stdio.h>

#include "scenario.h"

/** Path of a scenario: `wanted` itself when it has a `/` or ends in .ini, else the shipped one of
 * that name. Returns memory the caller frees, NULL when there is none left. */
char *scenario_file_path(const char *wanted);

/** Finds, loads and reads a scenario. Returns false after a message; for an unknown shipped name it
 * lists the known ones. */
bool scenario_file_read(const char *wanted, const scenario_settings_t *settings,
                        scenario_t *scenario, FILE *messages);

/** Writes the name and the opening sentence of each shipped scenario, in order of the names.
 * Returns false after a message. */
bool scenario_file_list(FILE *out, FILE *messages);

#endif
