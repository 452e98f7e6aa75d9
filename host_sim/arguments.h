/* SPDX-License-Identifier: MIT */
/*
 * arguments.h - the command line of belt_sim.
 */
#ifndef HOST_SIM_ARGUMENTS_H
#define HOST_SIM_ARGUMENTS_H

#include <stdbool.h>
#include <stdio.h>

#include "recording.h"
#include "scenario.h"

typedef enum { COMMAND_RUN, COMMAND_CHECK, COMMAND_LIST, COMMAND_HELP } command_t;

typedef struct {
    command_t command;
    const char *scenario; /**< run, check: as written. */
    scenario_settings_t settings;
    recording_paths_t paths;
} arguments_t;

/** Takes the command line apart. `texts` has room for twice `argument_count` texts; the results point
 * into it and into `argument`. Returns false after a line on `messages`. */
bool arguments_read(int argument_count, char *const argument[], const char **texts,
                    arguments_t *arguments, FILE *messages);

/** Writes how the program is used. */
void arguments_help(FILE *out);

#endif
