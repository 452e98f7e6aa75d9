/* SPDX-License-Identifier: MIT */
/*
 * sensors.h - what is measured on the plant: sampled, noisy, rounded, and past its faults.
 *
 * The level has a sensor of its own kind: a new sample every level_sample_time, Gaussian noise of
 * level_noise on it, rounded to a multiple of level_quantum; between two samples the last one stands,
 * its sample_count too. The other signals are the plant's own numbers. A run without noise and without
 * faults of chance draws no random number.
 */
#ifndef HOST_SIM_SENSORS_H
#define HOST_SIM_SENSORS_H

#include <stdbool.h>
#include <stddef.h>

#include "chance.h"
#include "channel.h"
#include "plant.h"
#include "readings.h"
#include "scenario.h"

typedef struct {
    const scenario_t *scenario;
    chance_t noise;
    double sample;         /**< the level sensor's last sample [parts]. */
    uint32_t sample_count; /**< samples before it. */
    channel_t level;
    channel_t outlet_flux;
    channel_t applied_flux;
    channel_t density;
    double level_value;
    double outlet_value;
    double applied_value;
    double *profile; /**< node_count + 1 densities. */
} sensors_t;

/** Sensors that the scenario describes; it must outlive them. False when memory lacks; destroy them
 * all the same. */
bool sensors_create(sensors_t *self, const scenario_t *scenario);

void sensors_destroy(sensors_t *self);

/** Looks at the plant at the start of period `index`; once each period, in order. What the controller
 * does not get (scenario.controller) is not present. The readings point into the sensors. */
readings_t sensors_read(sensors_t *self, const plant_t *plant, size_t index);

#endif
