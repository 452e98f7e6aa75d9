/* SPDX-License-Identifier: MIT */
#include "line.h"

#include "line_laws.h"

double profile_at(const profile_t *profile, double place, double length) {
    if (profile->count < 2) {
        return profile->value[0];
    }
    const size_t intervals = profile->count - 1;
    const double position = place / length * (double)intervals;
    if (!(position > 0.0)) { /* written so that NaN lands here and never becomes an index */
        return profile->value[0];
    }
    if (position >= (double)intervals) {
        return profile->value[intervals];
    }
    const size_t left = (size_t)position;
    const double share = position - (double)left;
    return profile->value[left] + share * (profile->value[left + 1] - profile->value[left]);
}

double line_speed(const line_t *line, double congestion) {
    return 1.0 / law_slowness(line, congestion);
}

double line_service(const line_t *line, double level, double rate_max) {
    return law_service(line, level, rate_max);
}

double line_rework(const line_t *line, double x, double outlet_density) {
    return law_rework(line, x, outlet_density);
}

double line_rework_of_belt(const line_t *line, double outlet_density) {
    return law_rework_of_belt(line, outlet_density);
}
