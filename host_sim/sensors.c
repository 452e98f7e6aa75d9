/* SPDX-License-Identifier: MIT */
#include "sensors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "schedule.h"

static bool create_channel(channel_t *channel, const scenario_t *scenario, fault_signal_t signal,
                           size_t width) {
    const channel_setup_t setup = {scenario->run.faults, scenario->run.fault_count, signal,
                                   (uint32_t)scenario->plant.seed, scenario->controller.period};
    return channel_create(channel, &setup, width);
}

bool sensors_create(sensors_t *self, const scenario_t *scenario) {
    const size_t nodes = (size_t)scenario->controller.node_count + 1;
    memset(self, 0, sizeof *self);
    self->scenario = scenario;
    chance_begin(&self->noise, (uint32_t)scenario->plant.seed, 0);
    self->profile = calloc(nodes, sizeof *self->profile);
    return (self->profile != NULL) &&
           create_channel(&self->level, scenario, FAULT_ON_BUFFER_LEVEL, 1) &&
           create_channel(&self->outlet_flux, scenario, FAULT_ON_OUTLET_FLUX, 1) &&
           create_channel(&self->applied_flux, scenario, FAULT_ON_APPLIED_FLUX, 1) &&
           create_channel(&self->density, scenario, FAULT_ON_DENSITY, nodes);
}

void sensors_destroy(sensors_t *self) {
    channel_destroy(&self->level);
    channel_destroy(&self->outlet_flux);
    channel_destroy(&self->applied_flux);
    channel_destroy(&self->density);
    free(self->profile);
    self->profile = NULL;
}

/** Samples that are due up to the start of period `index`, the first at the start of the run not
 * counted. */
static uint32_t samples_due(const scenario_t *scenario, size_t index) {
    const double interval = scenario->plant.level_sample_time;
    const double period = scenario->controller.period;
    if (!(interval > period)) {
        return (uint32_t)index;
    }
    double due = floor((double)index * period / interval);
    if (schedule_has_come((due + 1.0) * interval, index, period)) {
        due += 1.0; /* the product fell short of it by a rounding */
    }
    return (uint32_t)due;
}

/** Looks at the level when a sample is due, and only then. */
static void sample_level(sensors_t *self, const plant_t *plant, size_t index) {
    const uint32_t due = samples_due(self->scenario, index);
    if ((index > 0) && (due == self->sample_count)) {
        return;
    }
    const double noise = self->scenario->plant.level_noise;
    const double quantum = self->scenario->plant.level_quantum;
    self->sample_count = due;
    self->sample = plant->level;
    if (noise > 0.0) {
        self->sample += noise * chance_normal(&self->noise);
    }
    if (quantum > 0.0) {
        self->sample = quantum * floor(self->sample / quantum + 0.5);
    }
}

static signal_t passed(channel_t *channel, size_t index, double *value, uint32_t sample_count) {
    signal_t signal = {value, true, false, sample_count};
    channel_pass(channel, index, &signal);
    return signal;
}

readings_t sensors_read(sensors_t *self, const plant_t *plant, size_t index) {
    readings_t readings;
    memset(&readings, 0, sizeof readings);
    sample_level(self, plant, index);
    self->level_value = self->sample;
    readings.level = passed(&self->level, index, &self->level_value, self->sample_count);
    if (index > 0) { /* nothing has been fed before */
        self->applied_value = plant->applied_flux;
        readings.applied_flux = passed(&self->applied_flux, index, &self->applied_value, 0);
    }
    if (self->scenario->controller.outlet_flux == OUTLET_MEASURED) {
        self->outlet_value = plant_outlet_flux(plant);
        readings.outlet_flux = passed(&self->outlet_flux, index, &self->outlet_value, 0);
    }
    if (self->scenario->controller.density == DENSITY_MEASURED) {
        plant_profile(plant, self->profile, self->density.width);
        readings.density = passed(&self->density, index, self->profile, 0);
    }
    return readings;
}
