/* SPDX-License-Identifier: MIT */
/*
 * flip.c - one bit flipped anywhere in the controller's memory: belt_flip COUNT SEED
 *
 * A closed loop is brought into many states; for each flip one of them is copied, one bit of the
 * controller is flipped, and the loop goes on for two transits of the belt. Required at every step:
 * the command is finite and within its limit, its change within the rate limit unless nothing is fed
 * because the memory is found corrupt, and the mode one of its words. After two transits the
 * command is back where it would have been without the flip (healed), or the status has said something
 * (said), or it is back some time later (late), or the flip is counted as silent: only the tables of
 * losses may be. Prints a table. Exit 0 all required held, 1 something did not, 2 the command line is wrong.
 *
 * Built with the capacities of types.h and the sanitizers: a crash or an index out of range ends it.
 */
#include <stdio.h>
#include <stdlib.h>

#include "../unit/paper_case.h"
#include "fields.h"
#include "small_line.h"

#define PERIOD 0.02
#define FLUX_MAX 3.0
#define FLUX_STEP 0.4 /* 20 parts/s^2 for a period */
#define STEPS 60u     /* two transits: a dead time at rest is 26.5 periods */
#define LATER 600u    /* so many periods more for what is late: 22 transits */
#define STATES 64u
#define STATE_EVERY 13u
#define LEVEL_RINGS_SHARE                                                                          \
    8u /* of eight flips one may hit the ring of levels, which is half of all */

typedef struct {
    belt_controller_t controller;
    small_line_t line;
    uint32_t period;
    belt_command_t reference[STEPS]; /* what follows without a flip */
    belt_status_t status[STEPS];
    belt_controller_t controller_after; /* and then */
    small_line_t line_after;
} prepared_t;

typedef enum { FOUND, HEALED, SAID, LATE, SILENT, OUTCOMES } outcome_t;

static prepared_t prepared[STATES];
static unsigned long table[FIELD_COUNT][OUTCOMES];
static unsigned long violations;

