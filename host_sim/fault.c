/* SPDX-License-Identifier: MIT */
#include "fault.h"

#include <math.h>

#include "schedule.h"

bool fault_is_active(const fault_t *fault, size_t index, double period) {
    return schedule_has_come(fault->start, index, period) &&
           !schedule_has_come(fault->start + fault->length, index, period);
}

double fault_last_cut(const fault_t *faults, size_t count) {
    double last = -1.0;
    for (size_t i = 0; i < count; ++i) {
        const bool is_cut = (faults[i].signal == FAULT_ON_PERIOD) && (faults[i].word == FAULT_OFF);
        last = is_cut ? fmax(last, faults[i].start) : last;
    }
    return last;
}
