/* SPDX-License-Identifier: MIT */
/*
 * self_check.h - limits that neither side may leave in any run, whatever goes wrong in it.
 */
#ifndef HOST_SIM_SELF_CHECK_H
#define HOST_SIM_SELF_CHECK_H

#include <stdbool.h>
#include <stdio.h>

#include "loop.h"

typedef struct {
    const char *name;          /**< the scenario's, for messages. */
    double inlet_flux_max;     /**< the controller's, in its own numbers [parts/s]. */
    double inlet_flux_step;    /**< greatest change of the command from step to step [parts/s]. */
    double relative_precision; /**< of the controller's numbers. */
    double level_capacity;     /**< the plant's [parts]. */
    double inlet_flux_before;  /**< the last step's command [parts/s]. */
} self_check_t;

/** Looks at a row; `parts` are all that have come into the plant, `balance_error` those that are not
 * accounted for. False after a message. */
bool self_check_passes(self_check_t *self, const loop_row_t *row, double parts,
                       double balance_error, FILE *messages);

#endif
