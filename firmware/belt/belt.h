/* SPDX-License-Identifier: MIT */
/*
 * belt.h - the front door: a controller for a conveyor that feeds a buffer whose load sets the
 * conveyor's speed.
 *
 *     static belt_controller_t controller;          // all the memory there is; several are several
 *     belt_status_t status = belt_init(&controller, &config);
 *     every period: belt_step(&controller, &measurement, &command);
 *
 * Cost: a step of 20 nodes takes some 3,300 instructions and at most 3,800 (x86-64, uniform loss; with
 * a loss profile 8,600); init and a set-point change are for start-up and operators, not for the
 * period. No heap, no recursion, every loop bounded by node_count (a loss profile: its square) or by
 * a constant. One context calls step and set_setpoint; two controllers share nothing.
 */
#ifndef BELT_BELT_H
#define BELT_BELT_H

#include "command.h"
#include "config.h"
#include "gains.h"
#include "level_history.h"
#include "line_model.h"
#include "measurement.h"
#include "nominal_law.h"
#include "observer.h"
#include "predictor.h"
#include "types.h"

/** One line's controller. Declare it, pass it on; its fields are there to be looked at (by a
 * debugger, a trace, a test), not to be written. Each is one stage's result. */
typedef struct {
    belt_config_t config;         /**< as checked; set_setpoint changes level_setpoint. */
    belt_line_t line;             /**< numbers derived from it. */
    belt_nominal_law_t law;       /**< u(Q*, .) for the present set-point. */
    belt_level_history_t history; /**< levels of the last speed_window. */
    belt_observer_t observer;     /**< density along the belt. */
    belt_trusted_t trusted;       /**< this period's inputs behind the gate. */
    belt_present_t present;       /**< Q(t), R(t). */
    belt_prediction_t prediction; /**< the march. */
    belt_command_t command;       /**< the last command. */
    belt_real_t transport_speed;  /**< omega(R(t)) [m/s]. */
    uint32_t state;               /**< whether init has passed and a level has been trusted. */
} belt_controller_t;

/**
 * Checks and copies the configuration and starts with an empty belt. The first measurement's level
 * fills the whole speed window; a first measurement with a density profile says what lies on the
 * belt.
 *
 * Returns BELT_OK, or the first broken rule's code: the controller then is as it was.
 * belt_config_check() tells all broken rules.
 */
belt_status_t belt_init(belt_controller_t *controller, const belt_config_t *config);

/**
 * One period: from this period's measurement to the flux to feed until the next step.
 *
 * Writes the whole command in every case: finite, 0 <= inlet_flux <= inlet_flux_max. Returns
 *   BELT_OK              every input present was trusted;
 *   BELT_INPUT_REJECTED  one was not, command->error_bits say which; what stands in for it says
 *                        measurement.h; the law stays in command;
 *   BELT_NO_LEVEL        no level has been trusted since init: nothing is fed, mode is off;
 *   BELT_MISUSE          a null pointer or no successful init: nothing is fed. BELT_ASSERT first.
 */
belt_status_t belt_step(belt_controller_t *controller, const belt_measurement_t *measurement,
                        belt_command_t *command);

/**
 * Changes the set-point; it takes effect with the next step, and at the outlet one dead time later.
 * Solves the gains anew (slope_margin: S too). Returns BELT_OK, BELT_MISUSE, or the broken rule's
 * code: the old set-point then stays.
 */
belt_status_t belt_set_setpoint(belt_controller_t *controller, belt_real_t level_setpoint);

#endif
