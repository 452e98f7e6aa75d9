/* SPDX-License-Identifier: MIT */
/*
 * schedule.h - what changes at stated times, and when a time has come.
 *
 * Everything changes at the start of a period: the first that starts at or after the stated time.
 */
#ifndef HOST_SIM_SCHEDULE_H
#define HOST_SIM_SCHEDULE_H

#include <stdbool.h>
#include <stddef.h>

#include "line.h"

/** Ascending times, and the value from each on. */
typedef struct {
    double times[LIST_CAPACITY]; /**< [s]. */
    double values[LIST_CAPACITY];
    size_t count;
} schedule_t;

/** Whether period `index` starts at or after `time`. A time is often a multiple of the period but for
 * rounding: a millionth of a period early is on time. */
bool schedule_has_come(double time, size_t index, double period);

/** How many of `count` ascending times have come when period `index` starts, `done` of them before. */
size_t schedule_come(const double *times, size_t count, size_t done, size_t index, double period);

/** Whole periods that cover `duration`, at least one. */
size_t schedule_periods(double duration, double period);

#endif
