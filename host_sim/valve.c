/* SPDX-License-Identifier: MIT */
#include "valve.h"

bool valve_create(valve_t *self, const scenario_t *scenario) {
    const channel_setup_t setup = {scenario->run.faults, scenario->run.fault_count, FAULT_ON_VALVE,
                                   (uint32_t)scenario->plant.seed, scenario->controller.period};
    self->scenario = scenario;
    const bool is_created = channel_create(&self->channel, &setup, 1);
    if (is_created) {
        (void)valve_close(self);
    }
    return is_created;
}

void valve_destroy(valve_t *self) {
    channel_destroy(&self->channel);
}

static bool is_off(const valve_t *self, size_t index) {
    bool found = false;
    for (size_t i = 0; i < self->channel.station_count; ++i) {
        const fault_t *const fault = self->channel.station[i].fault;
        found = found ||
                ((fault->word == FAULT_OFF) && fault_is_active(fault, index, self->channel.period));
    }
    return found;
}

double valve_obey(valve_t *self, size_t index, double command) {
    double value = command;
    signal_t signal = {&value, true, false, 0};
    channel_pass(&self->channel, index, &signal);
    if (signal.is_present) {
        self->position = value;
    } else if (is_off(self, index)) {
        self->position = 0.0;
    } /* else the command was lost, and it stays */
    return self->position;
}

double valve_close(valve_t *self) {
    self->position = 0.0;
    const signal_t closed = {&self->position, true, false, 0};
    channel_settle(&self->channel, &closed);
    return self->position;
}
