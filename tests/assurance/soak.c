/* SPDX-License-Identifier: MIT */
/*
 * soak.c - a long time at rest: belt_soak STEPS
 *
 * The paper's line in a loop with a small line (small_line.h), estimator on. Three claims:
 *   rest     at the set-point nothing drifts: least and greatest level, command, disturbance,
 *            congestion and density of every cell are the same in the first and the last STRETCH
 *            steps, to WANDER of their size;
 *   wrap     a controller whose sample count wraps goes on with the same bits as one whose does not;
 *   nominal  set-points that change, a noisy sensor and every input present raise no alarm: BELT_OK
 *            at every step.
 * STEPS steps each. Exit 0 all hold, 1 one does not, 2 the command line is wrong.
 */
#include <stdio.h>
#include <stdlib.h>

#include "../unit/paper_case.h"
#include "small_line.h"

#define SETTLING 200000u
#define STRETCH 100000u
/* What the bounds of a quantity may differ in, of its size: roundings of float32 that come together
 * another way; 3e-6 was measured over 1e6, 2e7 and 1e8 steps. A drift of one rounding in a hundred
 * steps is six hundred roundings, 4e-5, after the shortest soak that ctest makes. */
#define WANDER 2e-5
#define QUANTITIES (BELT_CELL_CAPACITY + 5u)

typedef struct {
    double least[QUANTITIES];
    double greatest[QUANTITIES];
} bounds_t;

typedef struct {
    belt_controller_t controller;
    uint32_t sample_count;
} counted_t;

static small_line_t line;
static counted_t from_zero;
static counted_t wrapping;
static bounds_t first_stretch;
static bounds_t last_stretch;

static belt_config_t configuration(void) {
    belt_config_t config = paper_case();
    config.rework_rate = BELT_REAL(0); /* small_line.h has none */
    config.estimator = BELT_ESTIMATOR_ON;
    return config;
}

static void clear(bounds_t *bounds) {
    for (size_t i = 0; i < QUANTITIES; ++i) {
        bounds->least[i] = (double)INFINITY;
        bounds->greatest[i] = -(double)INFINITY;
    }
}

static void widen(bounds_t *bounds, size_t index, double value) {
    bounds->least[index] = fmin(bounds->least[index], value);
    bounds->greatest[index] = fmax(bounds->greatest[index], value);
}

static void widen_all(bounds_t *bounds) {
    const belt_controller_t *controller = &from_zero.controller;
    widen(bounds, 0, small_line_level(&line));
    widen(bounds, 1, (double)controller->command.inlet_flux);
    widen(bounds, 2, (double)controller->model.present.congestion);
    widen(bounds, 3,
          1.0 + (double)controller->model.estimator.disturbance); /* beside a flux of about 1 */
    widen(bounds, 4, (double)controller->model.estimator.level);
    for (size_t i = 0; i < controller->model.line.cell_slots; ++i) {
        widen(bounds, 5u + i, (double)controller->model.observer.density[i]);
    }
}

/** How much further or less far a quantity ranges at the end, of its size. */
static double wander(void) {
    double worst = 0.0;
    for (size_t i = 0; i < 5u + from_zero.controller.model.line.cell_slots; ++i) {
        const double size = fmax(fabs(first_stretch.greatest[i]), 1e-3);
        worst = fmax(worst, fabs(first_stretch.least[i] - last_stretch.least[i]) / size);
        worst = fmax(worst, fabs(first_stretch.greatest[i] - last_stretch.greatest[i]) / size);
    }
    return worst;
}

static belt_status_t counted_step(counted_t *counted, double level, belt_command_t *command) {
    belt_measurement_t measurement;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_SAMPLE_COUNT | BELT_HAS_ELAPSED_TICKS;
    measurement.level = (belt_real_t)level;
    measurement.sample_count = counted->sample_count++;
    measurement.elapsed_ticks = 1;
    return belt_step(&counted->controller, &measurement, command);
}

