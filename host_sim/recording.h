/* SPDX-License-Identifier: MIT */
/*
 * recording.h - what a run leaves behind: trace, densities and summary.
 */
#ifndef HOST_SIM_RECORDING_H
#define HOST_SIM_RECORDING_H

#include <stdio.h>

#include "loop.h"
#include "output.h"
#include "summary.h"

/** Where to; NULL: not wanted. The summary goes to standard output when no file is named. */
typedef struct {
    const char *trace;
    const char *density;
    const char *summary;
} recording_paths_t;

typedef struct {
    output_t trace;
    output_t density;
    output_t summary_file;
    summary_t summary;
    double belt_length; /**< the plant's [m]: places of the densities. */
} recording_t;

/** Opens the outputs. Refuses two that lead to the same file, and one that leads to `scenario_path`.
 * Unless OUTPUT_READY a message was written and nothing is open. */
output_status_t recording_begin(recording_t *recording, const recording_paths_t *paths,
                                const char *scenario_path, double belt_length, FILE *messages);

/** The sink that loop_run() fills. It stops the run when a row cannot be written or at an interrupt. */
loop_sink_t recording_sink(recording_t *recording);

/** After a complete run: completes all outputs and then gives them their names. Returns false after
 * a message, with all that had no name yet removed. */
bool recording_finish(recording_t *recording, const loop_totals_t *totals, FILE *messages);

/** After any other run: removes the temporaries; says on `messages` which output failed, if one did. */
void recording_abandon(recording_t *recording, FILE *messages);

#endif
