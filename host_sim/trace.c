/* SPDX-License-Identifier: MIT */
#include "trace.h"

#include <math.h>

/* Names and members stand side by side: a column cannot come under another's name. */
static const struct {
    const char *name;
    size_t offset;
} COLUMNS[] = {
    {"time", offsetof(loop_row_t, time)},
    {"buffer_level", offsetof(loop_row_t, buffer_level)},
    {"level_setpoint", offsetof(loop_row_t, level_setpoint)},
    {"inlet_flux", offsetof(loop_row_t, inlet_flux)},
    {"outlet_flux", offsetof(loop_row_t, outlet_flux)},
    {"congestion", offsetof(loop_row_t, congestion)},
    {"transport_speed", offsetof(loop_row_t, transport_speed)},
    {"predicted_level", offsetof(loop_row_t, predicted_level)},
    {"arrival_time", offsetof(loop_row_t, arrival_time)},
    {"survival", offsetof(loop_row_t, survival)},
    {"level_measured", offsetof(loop_row_t, level_measured)},
    {"applied_flux", offsetof(loop_row_t, applied_flux)},
    {"disturbance", offsetof(loop_row_t, disturbance)},
    {"mode", offsetof(loop_row_t, mode)},
    {"error_bits", offsetof(loop_row_t, error_bits)},
    {"level_estimate", offsetof(loop_row_t, level_estimate)},
    {"level_quality", offsetof(loop_row_t, level_quality)},
    {"observer_error", offsetof(loop_row_t, observer_error)},
};

#define COLUMN_COUNT (sizeof COLUMNS / sizeof COLUMNS[0])

bool trace_write_header(FILE *file) {
    bool is_written = true;
    for (size_t column = 0; column < COLUMN_COUNT; column++) {
        const char *const comma = column > 0 ? "," : "";
        is_written = fprintf(file, "%s%s", comma, COLUMNS[column].name) > 0 && is_written;
    }
    return fputc('\n', file) != EOF && is_written;
}

bool trace_write_row(FILE *file, const loop_row_t *row) {
    bool is_written = true;
    for (size_t column = 0; column < COLUMN_COUNT; column++) {
        const char *const member = (const char *)row + COLUMNS[column].offset;
        const double value = *(const double *)(const void *)member;
        const double shown =
            isnan(value) ? fabs(value) : value; /* the sign of a NaN says nothing */
        is_written = fprintf(file, "%s%.17g", column > 0 ? "," : "", shown) > 0 && is_written;
    }
    return fputc('\n', file) != EOF && is_written;
}

bool density_write_header(FILE *file, double length, size_t count) {
    bool is_written = fputs("time", file) != EOF;
    for (size_t index = 0; index < count; index++) {
        const double place = length * (double)index / (double)(count - 1);
        is_written = fprintf(file, ",%.17g", place) > 0 && is_written;
    }
    return fputc('\n', file) != EOF && is_written;
}

bool density_write_row(FILE *file, double time, const double *density, size_t count) {
    bool is_written = fprintf(file, "%.17g", time) > 0;
    for (size_t index = 0; index < count; index++) {
        is_written = fprintf(file, ",%.17g", density[index]) > 0 && is_written;
    }
    return fputc('\n', file) != EOF && is_written;
}
