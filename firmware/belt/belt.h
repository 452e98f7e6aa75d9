/* SPDX-License-Identifier: MIT */
/*
 * belt.h - the front door: a controller for a conveyor that feeds a buffer whose load sets the
 * conveyor's speed.
 *
 *     static belt_controller_t controller;          // all the memory there is; several are several
 *     belt_status_t status = belt_init(&controller, &config);
 *     every period: belt_step(&controller, &measurement, &command);
 *
 * Cost: see docs/COST.md; init and a set-point change are for start-up and operators, not for the
 * period. No heap, no recursion, every loop bounded by node_count (a loss profile: its square) or by
 * a constant. One context calls all functions of a controller; two controllers share nothing.
 */
#ifndef BELT_BELT_H
#define BELT_BELT_H

#include "command.h"
#include "config.h"
#include "gains.h"
#include "integrity.h"
#include "internal_model.h"
#include "limits.h"
#include "measurement.h"
#include "nominal_law.h"
#include "predictor.h"
#include "supervisor.h"
#include "types.h"

/** One line's controller. Declare it, pass it on; its fields are there to be looked at (by a
 * debugger, a trace, a test), not to be written. Each is one stage's result. */
typedef struct {
    belt_config_t config; /**< as checked; set_setpoint changes level_setpoint. */
    uint32_t config_seal; /**< sum of it. */

    /* Derived from it; under the seal, with the constants of the model. */
    belt_nominal_law_t law; /**< u(Q*, .) for the present set-point. */
    belt_limits_t limits;   /**< of gate and supervisor. */
    belt_model_t model;     /**< the line: its constants, then its state, period by period. */

    /* State, period by period. */
    belt_gate_t gate;       /**< what the gate remembers. */
    uint32_t short_history; /**< periods until the history is whole again, after a long stop. */
    uint32_t state;         /**< whether init has passed and a level has been trusted. */

    /* State, under the seal of the command. */
    belt_supervisor_t supervisor;
    belt_command_t command; /**< the last command. */
    uint32_t command_seal;  /**< sum of both. */

    uint32_t seal; /**< sum of what is derived, and of the level that the history counts from. */

    /* Anew in every step. */
    belt_trusted_t trusted;       /**< this period's inputs behind the gate. */
    belt_prediction_t prediction; /**< the march. */
} belt_controller_t;

/**
 * Checks and copies the configuration and starts with an empty belt. The first measurement's level
 * fills the whole speed window; a first measurement with a density profile says what lies on the
 * belt. Automatic is asked for.
 *
 * Returns BELT_OK, or the first broken rule's code: the controller then is as it was.
 * belt_config_check() tells all broken rules.
 */
belt_status_t belt_init(belt_controller_t *controller, const belt_config_t *config);

/**
 * One period: from this period's measurement to the flux to feed until the next step.
 *
 * Writes the whole command in every case: finite, 0 <= inlet_flux <= inlet_flux_max. Returns
 *   BELT_OK              every input present was trusted, and the line does as it is told;
 *   BELT_INPUT_REJECTED  one was not: command->error_bits say which; what stands in for it says
 *                        measurement.h, who is in command says command->mode;
 *   BELT_PERIODS_MISSED  the step came late or twice, or the history is not whole after a stop; else
 *                        all is well;
 *   BELT_LINE_DEVIATES   the valve does not feed what it is told, or the disturbance is at its limit;
 *   BELT_NO_LEVEL        no level has been trusted since init: automatic feeds nothing, mode is off;
 *                        manual works;
 *   BELT_CORRUPT         the controller's memory has changed under it: nothing is fed, now and
 *                        until it is initialised or restored;
 *   BELT_MISUSE          a null pointer or no successful init: nothing is fed. BELT_ASSERT first.
 * The last two answer 0 at once, without the rate limit.
 *
 * Every period that passes moves the belt of the model. Where the belt itself stands still (brakes, an
 * emergency stop), do not step, and go on with elapsed_ticks 1: for the line no time has passed.
 * What is fed by hand before the first level is not on the model's belt: it is seen a transit later.
 */
belt_status_t belt_step(belt_controller_t *controller, const belt_measurement_t *measurement,
                        belt_command_t *command);

/** True once a level has been trusted, while the controller's memory is as it was written. */
bool belt_is_running(const belt_controller_t *controller);

/**
 * Changes the set-point; it takes effect with the next step, and at the outlet one dead time later.
 * Solves the gains anew (slope_margin: S too). Returns BELT_OK, BELT_MISUSE, BELT_CORRUPT, or the
 * broken rule's code: the old set-point then stays.
 */
belt_status_t belt_set_setpoint(belt_controller_t *controller, belt_real_t level_setpoint);

/**
 * Asks for off, manual or automatic, from the next step on. Manual begins with the last command;
 * modes.h says how each change goes over. Returns BELT_OK, BELT_MISUSE, BELT_CORRUPT, or
 * BELT_UNKNOWN_MODE for any other mode: the old request then stands.
 */
belt_status_t belt_set_mode(belt_controller_t *controller, belt_mode_t mode);

/**
 * Sets the flux of manual [parts/s], within 0 ... inlet_flux_max (and belt_config_flux_bound(), for a
 * valve without limit). Returns BELT_OK, BELT_MISUSE,
 * BELT_CORRUPT, BELT_NOT_MANUAL unless manual is asked for, or BELT_MANUAL_FLUX; only BELT_OK
 * changes anything.
 */
belt_status_t belt_set_manual_flux(belt_controller_t *controller, belt_real_t inlet_flux);

#endif