static uint64_t random_bits(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

static belt_config_t configuration(void) {
    belt_config_t config = paper_case();
    config.rework_rate = BELT_REAL(0); /* small_line.h has none */
    config.slope = BELT_REAL(5);
    config.period = BELT_REAL(PERIOD);
    config.inlet_flux_max = BELT_REAL(FLUX_MAX);
    config.estimator = BELT_ESTIMATOR_ON;
    config.flux_rate_max = BELT_REAL(FLUX_STEP / PERIOD);
    config.substitute_flux = BELT_REAL(0.6);
    return config;
}

/** Whether the sensor fails in this period: now and then, so that hold and substitute are seen. */
static bool is_blind(uint32_t period) {
    return (period % 300u) >= 270u;
}

static belt_status_t loop_step(belt_controller_t *controller, small_line_t *line, uint32_t period,
                               belt_command_t *command) {
    belt_measurement_t measurement;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = BELT_HAS_SAMPLE_COUNT | BELT_HAS_ELAPSED_TICKS;
    measurement.present |= is_blind(period) ? 0u : (uint32_t)BELT_HAS_LEVEL;
    measurement.level = (belt_real_t)small_line_level(line);
    measurement.sample_count = period;
    measurement.elapsed_ticks = (period % 97u == 0u) ? 3u : 1u;
    const belt_status_t status = belt_step(controller, &measurement, command);
    for (uint32_t i = 0; i < ((period % 97u == 96u) ? 3u : 1u); ++i) {
        small_line_advance(line, (double)command->inlet_flux);
    }
    return status;
}

/** The operator changes set-point and mode now and then. */
static belt_status_t operate(belt_controller_t *controller, uint32_t period) {
    if (period % 100u == 50u) {
        return belt_set_setpoint(controller, BELT_REAL((period % 200u == 50u) ? 0.45 : 0.3));
    }
    if (period % 250u == 155u) {
        return belt_set_mode(controller, BELT_MODE_MANUAL);
    }
    if (period % 500u == 175u) {
        return belt_set_mode(controller, BELT_MODE_OFF);
    }
    return (period % 250u == 190u) ? belt_set_mode(controller, BELT_MODE_AUTOMATIC) : BELT_OK;
}

/** What a state's future looks like, as this period shows it. */
static void note(prepared_t *state, uint32_t period, belt_status_t status,
                 const belt_command_t *command, const belt_controller_t *controller,
                 const small_line_t *line) {
    if ((state->period == 0u) || (period >= state->period + STEPS)) {
        return;
    }
    state->reference[period - state->period] = *command;
    state->status[period - state->period] = status;
    if (period + 1u == state->period + STEPS) {
        state->controller_after = *controller;
        state->line_after = *line;
    }
}

/** Every STATE_EVERY periods of one run is a state to start from, with the run that follows. */
static bool prepare(void) {
    static belt_controller_t controller;
    static small_line_t line;
    const belt_config_t config = configuration();
    belt_command_t command;
    if (belt_init(&controller, &config) != BELT_OK) {
        return false;
    }
    small_line_begin(&line, &config, 0.05);
    for (uint32_t period = 1; period <= STATES * STATE_EVERY + STEPS; ++period) {
        (void)operate(&controller, period);
        if ((period % STATE_EVERY == 0u) && (period / STATE_EVERY <= STATES)) {
            prepared_t *state = &prepared[period / STATE_EVERY - 1u];
            state->controller = controller;
            state->line = line;
            state->period = period;
        }
        const belt_status_t status = loop_step(&controller, &line, period, &command);
        for (uint32_t i = 0; i < STATES; ++i) {
            note(&prepared[i], period, status, &command, &controller, &line);
        }
    }
    return true;
}

/** Whether a step's answer is what must never be missing. */
static bool is_sound(const belt_command_t *command, belt_status_t status, double last) {
    const double flux = (double)command->inlet_flux;
    const bool is_stopped = (status == BELT_CORRUPT) || (status == BELT_MISUSE);
    /* Two roundings of a flux of up to 3. */
    const double step = FLUX_STEP + 4.0 * FLUX_MAX * (double)BELT_REAL_EPSILON;
    const bool is_within = (flux >= 0.0) && (flux <= FLUX_MAX);
    const bool is_gradual = is_stopped ? !(flux > 0.0) : (fabs(flux - last) <= step);
    return is_within && is_gradual && ((unsigned)command->mode < BELT_MODE_COUNT);
}

static void complain(const char *field, size_t byte, unsigned bit, uint32_t step, double last,
                     const belt_command_t *command, belt_status_t status) {
    if (++violations <= 20u) {
        printf("VIOLATION %s byte %zu bit %u step %u: flux %.9g after %.9g, mode %u, %s\n", field,
               byte, bit, (unsigned)step, (double)command->inlet_flux, last,
               (unsigned)command->mode, belt_status_name(status));
    }
}

/** A thousandth of the command, or of the law's greatest where the command is less. */
static bool is_back(double flux, double reference) {
    return fabs(flux - reference) <= 1e-3 * fmax(reference, 1.2);
}

/** Whether the command comes back later, beside a run without the flip. */
static bool is_back_later(const prepared_t *state, belt_controller_t *controller,
                          small_line_t *line) {
    static belt_controller_t twin;
    static small_line_t line_of_twin;
    belt_command_t command = {0};
    belt_command_t of_twin = {0};
    twin = state->controller_after;
    line_of_twin = state->line_after;
    for (uint32_t i = STEPS; i < STEPS + LATER; ++i) {
        if (operate(controller, state->period + i) == BELT_CORRUPT) {
            return true; /* found, when the operator's call read what had changed */
        }
        (void)operate(&twin, state->period + i);
        (void)loop_step(controller, line, state->period + i, &command);
        (void)loop_step(&twin, &line_of_twin, state->period + i, &of_twin);
    }
    return is_back((double)command.inlet_flux, (double)of_twin.inlet_flux);
}

/** One flip and what becomes of it. */
static outcome_t flip(const prepared_t *state, size_t byte, unsigned bit) {
    static belt_controller_t controller;
    static small_line_t line;
    controller = state->controller;
    line = state->line;
    double last = (double)controller.command.inlet_flux;
    unsigned char *bytes = (unsigned char *)&controller;
    bytes[byte] = (unsigned char)(bytes[byte] ^ (1u << bit));

    bool is_said = false;
    for (uint32_t i = 0; i < STEPS; ++i) {
        belt_command_t command;
        if ((i > 0u) && (operate(&controller, state->period + i) == BELT_CORRUPT)) {
            return FOUND;
        }
        const belt_status_t status = loop_step(&controller, &line, state->period + i, &command);
        if (!is_sound(&command, status, last)) {
            complain(fields[field_of(byte)].name, byte, bit, i, last, &command, status);
        }
        if ((status == BELT_CORRUPT) || (status == BELT_MISUSE)) {
            return FOUND;
        }
        last = (double)command.inlet_flux;
        is_said = is_said || (status != state->status[i]);
    }
    if (is_back(last, (double)state->reference[STEPS - 1u].inlet_flux)) {
        return HEALED;
    }
    const bool is_late = is_back_later(state, &controller, &line);
    return is_said ? SAID : (is_late ? LATE : SILENT);
}

/** The tables of losses and rework are not under the seal: a wrong loss is a wrong model, and stays one. */
static bool may_be_silent(size_t field) {
    return (fields[field].begin == offsetof(belt_controller_t, model.line.loss)) ||
           (fields[field].begin == offsetof(belt_controller_t, model.line.loss_sum)) ||
           (fields[field].begin == offsetof(belt_controller_t, model.line.rework));
}

static void print_table(unsigned long count) {
    unsigned long sum[OUTCOMES] = {0};
    printf("%-28s %9s %9s %9s %9s %9s %9s\n", "field", "flips", "found", "healed", "said", "late",
           "silent");
    for (size_t i = 0; i < FIELD_COUNT; ++i) {
        const unsigned long *row = table[i];
        printf("%-28s %9lu %9lu %9lu %9lu %9lu %9lu\n", fields[i].name,
               row[0] + row[1] + row[2] + row[3] + row[4], row[FOUND], row[HEALED], row[SAID],
               row[LATE], row[SILENT]);
        for (int k = 0; k < OUTCOMES; ++k) {
            sum[k] += row[k];
        }
        violations += may_be_silent(i) ? 0u : row[SILENT];
    }
    printf("flips %lu found %lu healed %lu said %lu late %lu silent %lu violations %lu\n", count,
           sum[FOUND], sum[HEALED], sum[SAID], sum[LATE], sum[SILENT], violations);
}

int main(int argument_count, char *argument[]) {
    const unsigned long count = (argument_count == 3) ? strtoul(argument[1], NULL, 10) : 0u;
    uint64_t random = (argument_count == 3) ? strtoull(argument[2], NULL, 10) : 0u;
    if ((count == 0u) || (random == 0u)) {
        fprintf(stderr, "usage: belt_flip COUNT SEED, neither of them 0\n");
        return 2;
    }
    if (!prepare()) {
        fprintf(stderr, "belt_flip: the configuration is refused\n");
        return 1;
    }
    for (unsigned long i = 0; i < count; ++i) {
        size_t byte;
        size_t field;
        do {
            byte = random_bits(&random) % sizeof(belt_controller_t);
            field = field_of(byte);
        } while ((fields[field].begin == offsetof(belt_controller_t, model.history.level)) &&
                 (random_bits(&random) % LEVEL_RINGS_SHARE != 0u));
        const unsigned bit = (unsigned)(random_bits(&random) % 8u);
        const prepared_t *state = &prepared[random_bits(&random) % STATES];
        ++table[field][flip(state, byte, bit)];
    }
    print_table(count);
    return (violations == 0u) ? 0 : 1;
}
