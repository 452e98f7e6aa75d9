/* SPDX-License-Identifier: MIT */
/*
 * reception.h - the readings of a period in the controller's own terms.
 */
#ifndef HOST_SIM_RECEPTION_H
#define HOST_SIM_RECEPTION_H

#include <stdbool.h>
#include <stddef.h>

#include "belt/belt.h"
#include "readings.h"
#include "scenario.h"

/** The measurement of one step, and the room its density profile lies in. */
typedef struct {
    belt_measurement_t measurement;
    belt_real_t profile[BELT_NODE_CAPACITY + 1];
} reception_t;

/** Fills in what is present. Before the first step, and unless the density is measured, the controller
 * is told what the scenario lets it believe of the belt. */
void reception_take(reception_t *self, const scenario_t *scenario, const readings_t *readings,
                    uint32_t elapsed_ticks, bool is_first_step);

/** One number of a signal that is present, as it arrives. */
belt_real_t reception_number(const signal_t *signal, size_t index);

#endif
