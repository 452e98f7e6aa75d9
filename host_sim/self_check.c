/* SPDX-License-Identifier: MIT */
#include "self_check.h"

#include <math.h>

/** A balance error beyond this share of all parts fed is a fault of the plant. */
#define BALANCE_SHARE 1e-3
/** Roundings in a limited change of the command. */
#define ROUNDINGS 4.0

static bool flux_is_within(const self_check_t *self, double flux) {
    return (flux >= 0.0) && (flux <= self->inlet_flux_max);
}

static bool change_is_within(const self_check_t *self, double flux) {
    const double rounding =
        ROUNDINGS * self->relative_precision * (fabs(flux) + fabs(self->inlet_flux_before));
    return fabs(flux - self->inlet_flux_before) <= self->inlet_flux_step + rounding;
}

static bool level_is_within(const self_check_t *self, double level) {
    return (level >= -1e-9 * self->level_capacity) && (level <= self->level_capacity);
}

bool self_check_passes(self_check_t *self, const loop_row_t *row, double parts,
                       double balance_error, FILE *messages) {
    const char *fault = NULL;
    if (!flux_is_within(self, row->inlet_flux)) {
        fault = "the command left its limits";
    } else if (!change_is_within(self, row->inlet_flux)) {
        fault = "the command changed faster than controller.flux_rate_max";
    } else if (!level_is_within(self, row->buffer_level)) {
        fault = "the plant's level left its limits: raise plant.substeps";
    } else if (!(fabs(balance_error) <= BALANCE_SHARE * parts + 1e-12 * self->level_capacity)) {
        fault = "the plant's parts do not balance: raise plant.substeps or plant.node_count";
    }
    if (fault != NULL) {
        fprintf(messages,
                "%s: self-check at %.9g s: %s (inlet_flux %.9g, buffer_level %.9g, balance "
                "error %.3g)\n",
                self->name, row->time, fault, row->inlet_flux, row->buffer_level, balance_error);
    }
    self->inlet_flux_before = row->inlet_flux;
    return fault == NULL;
}
