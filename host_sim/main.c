/* SPDX-License-Identifier: MIT */
/*
 * main.c - belt_sim: conveyor, buffer and controller in a closed loop on the host.
 */
#include <stdlib.h>

#include "arguments.h"
#include "check.h"
#include "interrupt.h"
#include "loop.h"
#include "recording.h"
#include "scenario.h"
#include "scenario_file.h"

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_REFUSED = 2 };

static int exit_of_loop(loop_status_t status) {
    switch (status) {
        case LOOP_DONE: return EXIT_DONE;
        case LOOP_CONFIG_REFUSED: return EXIT_REFUSED;
        case LOOP_NO_MEMORY: fputs("belt_sim: no memory\n", stderr); return EXIT_FAILED;
        case LOOP_STOPPED:
        case LOOP_SELF_CHECK: break;
    }
    return EXIT_FAILED;
}

static int exit_of_output(output_status_t status) {
    switch (status) {
        case OUTPUT_READY: return EXIT_DONE;
        case OUTPUT_REFUSED: return EXIT_REFUSED;
        case OUTPUT_FAILED: break;
    }
    return EXIT_FAILED;
}

static int record(const scenario_t *scenario, recording_t *recording) {
    const loop_sink_t sink = recording_sink(recording);
    loop_totals_t totals = {0};
    const loop_status_t status = loop_run(scenario, &sink, stderr, &totals);
    if (status != LOOP_DONE) {
        recording_abandon(recording, stderr);
        return exit_of_loop(status);
    }
    return recording_finish(recording, &totals, stderr) ? EXIT_DONE : EXIT_FAILED;
}

static int run(const arguments_t *arguments, const scenario_t *scenario) {
    recording_t recording;
    char *const scenario_path = scenario_file_path(arguments->scenario);
    if (scenario_path == NULL) {
        return exit_of_loop(LOOP_NO_MEMORY);
    }
    interrupt_watch();
    const output_status_t status = recording_begin(&recording, &arguments->paths, scenario_path,
                                                   scenario->plant.line.belt_length, stderr);
    free(scenario_path);
    const int exit_code =
        status == OUTPUT_READY ? record(scenario, &recording) : exit_of_output(status);
    interrupt_obey();
    return exit_code;
}

/* `exit_code`, unless standard output lost something. */
static int exit_of_standard_output(int exit_code) {
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        perror("standard output");
        return EXIT_FAILED;
    }
    return exit_code;
}

static int obey(const arguments_t *arguments) {
    if (arguments->command == COMMAND_HELP) {
        arguments_help(stdout);
        return exit_of_standard_output(EXIT_DONE);
    }
    if (arguments->command == COMMAND_LIST) {
        const bool is_listed = scenario_file_list(stdout, stderr);
        return exit_of_standard_output(is_listed ? EXIT_DONE : EXIT_REFUSED);
    }
    scenario_t scenario;
    if (!scenario_file_read(arguments->scenario, &arguments->settings, &scenario, stderr)) {
        return EXIT_REFUSED;
    }
    scenario.name = arguments->scenario; /* outlives the path it was read from */
    if (arguments->command == COMMAND_CHECK) {
        const bool holds = check_report(&scenario, stdout);
        return exit_of_standard_output(holds ? EXIT_DONE : EXIT_REFUSED);
    }
    return run(arguments, &scenario);
}

int main(int argument_count, char *argument[]) {
    const char **const texts = calloc(2 * (size_t)argument_count + 1, sizeof *texts);
    if (texts == NULL) {
        return exit_of_loop(LOOP_NO_MEMORY);
    }
    arguments_t arguments;
    const bool is_read = arguments_read(argument_count, argument, texts, &arguments, stderr);
    const int exit_code = is_read ? obey(&arguments) : EXIT_REFUSED;
    free(texts);
    return exit_code;
}
