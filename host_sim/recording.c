/* SPDX-License-Identifier: MIT */
#include "recording.h"

#include <errno.h>
#include <string.h>

#include "interrupt.h"
#include "trace.h"

#define OUTPUT_COUNT 3

static void list_outputs(recording_t *recording, output_t *outputs[OUTPUT_COUNT]) {
    outputs[0] = &recording->trace;
    outputs[1] = &recording->density;
    outputs[2] = &recording->summary_file;
}

static void discard_all(recording_t *recording) {
    output_t *outputs[OUTPUT_COUNT];
    list_outputs(recording, outputs);
    for (size_t index = 0; index < OUTPUT_COUNT; index++) {
        output_discard(outputs[index]);
    }
}

static bool has_own_place(const recording_t *recording, const output_t *output,
                          const char *scenario_path, FILE *messages) {
    if (output_is_at(output, scenario_path)) {
        fprintf(messages, "%s: is the scenario itself\n", output->path);
        return false;
    }
    const output_t *const others[OUTPUT_COUNT] = {&recording->trace, &recording->density,
                                                  &recording->summary_file};
    for (size_t index = 0; index < OUTPUT_COUNT && others[index] != output; index++) {
        if (output_is_same(output, others[index])) {
            fprintf(messages, "%s: two outputs lead to this file\n", output->path);
            return false;
        }
    }
    return true;
}

output_status_t recording_begin(recording_t *recording, const recording_paths_t *paths,
                                const char *scenario_path, double belt_length, FILE *messages) {
    memset(recording, 0, sizeof *recording);
    recording->belt_length = belt_length;
    summary_begin(&recording->summary);
    const char *const names[OUTPUT_COUNT] = {paths->trace, paths->density, paths->summary};
    output_t *outputs[OUTPUT_COUNT];
    list_outputs(recording, outputs);
    output_status_t status = OUTPUT_READY;
    for (size_t index = 0; index < OUTPUT_COUNT && status == OUTPUT_READY; index++) {
        status = output_open(outputs[index], names[index], messages);
        if (status == OUTPUT_READY &&
            !has_own_place(recording, outputs[index], scenario_path, messages)) {
            status = OUTPUT_REFUSED;
        }
    }
    if (status != OUTPUT_READY) {
        discard_all(recording);
    }
    return status;
}

static bool take_row(void *context, const loop_row_t *row, const double *density,
                     size_t density_count) {
    recording_t *const recording = context;
    FILE *const trace = recording->trace.stream;
    FILE *const belt = recording->density.stream;
    const bool is_first = recording->summary.row_count == 0;
    summary_take(&recording->summary, row);
    const bool has_headers =
        !is_first ||
        ((trace == NULL || trace_write_header(trace)) &&
         (belt == NULL || density_write_header(belt, recording->belt_length, density_count)));
    return has_headers && (trace == NULL || trace_write_row(trace, row)) &&
           (belt == NULL || density_write_row(belt, row->time, density, density_count)) &&
           interrupt_signal() == 0;
}

loop_sink_t recording_sink(recording_t *recording) {
    const loop_sink_t sink = {recording, recording->density.stream != NULL,
                              recording->trace.stream != NULL, take_row};
    return sink;
}

/* Last before the names are given: a summary on the screen tells of files that are on the disk. */
static bool summary_is_shown(const recording_t *recording, const loop_totals_t *totals,
                             FILE *messages) {
    if (!summary_write(&recording->summary, totals, stdout) || fflush(stdout) != 0) {
        fprintf(messages, "standard output: not written: %s\n", strerror(errno));
        return false;
    }
    return true;
}

bool recording_finish(recording_t *recording, const loop_totals_t *totals, FILE *messages) {
    FILE *const summary_file = recording->summary_file.stream;
    output_t *outputs[OUTPUT_COUNT];
    list_outputs(recording, outputs);
    if (summary_file != NULL) {
        (void)summary_write(&recording->summary, totals,
                            summary_file); /* completion sees a failure */
    }
    bool is_done = true;
    for (size_t index = 0; index < OUTPUT_COUNT && is_done; index++) {
        is_done = output_complete(outputs[index], messages);
    }
    is_done = is_done && interrupt_signal() == 0 &&
              (summary_file != NULL || summary_is_shown(recording, totals, messages));
    for (size_t index = 0; index < OUTPUT_COUNT && is_done; index++) {
        is_done = output_publish(outputs[index], messages);
    }
    discard_all(recording);
    return is_done;
}

void recording_abandon(recording_t *recording, FILE *messages) {
    output_t *outputs[OUTPUT_COUNT];
    list_outputs(recording, outputs);
    for (size_t index = 0; index < OUTPUT_COUNT; index++) {
        FILE *const stream = outputs[index]->stream;
        if (stream != NULL && ferror(stream) != 0) {
            (void)output_complete(outputs[index], messages); /* for its message */
        }
    }
    discard_all(recording);
}
