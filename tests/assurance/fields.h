/* SPDX-License-Identifier: MIT */
/* fields.h - what lies where in a belt_controller_t: the rows of belt_flip's table. */
#ifndef TESTS_ASSURANCE_FIELDS_H
#define TESTS_ASSURANCE_FIELDS_H

#include "belt/belt.h"

typedef struct {
    const char *name;
    size_t begin;
} field_t;

#define FIELD(path) {#path, offsetof(belt_controller_t, path)}

/** Each ends where the next one begins. */
static const field_t fields[] = {
    FIELD(config),
    FIELD(config_seal),
    FIELD(law),
    FIELD(limits),
    FIELD(model.line),
    FIELD(model.line.loss),
    FIELD(model.line.loss_sum),
    FIELD(model.line.rework),
    FIELD(model.estimator_gains),
    FIELD(model.history),
    FIELD(model.history.base),
    FIELD(model.history.window_sum),
    FIELD(model.history.check_sum),
    FIELD(model.history.check_count),
    FIELD(model.history.newest),
    FIELD(model.history.level),
    FIELD(model.observer.density),
    FIELD(model.observer.step),
    FIELD(model.observer.cut),
    FIELD(model.observer.outlet),
    FIELD(model.observer.gone),
    FIELD(model.observer.outlet_density),
    FIELD(model.observer.modelled_density),
    FIELD(model.observer.fed_density),
    FIELD(model.observer.moment),
    FIELD(model.observer.jumps),
    FIELD(model.observer.jumps_place),
    FIELD(model.estimator.level),
    FIELD(model.estimator.difference),
    FIELD(model.estimator.disturbance),
    FIELD(model.present),
    FIELD(gate.level),
    FIELD(gate.level_elsewhere),
    FIELD(gate.level_quality),
    FIELD(gate.sample_count),
    FIELD(gate.sample_age),
    FIELD(gate.owed_periods),
    FIELD(gate.agreeing_samples),
    FIELD(gate.good_samples),
    FIELD(gate.bad_periods),
    FIELD(gate.mismatch_periods),
    FIELD(gate.health),
    FIELD(gate.has_level),
    FIELD(short_history),
    FIELD(state),
    FIELD(supervisor),
    FIELD(command),
    FIELD(command_seal),
    FIELD(seal),
    FIELD(trusted),
    FIELD(prediction),
};
#define FIELD_COUNT (sizeof fields / sizeof fields[0])

/** The field that a byte of the controller belongs to: the last that begins at or before it. */
static inline size_t field_of(size_t byte) {
    size_t found = 0;
    for (size_t i = 0; i < FIELD_COUNT; ++i) {
        const bool is_nearer = fields[i].begin >= fields[found].begin;
        found = ((fields[i].begin <= byte) && is_nearer) ? i : found;
    }
    return found;
}

#endif
