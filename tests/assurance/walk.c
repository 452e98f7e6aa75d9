/* SPDX-License-Identifier: MIT */
/*
 * walk.c - a controller that is told, line by line, what happens to it: belt_walk <ROWS >ANSWERS
 *
 * First writes its configuration, a line of `name value` pairs. Then for each row
 *     asked manual_flux present level sample_count elapsed_ticks applied_flux echo
 * (asked: a mode, or -1 nothing; manual_flux: NaN is none asked for; present and so on:
 * the fields of the measurement; echo 1: the flux applied is the last command) an answer
 *     status_of_mode status_of_flux status mode error_bits health inlet_flux law_flux bump disturbance
 * where law_flux is what the law alone asks for, within the limits. Exit 0 done, 1 a row is wrong.
 */
#include <stdio.h>
#include <string.h>

#include "../unit/paper_case.h"
#include "belt/belt.h"

typedef struct {
    int asked;
    double manual_flux;
    unsigned present;
    double level;
    unsigned sample_count;
    unsigned elapsed_ticks;
    double applied_flux;
    int echo;
} row_t;

static belt_config_t configuration(void) {
    belt_config_t config = paper_case();
    config.inlet_flux_max = BELT_REAL(2.5);
    config.estimator = BELT_ESTIMATOR_ON;
    config.flux_rate_max = BELT_REAL(160);
    config.substitute_flux = BELT_REAL(0.625);
    config.level_step_max = BELT_REAL(0.125);
    config.transfer_time = BELT_REAL(0.02);
    config.sample_periods = 2;
    config.hold_periods = 8;
    config.recovery_samples = 4;
    return config;
}

static void print_configuration(const belt_config_t *config) {
    printf("level_capacity %.9g nominal_flux_max %.9g connectivity %.9g service_rate_max %.9g "
           "period %.9g inlet_flux_max %.9g flux_rate_max %.9g substitute_flux %.9g "
           "level_step_max %.9g transfer_time %.9g sample_periods %u hold_periods %u "
           "recovery_samples %u\n",
           (double)config->level_capacity, (double)config->nominal_flux_max,
           (double)config->connectivity, (double)config->service_rate_max, (double)config->period,
           (double)config->inlet_flux_max, (double)config->flux_rate_max,
           (double)config->substitute_flux, (double)config->level_step_max,
           (double)config->transfer_time, config->sample_periods, config->hold_periods,
           config->recovery_samples);
}

static bool read_row(row_t *row) {
    return scanf("%d %lf %u %lf %u %u %lf %d", &row->asked, &row->manual_flux, &row->present,
                 &row->level, &row->sample_count, &row->elapsed_ticks, &row->applied_flux,
                 &row->echo) == 8;
}

/** What the law alone asks for after a step that made a march. */
static double law_flux(const belt_controller_t *controller) {
    if (!belt_is_running(controller) || (controller->prediction.inlet.count == 0u)) {
        return 0.0;
    }
    return (double)belt_command_limit(
        belt_command_solve(&controller->prediction, &controller->model, &controller->law),
        controller->limits.inlet_flux_max);
}

static void answer(belt_controller_t *controller, const row_t *row) {
    belt_measurement_t measurement;
    belt_command_t command;
    belt_status_t of_mode = BELT_OK;
    belt_status_t of_flux = BELT_OK;
    if (row->asked >= 0) {
        of_mode = belt_set_mode(controller, (belt_mode_t)row->asked);
    }
    if (row->manual_flux == row->manual_flux) {
        of_flux = belt_set_manual_flux(controller, (belt_real_t)row->manual_flux);
    }
    memset(&measurement, 0, sizeof measurement);
    measurement.present = row->present;
    measurement.level = (belt_real_t)row->level;
    measurement.sample_count = row->sample_count;
    measurement.elapsed_ticks = row->elapsed_ticks;
    measurement.applied_flux =
        (row->echo != 0) ? controller->command.inlet_flux : (belt_real_t)row->applied_flux;
    const belt_status_t status = belt_step(controller, &measurement, &command);
    printf("%s %s %s %u %u %u %.9g %.9g %.9g %.9g\n", belt_status_name(of_mode),
           belt_status_name(of_flux), belt_status_name(status), (unsigned)command.mode,
           (unsigned)command.error_bits, (unsigned)controller->gate.health,
           (double)command.inlet_flux, law_flux(controller), (double)controller->supervisor.bump,
           (double)controller->model.estimator.disturbance);
}

int main(void) {
    static belt_controller_t controller;
    const belt_config_t config = configuration();
    row_t row;
    print_configuration(&config);
    if (belt_init(&controller, &config) != BELT_OK) {
        return 1;
    }
    while (read_row(&row)) {
        answer(&controller, &row);
    }
    return ((ferror(stdin) == 0) && (feof(stdin) != 0) && (fflush(stdout) == 0)) ? 0 : 1;
}
