/* SPDX-License-Identifier: MIT */
#include "schedule.h"

#include <math.h>

#define EARLY 1e-6 /* of a period */

bool schedule_has_come(double time, size_t index, double period) {
    return (double)index >= time / period - EARLY;
}

size_t schedule_come(const double *times, size_t count, size_t done, size_t index, double period) {
    while ((done < count) && schedule_has_come(times[done], index, period)) {
        ++done;
    }
    return done;
}

size_t schedule_periods(double duration, double period) {
    return (size_t)fmax(ceil(duration / period - EARLY), 1.0);
}
