/* SPDX-License-Identifier: MIT */
/*
 * mismatch.c - the controller on a line that is not its model: belt_mismatch LINE COUNT SEED [FIRST]
 *
 * LINE is a scenario. For each of COUNT cases, FIRST and those behind it, every number of the plant's
 * line (P, D, alpha, C, A, tau, mu) is its model's times a factor of its own, uniform in 0.8 ... 1.2; a
 * case hangs on seed and index alone. Estimator on, 25 s from the scenario's start. A row each:
 *     index P D alpha C A tau mu final_error swing top spilled
 * the factors; |level - set-point| at the end [parts]; greatest less least level in the last 5 s
 * [parts]; greatest level [parts]; parts spilled. Exit 0 done, 1 a run failed, 2 the command line or
 * the scenario is wrong.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "loop.h"
#include "scenario_file.h"

#define FACTORS 7u
#define SPREAD 0.2
#define DURATION 25.0
#define TAIL 5.0

typedef struct {
    double least;
    double greatest;
    double top;
    double final_error;
} found_t;

/** splitmix64 (Steele, Lea, Flood): any two indices are as good as unrelated. */
static uint64_t mixed(uint64_t state) {
    state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9u;
    state = (state ^ (state >> 27)) * 0x94D049BB133111EBu;
    return state ^ (state >> 31);
}

static double factor(uint64_t seed, uint64_t index, uint64_t which) {
    const uint64_t bits = mixed(mixed(seed) + (index * FACTORS + which + 1u) * 0x9E3779B97F4A7C15u);
    return 1.0 + SPREAD * (2.0 * (double)(bits >> 11) / 9007199254740992.0 - 1.0);
}

static bool take(void *context, const loop_row_t *row, const double *density, size_t count) {
    found_t *found = context;
    (void)density;
    (void)count;
    found->top = fmax(found->top, row->buffer_level);
    found->final_error = fabs(row->buffer_level - row->level_setpoint);
    if (row->time >= DURATION - TAIL) {
        found->least = fmin(found->least, row->buffer_level);
        found->greatest = fmax(found->greatest, row->buffer_level);
    }
    return true;
}

static bool run(const scenario_t *model, uint64_t seed, uint64_t index) {
    static scenario_t scenario;
    double share[FACTORS];
    scenario = *model;
    line_t *line = &scenario.plant.line;
    double *const number[FACTORS] = {&line->processing_time, &line->belt_length,
                                     &line->connectivity,    &line->loss_rate.value[0],
                                     &line->rework_rate,     &line->speed_window,
                                     &line->service_rate_max};
    printf("%llu", (unsigned long long)index);
    for (size_t i = 0; i < FACTORS; ++i) {
        share[i] = factor(seed, index, i);
        *number[i] *= share[i];
        printf(" %.6f", share[i]);
    }
    found_t found = {(double)INFINITY, -(double)INFINITY, 0.0, 0.0};
    const loop_sink_t sink = {&found, false, false, take};
    loop_totals_t totals = {0};
    const loop_status_t status = loop_run(&scenario, &sink, stderr, &totals);
    printf(" %.6g %.6g %.6g %.6g\n", found.final_error, found.greatest - found.least, found.top,
           totals.spilled);
    return status == LOOP_DONE;
}

int main(int argument_count, char *argument[]) {
    const char *const settings[] = {"controller.estimator=on", "run.duration=25"};
    const scenario_settings_t given = {.text = settings, .count = 2};
    static scenario_t scenario;
    if ((argument_count < 4) || (argument_count > 5)) {
        fprintf(stderr, "usage: belt_mismatch LINE COUNT SEED [FIRST]\n");
        return 2;
    }
    if (!scenario_file_read(argument[1], &given, &scenario, stderr)) {
        return 2;
    }
    const uint64_t count = strtoull(argument[2], NULL, 10);
    const uint64_t seed = strtoull(argument[3], NULL, 10);
    const uint64_t first = (argument_count == 5) ? strtoull(argument[4], NULL, 10) : 0u;
    bool is_well = true;
    for (uint64_t i = first; i < first + count; ++i) {
        is_well = run(&scenario, seed, i) && is_well;
    }
    return (is_well && (fflush(stdout) == 0)) ? 0 : 1;
}