/** One step of the loop with both controllers; false if they differ or one complains. */
static bool twin_step(void) {
    belt_command_t command;
    belt_command_t of_wrapping;
    const double level = small_line_level(&line);
    const bool is_well = (counted_step(&from_zero, level, &command) == BELT_OK) &&
                         (counted_step(&wrapping, level, &of_wrapping) == BELT_OK);
    small_line_advance(&line, (double)command.inlet_flux);
    return is_well &&
           (memcmp(&command.inlet_flux, &of_wrapping.inlet_flux, sizeof command.inlet_flux) == 0);
}

/** Whether the twins know the same, the count of the last sample apart. */
static bool twins_agree(void) {
    static belt_controller_t counted_alike;
    counted_alike = wrapping.controller;
    counted_alike.gate.sample_count = from_zero.controller.gate.sample_count;
    return memcmp(&counted_alike, &from_zero.controller, sizeof counted_alike) == 0;
}

static bool rest(unsigned long steps) {
    const belt_config_t config = configuration();
    if (belt_init(&from_zero.controller, &config) != BELT_OK) {
        return false;
    }
    wrapping.controller = from_zero.controller;
    wrapping.sample_count = UINT32_MAX - SETTLING / 2u;
    small_line_begin(&line, &config, 0.3);
    bool is_same = true;
    clear(&first_stretch);
    clear(&last_stretch);
    for (unsigned long i = 0; i < SETTLING; ++i) {
        is_same = twin_step() && is_same;
    }
    for (unsigned long i = 0; i < steps; ++i) {
        is_same = twin_step() && is_same;
        if (i < STRETCH) {
            widen_all(&first_stretch);
        }
        if (i + STRETCH >= steps) {
            widen_all(&last_stretch);
        }
    }
    is_same = twins_agree() && is_same;
    const double worst = wander();
    printf("rest: %lu steps, level %.9g ... %.9g, command %.9g ... %.9g, wander %.2g\n", steps,
           last_stretch.least[0], last_stretch.greatest[0], last_stretch.least[1],
           last_stretch.greatest[1], worst);
    printf("wrap: %s\n", is_same ? "the same bits" : "DIFFERS");
    return is_same && (worst <= WANDER);
}

/** Uniform in [-1, 1) (xorshift64). */
static double noise(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)(*state >> 11) / 4503599627370496.0 - 1.0;
}

static bool nominal(unsigned long steps) {
    const belt_config_t config = configuration();
    belt_controller_t *controller = &from_zero.controller;
    belt_command_t command;
    memset(&command, 0, sizeof command);
    uint64_t random = 88172645463325252u;
    unsigned long alarms = 0;
    if (belt_init(controller, &config) != BELT_OK) {
        return false;
    }
    small_line_begin(&line, &config, 0.0);
    for (unsigned long i = 0; i < steps; ++i) {
        belt_measurement_t measurement;
        memset(&measurement, 0, sizeof measurement);
        measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX | BELT_HAS_OUTLET_FLUX |
                              BELT_HAS_SAMPLE_COUNT | BELT_HAS_ELAPSED_TICKS;
        measurement.level = (belt_real_t)fmax(0.0, small_line_level(&line) + 0.01 * noise(&random));
        measurement.applied_flux = command.inlet_flux;
        measurement.outlet_flux = (belt_real_t)line.outlet_flux;
        measurement.sample_count = (uint32_t)i;
        measurement.elapsed_ticks = 1;
        if (i % 4000u == 3999u) {
            const double setpoint = 0.3 + 0.15 * noise(&random);
            alarms += (belt_set_setpoint(controller, (belt_real_t)setpoint) == BELT_OK) ? 0u : 1u;
        }
        alarms += (belt_step(controller, &measurement, &command) == BELT_OK) ? 0u : 1u;
        small_line_advance(&line, (double)command.inlet_flux);
    }
    printf("nominal: %lu steps, %lu alarms, level %.3g\n", steps, alarms, small_line_level(&line));
    return alarms == 0u;
}

int main(int argument_count, char *argument[]) {
    const unsigned long steps = (argument_count == 2) ? strtoul(argument[1], NULL, 10) : 0u;
    if (steps < 2u * STRETCH) {
        fprintf(stderr, "usage: belt_soak STEPS, at least %u\n", 2u * STRETCH);
        return 2;
    }
    const bool is_at_rest = rest(steps);
    const bool is_quiet = nominal(steps);
    return (is_at_rest && is_quiet) ? 0 : 1;
}
