/* SPDX-License-Identifier: MIT */
#include "line.h"

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
