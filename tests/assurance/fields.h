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
    FIELD(estimator_gains),
    FIELD(line),
    FIELD(line.loss),
    FIELD(line.loss_sum),
    FIELD(history),
    FIELD(history.base),
    FIELD(history.window_sum),
    FIELD(history.check_sum),
    FIELD(history.check_count),
    FIELD(history.newest),
    FIELD(history.level),
    FIELD(observer.density),
    FIELD(observer.step),
    FIELD(observer.cut),
    FIELD(observer.outlet),
    FIELD(observer.gone),
    FIELD(observer.outlet_density),
    FIELD(observer.modelled_density),
    FIELD(observer.fed_density),
    FIELD(observer.moment),
    FIELD(observer.jumps),
    FIELD(observer.jumps_place),
    FIELD(estimator.level),
    FIELD(estimator.difference),
    FIELD(estimator.disturbance),
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
    FIELD(present),
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
