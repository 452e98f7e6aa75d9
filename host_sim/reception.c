/* SPDX-License-Identifier: MIT */
#include "reception.h"

#include <string.h>

#include "model.h"

/** The number that the low bits of garbage are: any of them, NaN and infinity too. */
static belt_real_t number_of_bits(const double *garbage) {
    uint64_t bits;
    belt_real_t number;
    memcpy(&bits, garbage, sizeof bits);
    const belt_word_t word = (belt_word_t)bits;
    memcpy(&number, &word, sizeof number);
    return number;
}

belt_real_t reception_number(const signal_t *signal, size_t index) {
    return signal->is_garbage ? number_of_bits(&signal->value[index])
                              : model_real(signal->value[index]);
}

static void take_density(reception_t *self, const scenario_t *scenario, const signal_t *density,
                         bool is_first_step) {
    const size_t count = (size_t)scenario->controller.node_count + 1;
    const bool is_told = is_first_step && (scenario->controller.density == DENSITY_OBSERVED);
    self->measurement.density = self->profile;
    if (density->is_present || is_told) {
        self->measurement.present |= BELT_HAS_DENSITY;
    }
    for (size_t i = 0; (i < count) && density->is_present; ++i) {
        self->profile[i] = reception_number(density, i);
    }
    for (size_t i = 0; (i < count) && is_told; ++i) {
        const double place = (double)i / (double)(count - 1);
        self->profile[i] = model_real(profile_at(&scenario->initial.observer_density, place, 1.0));
    }
}

void reception_take(reception_t *self, const scenario_t *scenario, const readings_t *readings,
                    uint32_t elapsed_ticks, bool is_first_step) {
    belt_measurement_t *const measurement = &self->measurement;
    memset(measurement, 0, sizeof *measurement);
    measurement->present = BELT_HAS_ELAPSED_TICKS;
    measurement->elapsed_ticks = elapsed_ticks;
    if (readings->level.is_present) {
        measurement->present |= BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT;
        measurement->level = reception_number(&readings->level, 0);
        measurement->sample_count = readings->level.sample_count;
    }
    if (readings->applied_flux.is_present) {
        measurement->present |= BELT_HAS_APPLIED_FLUX;
        measurement->applied_flux = reception_number(&readings->applied_flux, 0);
    }
    if (readings->outlet_flux.is_present) {
        measurement->present |= BELT_HAS_OUTLET_FLUX;
        measurement->outlet_flux = reception_number(&readings->outlet_flux, 0);
    }
    take_density(self, scenario, &readings->density, is_first_step);
}
