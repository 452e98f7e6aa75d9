/* SPDX-License-Identifier: MIT */
/*
 * replay.c - one controller driven by recorded measurements: belt_replay SCENARIO <ROWS >COMMANDS
 *
 * Built with the float and with the double controller, it shows what the number type alone does to
 * a step: no loop is closed, so both see the same inputs. Rows are `level_setpoint,level,applied_flux`
 * without a header, one a period; the first row's applied_flux is not read, since nothing was fed
 * before it. A command a line on standard output, %.17g. Exit 0 done, 1 a row or a step failed, 2 the
 * scenario or the command line is wrong.
 */
#include <stdio.h>
#include <string.h>

#include "belt/belt.h"
#include "model.h"
#include "scenario_file.h"

typedef struct {
    double level_setpoint;
    double level;
    double applied_flux;
} recorded_t;

/* Static: too large for the stack. */
static belt_controller_t controller;
static scenario_t scenario;
static belt_real_t profile[BELT_NODE_CAPACITY + 1];

static bool begin(const char *name) {
    const scenario_settings_t settings = {0};
    belt_config_t config;
    if (!scenario_file_read(name, &settings, &scenario, stderr)) {
        return false;
    }
    model_config(&scenario, &config);
    const belt_status_t status = belt_init(&controller, &config);
    if (status != BELT_OK) {
        fprintf(stderr, "belt_replay: %s: %s\n", name, belt_status_name(status));
        return false;
    }
    for (size_t i = 0; i <= config.node_count; ++i) {
        const double place = (double)i / (double)config.node_count;
        profile[i] = model_real(profile_at(&scenario.initial.observer_density, place, 1.0));
    }
    return true;
}

static bool read_row(recorded_t *row, bool *is_there) {
    const int count = scanf("%lf,%lf,%lf", &row->level_setpoint, &row->level, &row->applied_flux);
    *is_there = count == 3;
    return *is_there || ((count == EOF) && (ferror(stdin) == 0));
}

static bool step(const recorded_t *row, size_t index) {
    belt_measurement_t measurement;
    belt_command_t command;
    memset(&measurement, 0, sizeof measurement);
    measurement.present =
        BELT_HAS_LEVEL | ((index == 0) ? BELT_HAS_DENSITY : BELT_HAS_APPLIED_FLUX);
    measurement.level = model_real(row->level);
    measurement.applied_flux = model_real(row->applied_flux);
    measurement.density = profile;
    measurement.sample_count = (uint32_t)index;
    measurement.elapsed_ticks = 1;
    const belt_real_t wanted = model_real(row->level_setpoint);
    const belt_real_t present = controller.config.level_setpoint;
    const bool changes = (wanted > present) || (wanted < present);
    return (!changes || (belt_set_setpoint(&controller, wanted) == BELT_OK)) &&
           (belt_step(&controller, &measurement, &command) == BELT_OK) &&
           (printf("%.17g\n", (double)command.inlet_flux) > 0);
}

int main(int argument_count, char *argument[]) {
    if (argument_count != 2) {
        fprintf(stderr, "usage: belt_replay SCENARIO <ROWS >COMMANDS\n");
        return 2;
    }
    if (!begin(argument[1])) {
        return 2;
    }
    recorded_t row;
    bool is_there = true;
    for (size_t index = 0; is_there; ++index) {
        if (!read_row(&row, &is_there) || (is_there && !step(&row, index))) {
            fprintf(stderr, "belt_replay: row %zu: not three numbers, or the step failed\n", index);
            return 1;
        }
    }
    return (fflush(stdout) == 0) ? 0 : 1;
}
