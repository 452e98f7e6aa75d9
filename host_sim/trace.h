/* SPDX-License-Identifier: MIT */
/*
 * trace.h - the rows of a run as CSV: %.17g, so that a double comes back as it was; LF line ends.
 */
#ifndef HOST_SIM_TRACE_H
#define HOST_SIM_TRACE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "loop.h"

/** Writes the names of the columns. Each function returns false when writing failed, errno says why. */
bool trace_write_header(FILE *file);

/** Writes one row of the trace. */
bool trace_write_row(FILE *file, const loop_row_t *row);

/** Writes `time` and the places of `count` >= 2 densities, equally spaced from 0 to `length` [m]. */
bool density_write_header(FILE *file, double length, size_t count);

/** Writes the densities of one period. */
bool density_write_row(FILE *file, double time, const double *density, size_t count);

#endif
