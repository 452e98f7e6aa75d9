/* SPDX-License-Identifier: MIT */
/*
 * valve.h - what the plant's valve makes of the command when the valve is at fault.
 *
 * How much a sound valve lets through at most is the plant's inlet_flux_max.
 */
#ifndef HOST_SIM_VALVE_H
#define HOST_SIM_VALVE_H

#include <stdbool.h>
#include <stddef.h>

#include "channel.h"
#include "scenario.h"

typedef struct {
    const scenario_t *scenario;
    channel_t channel;
    double position; /**< the flux it stands at [parts/s]. */
} valve_t;

/** A closed valve. False when memory lacks; destroy it all the same. */
bool valve_create(valve_t *self, const scenario_t *scenario);

void valve_destroy(valve_t *self);

/** Where it stands in period `index` under a command [parts/s]; once each period, in order. */
double valve_obey(valve_t *self, size_t index, double command);

/** The period without power: it closes. */
double valve_close(valve_t *self);

#endif
