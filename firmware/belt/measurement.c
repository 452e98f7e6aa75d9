/* SPDX-License-Identifier: MIT */
#include "measurement.h"

/** True for numbers in [0, bound]; false for every NaN and infinity. */
static bool is_sound(belt_real_t value, belt_real_t bound) {
    return (value >= BELT_REAL(0)) && (value <= bound);
}

static bool is_finite(belt_real_t value) {
    return (value >= -BELT_REAL_MAX) && (value <= BELT_REAL_MAX);
}

static void gate_level(belt_trusted_t *trusted, const belt_measurement_t *measurement,
                       belt_real_t capacity) {
    trusted->level_is_new = false;
    if ((measurement->present & BELT_HAS_LEVEL) == 0u) {
        trusted->error_bits |= BELT_ERROR_LEVEL_MISSING;
    } else if (!is_finite(measurement->level)) {
        trusted->error_bits |= BELT_ERROR_LEVEL_INVALID;
    } else {
        trusted->level = measurement->level;
        trusted->level_is_new = true;
        if (!is_sound(measurement->level, capacity)) {
            trusted->error_bits |= BELT_ERROR_LEVEL_RANGE;
            trusted->level = (measurement->level > capacity) ? capacity : BELT_REAL(0);
        }
    }
}

static void gate_density(belt_trusted_t *trusted, const belt_measurement_t *measurement,
                         uint32_t node_count, belt_real_t bound) {
    trusted->has_density = false;
    if ((measurement->present & BELT_HAS_DENSITY) == 0u) {
        return;
    }
    if (measurement->density == NULL) {
        trusted->error_bits |= BELT_ERROR_DENSITY_INVALID;
        return;
    }
    uint32_t found = 0;
    for (uint32_t i = 0; i <= node_count; ++i) {
        const belt_real_t density = measurement->density[i];
        if (density < BELT_REAL(0)) {
            found |= BELT_ERROR_DENSITY_RANGE;
        } else if (!is_sound(density, bound)) {
            found |= BELT_ERROR_DENSITY_INVALID;
        }
    }
    trusted->error_bits |= found;
    trusted->has_density = (found == 0u);
}

belt_trusted_t belt_measurement_gate(const belt_measurement_t *measurement,
                                     const belt_trusted_t *last, belt_real_t command,
                                     const belt_line_t *line) {
    belt_trusted_t trusted = *last;
    trusted.error_bits = 0;
    gate_level(&trusted, measurement, line->level_capacity);

    trusted.has_outlet_flux = (measurement->present & BELT_HAS_OUTLET_FLUX) != 0u;
    if (trusted.has_outlet_flux) {
        if (is_sound(measurement->outlet_flux, line->flux_bound)) {
            trusted.outlet_flux = measurement->outlet_flux;
        } else {
            trusted.has_outlet_flux = false;
            trusted.error_bits |= BELT_ERROR_OUTLET_FLUX_INVALID;
        }
    }

    trusted.applied_flux = command;
    if ((measurement->present & BELT_HAS_APPLIED_FLUX) != 0u) {
        if (is_sound(measurement->applied_flux, line->flux_bound)) {
            trusted.applied_flux = measurement->applied_flux;
        } else {
            trusted.error_bits |= BELT_ERROR_APPLIED_FLUX_INVALID;
        }
    }
    gate_density(&trusted, measurement, line->node_count, line->density_bound);
    return trusted;
}
