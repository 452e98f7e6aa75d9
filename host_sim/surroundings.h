/* SPDX-License-Identifier: MIT */
/*
 * surroundings.h - what changes around the line at stated times: a flow from elsewhere, the service.
 */
#ifndef HOST_SIM_SURROUNDINGS_H
#define HOST_SIM_SURROUNDINGS_H

#include <stddef.h>

#include "plant.h"
#include "scenario.h"

typedef struct {
    const scenario_t *scenario;
    size_t disturbances_done;
    size_t services_done;
} surroundings_t;

void surroundings_begin(surroundings_t *self, const scenario_t *scenario);

/** Makes the plant's surroundings those of period `index`; once each period, in order. */
void surroundings_change(surroundings_t *self, plant_t *plant, size_t index);

#endif
