/* SPDX-License-Identifier: MIT */
#include "summary.h"

#include <math.h>
#include <string.h>

void summary_begin(summary_t *summary) {
    memset(summary, 0, sizeof *summary);
}

static void start_anew(summary_t *summary, const loop_row_t *row) {
    summary->is_settled = false;
    summary->overshoot = 0.0;
    summary->change_time = row->time;
    summary->change_level = row->buffer_level;
}

static void take_interval(summary_t *summary, const loop_row_t *row) {
    const loop_row_t *const last = &summary->last;
    /* The set-point of the interval is the one at its start: a change takes effect at `row`. */
    const double error_before = fabs(last->buffer_level - last->level_setpoint);
    const double error_after = fabs(row->buffer_level - last->level_setpoint);
    summary->iae += 0.5 * (error_before + error_after) * (row->time - last->time);
    summary->inlet_flux_variation += fabs(row->inlet_flux - last->inlet_flux);
}

static void take_level(summary_t *summary, const loop_row_t *row) {
    const double error = row->buffer_level - row->level_setpoint;
    const bool is_within = fabs(error) <= SUMMARY_BAND * fabs(row->level_setpoint);
    if (is_within && !summary->is_settled) {
        summary->settled_from = row->time;
        summary->settling_time = row->time - summary->change_time;
    }
    summary->is_settled = is_within;
    const double beyond = summary->change_level > row->level_setpoint ? -error : error;
    const double size = fabs(row->level_setpoint);
    /* No share of a set-point of 0. */
    summary->overshoot = size > 0.0 ? fmax(summary->overshoot, beyond / size) : (double)NAN;
    summary->final_error = error;
}

static void take_answer(summary_t *summary, const loop_row_t *row) {
    const size_t mode = (size_t)row->mode;
    summary->error_bits |= (uint32_t)row->error_bits;
    if (mode < SUMMARY_MODES) {
        summary->mode_rows[mode]++;
    }
}

void summary_take(summary_t *summary, const loop_row_t *row) {
    const bool is_first = summary->row_count == 0;
    /* Set-points are copied, never computed: a change is any difference. */
    const double step = is_first ? 0.0 : row->level_setpoint - summary->last.level_setpoint;
    if (is_first || step > 0.0 || step < 0.0) {
        start_anew(summary, row);
    }
    if (is_first) {
        summary->inlet_flux_peak = row->inlet_flux;
        summary->level_peak = row->buffer_level;
    } else {
        take_interval(summary, row);
    }
    summary->inlet_flux_peak = fmax(summary->inlet_flux_peak, row->inlet_flux);
    summary->level_peak = fmax(summary->level_peak, row->buffer_level);
    take_level(summary, row);
    take_answer(summary, row);
    summary->last = *row;
    summary->row_count++;
}

/* JSON has no word for infinity or NaN. */
static bool write_figure(FILE *file, const char *name, bool has_value, double value) {
    return has_value && isfinite(value) ? fprintf(file, "  \"%s\": %.17g,\n", name, value) > 0
                                        : fprintf(file, "  \"%s\": null,\n", name) > 0;
}

static bool write_modes(const summary_t *summary, FILE *file) {
    static const char *const names[SUMMARY_MODES] = {"off", "manual", "automatic", "hold",
                                                     "substitute"};
    bool is_written = true;
    for (size_t mode = 0; mode < SUMMARY_MODES; mode++) {
        is_written = fprintf(file, "%s  \"rows_%s\": %zu", mode > 0 ? ",\n" : "", names[mode],
                             summary->mode_rows[mode]) > 0 &&
                     is_written;
    }
    return is_written;
}

bool summary_write(const summary_t *summary, const loop_totals_t *totals, FILE *file) {
    const struct {
        const char *name;
        bool has_value;
        double value;
    } figures[] = {
        {"settling_time", summary->is_settled, summary->settling_time},
        {"overshoot", true, summary->overshoot},
        {"iae", true, summary->iae},
        {"inlet_flux_peak", true, summary->inlet_flux_peak},
        {"inlet_flux_variation", true, summary->inlet_flux_variation},
        {"final_error", true, summary->final_error},
        {"spilled", true, totals->spilled},
        {"balance_error", true, totals->balance_error},
    };
    bool is_written = fputs("{\n", file) != EOF;
    for (size_t index = 0; index < sizeof figures / sizeof figures[0]; index++) {
        is_written = write_figure(file, figures[index].name, figures[index].has_value,
                                  figures[index].value) &&
                     is_written;
    }
    return fprintf(file, "  \"steps\": %zu,\n", totals->steps) > 0 &&
           write_figure(file, "level_peak", true, summary->level_peak) &&
           write_figure(file, "disturbed", true, totals->disturbed) &&
           fprintf(file, "  \"error_bits\": %lu,\n", (unsigned long)summary->error_bits) > 0 &&
           write_modes(summary, file) && fputs("\n}\n", file) != EOF && is_written;
}
