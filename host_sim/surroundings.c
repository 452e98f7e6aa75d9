/* SPDX-License-Identifier: MIT */
#include "surroundings.h"

#include "schedule.h"

void surroundings_begin(surroundings_t *self, const scenario_t *scenario) {
    const surroundings_t fresh = {scenario, 0, 0};
    *self = fresh;
}

void surroundings_change(surroundings_t *self, plant_t *plant, size_t index) {
    const schedule_t *const disturbance = &self->scenario->plant.disturbance;
    const schedule_t *const service = &self->scenario->plant.service;
    const double period = self->scenario->controller.period;
    const size_t disturbances = schedule_come(disturbance->times, disturbance->count,
                                              self->disturbances_done, index, period);
    const size_t services =
        schedule_come(service->times, service->count, self->services_done, index, period);
    if (disturbances > self->disturbances_done) {
        plant_disturb(plant, disturbance->values[disturbances - 1]);
    }
    if (services > self->services_done) {
        plant_change_service(plant, service->values[services - 1]);
    }
    self->disturbances_done = disturbances;
    self->services_done = services;
}
