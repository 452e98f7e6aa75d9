/* SPDX-License-Identifier: MIT */
/*
 * operator.h - the person at the panel: set-points, modes and the manual flux at stated times.
 *
 * He speaks in the control task: what falls due while the task does not run is said before its next
 * step. After a restart he says again what was in force, as a panel that keeps its settings does.
 */
#ifndef HOST_SIM_OPERATOR_H
#define HOST_SIM_OPERATOR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "belt/belt.h"
#include "scenario.h"

typedef struct {
    const scenario_t *scenario;
    size_t setpoints_said;
    size_t modes_said;
    size_t manual_said;
    double level_setpoint; /**< in force [parts]. */
} operator_t;

void operator_begin(operator_t *self, const scenario_t *scenario);

/** Says what has fallen due until period `index`. False, after a message, when the controller refuses
 * it. */
bool operator_speak(operator_t *self, belt_controller_t *controller, size_t index, FILE *messages);

/** Says again all that is in force. False, after a message, when the controller refuses it. */
bool operator_repeat(const operator_t *self, belt_controller_t *controller, FILE *messages);

#endif
