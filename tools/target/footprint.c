/* SPDX-License-Identifier: MIT */
/*
 * footprint.c - the smallest program that uses all calls of belt.h: what the linker takes from libbelt.a
 * for it is the library's size. It is linked, never run.
 */
#include "belt/belt.h"

belt_status_t footprint(const belt_config_t *config, const belt_measurement_t *measurement,
                        belt_command_t *command);

belt_controller_t footprint_controller;

belt_status_t footprint(const belt_config_t *config, const belt_measurement_t *measurement,
                        belt_command_t *command) {
    belt_status_t status = belt_init(&footprint_controller, config);
    if (status == BELT_OK) {
        status = belt_set_setpoint(&footprint_controller, config->level_setpoint);
    }
    if (status == BELT_OK) {
        status = belt_set_mode(&footprint_controller, BELT_MODE_MANUAL);
    }
    if (status == BELT_OK) {
        status = belt_set_manual_flux(&footprint_controller, config->nominal_flux_max);
    }
    return ((status == BELT_OK) && belt_is_running(&footprint_controller))
               ? belt_step(&footprint_controller, measurement, command)
               : status;
}

/* Nothing is known of what comes in. */
int main(int argument_count, char *argument[]) {
    belt_command_t command;
    return (argument_count == 3)
               ? (int)footprint((const belt_config_t *)(void *)argument[1],
                                (const belt_measurement_t *)(void *)argument[2], &command)
               : 1;
}
