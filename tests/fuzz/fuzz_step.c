/* SPDX-License-Identifier: MIT */
/*
 * fuzz_step.c - belt_step() and what the operator can do between two steps: any bits on every input,
 * period after period.
 *
 * Input: a byte for the controller to start from (fresh, or with its window filled), then for each
 * of at most PERIODS_MAX periods a byte `action`, a byte `present`, and what these ask for.
 */
#include "fuzz_cases.h"
#include "fuzz_input.h"

#define PERIODS_MAX 6u
#define WARM_PERIODS 450u

/* action */
#define SETPOINT_CHANGES 0x80u
#define COUNTS_ARE_ANY 0x40u
#define PRESENT_IS_ANY 0x20u
#define OPERATOR_ACTS 0x10u
#define TICKS 0x0Cu
#define SAMPLES 0x03u

/* present: the bits of measurement.h, and */
#define NO_DENSITY_MEMORY 0x40u

static belt_controller_t prepared[2u * FUZZ_CASE_COUNT];
/* Of exactly node_count + 1 densities, so that the address sanitizer sees one read too many. */
static belt_real_t *density[FUZZ_CASE_COUNT];

/** The statuses that a step of a sound controller can have. */
static bool is_status_of_a_step(belt_status_t status) {
    return (status == BELT_OK) || (status == BELT_NO_LEVEL) || (status == BELT_INPUT_REJECTED) ||
           (status == BELT_PERIODS_MISSED) || (status == BELT_LINE_DEVIATES);
}

static void warm_up(belt_controller_t *controller) {
    belt_measurement_t measurement;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = BELT_HAS_LEVEL;
    for (unsigned period = 0; period < WARM_PERIODS; ++period) {
        belt_command_t command;
        measurement.level = BELT_REAL(0.3) * (belt_real_t)period / BELT_REAL(WARM_PERIODS);
        measurement.sample_count = period;
        measurement.elapsed_ticks = 1;
        FUZZ_CHECK(is_status_of_a_step(belt_step(controller, &measurement, &command)));
    }
}

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    for (unsigned i = 0; i < FUZZ_CASE_COUNT; ++i) {
        const belt_config_t config = fuzz_case(i);
        FUZZ_CHECK(belt_init(&prepared[2u * i], &config) == BELT_OK);
        prepared[2u * i + 1u] = prepared[2u * i];
        warm_up(&prepared[2u * i + 1u]);
        density[i] = calloc(config.node_count + 1u, sizeof *density[i]);
        FUZZ_CHECK(density[i] != NULL);
    }
    return 0;
}

/** A profile of two numbers in turn. */
static const belt_real_t *profile(fuzz_input_t *input, const belt_controller_t *controller,
                                  belt_real_t *memory) {
    const belt_real_t even = fuzz_real(input, BELT_REAL(1));
    const belt_real_t odd = fuzz_real(input, BELT_REAL(1));
    for (uint32_t i = 0; i <= controller->model.line.node_count; ++i) {
        memory[i] = ((i & 1u) == 0u) ? even : odd;
    }
    return memory;
}

static void change_setpoint(fuzz_input_t *input, belt_controller_t *controller) {
    const belt_real_t before = controller->config.level_setpoint;
    const belt_real_t wanted = fuzz_real(input, BELT_REAL(0.6));
    const bool is_taken = belt_set_setpoint(controller, wanted) == BELT_OK;
    const belt_real_t expected = is_taken ? wanted : before;
    FUZZ_CHECK(memcmp(&controller->config.level_setpoint, &expected, sizeof expected) == 0);
}

/** A mode, known or not, or a flux for manual. */
static void operate(fuzz_input_t *input, belt_controller_t *controller) {
    const uint8_t wish = fuzz_byte(input);
    const belt_mode_t before = controller->supervisor.requested;
    if ((wish & 0x80u) == 0u) {
        const belt_mode_t mode = (belt_mode_t)(wish % 8u);
        const bool is_known =
            (mode == BELT_MODE_OFF) || (mode == BELT_MODE_MANUAL) || (mode == BELT_MODE_AUTOMATIC);
        FUZZ_CHECK(belt_set_mode(controller, mode) == (is_known ? BELT_OK : BELT_UNKNOWN_MODE));
        FUZZ_CHECK(controller->supervisor.requested == (is_known ? mode : before));
        return;
    }
    const belt_real_t flux = fuzz_real(input, BELT_REAL(2));
    const bool is_sound = (flux >= BELT_REAL(0)) && (flux <= controller->limits.inlet_flux_max);
    const belt_status_t expected = (before != BELT_MODE_MANUAL) ? BELT_NOT_MANUAL
                                   : is_sound                   ? BELT_OK
                                                                : BELT_MANUAL_FLUX;
    FUZZ_CHECK(belt_set_manual_flux(controller, flux) == expected);
}

static void one_period(fuzz_input_t *input, belt_controller_t *controller, belt_real_t *memory) {
    const uint8_t action = fuzz_byte(input);
    belt_measurement_t measurement;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = fuzz_byte(input);
    if ((action & PRESENT_IS_ANY) != 0u) {
        measurement.present = fuzz_word(input);
    }
    if ((action & SETPOINT_CHANGES) != 0u) {
        change_setpoint(input, controller);
    }
    if ((action & OPERATOR_ACTS) != 0u) {
        operate(input, controller);
    }
    measurement.sample_count = action & SAMPLES;
    measurement.elapsed_ticks = (action & TICKS) / 4u;
    if ((action & COUNTS_ARE_ANY) != 0u) {
        measurement.sample_count = fuzz_word(input);
        measurement.elapsed_ticks = fuzz_word(input);
    }
    measurement.level = fuzz_real(input, controller->config.level_capacity);
    if ((measurement.present & BELT_HAS_OUTLET_FLUX) != 0u) {
        measurement.outlet_flux = fuzz_real(input, BELT_REAL(2));
    }
    if ((measurement.present & BELT_HAS_APPLIED_FLUX) != 0u) {
        measurement.applied_flux = fuzz_real(input, BELT_REAL(2));
    }
    if ((measurement.present & (BELT_HAS_DENSITY | NO_DENSITY_MEMORY)) == BELT_HAS_DENSITY) {
        measurement.density = profile(input, controller, memory);
    }

    const belt_real_t before = controller->command.inlet_flux;
    belt_command_t command;
    fuzz_spoil_command(&command);
    FUZZ_CHECK(is_status_of_a_step(belt_step(controller, &measurement, &command)));
    fuzz_check_command(&command, controller->config.inlet_flux_max);
    const belt_real_t change = command.inlet_flux - before;
    const belt_real_t step_max = controller->limits.flux_step_max * BELT_REAL(1.00001);
    FUZZ_CHECK((change <= step_max) && (change >= -step_max));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_input_t input = {data, size};
    const unsigned start = fuzz_byte(&input) % (2u * FUZZ_CASE_COUNT);
    static belt_controller_t controller;
    controller = prepared[start];
    for (unsigned period = 0; (period < PERIODS_MAX) && (input.left > 0); ++period) {
        one_period(&input, &controller, density[start / 2u]);
    }
    fuzz_check_controller(&controller);
    return 0;
}
