/* SPDX-License-Identifier: MIT */
/*
 * fuzz_config.c - any bytes as a configuration: refused, and the controller is as it was; or taken,
 * and every step after it keeps its promises.
 *
 * Input: a byte for the sound configuration to start from, then changes to it until they are used up:
 *   0x00 ... 0x7F  a field (modulo their number) is multiplied by 2^((next byte - 128)/16)
 *   0x80 ... 0xBF  a field is set to any number
 *   0xC0 ... 0xDF  four bytes at any place are exchanged: node_count, loss_count, words, padding
 *   0xE0 ... 0xFF  all that is left is laid over the whole configuration, by exclusive or
 */
#include "fuzz_cases.h"
#include "fuzz_input.h"

#define CHANGES_MAX 12u
#define PERIODS 4u

static const size_t fields[] = {
    offsetof(belt_config_t, belt_length),      offsetof(belt_config_t, processing_time),
    offsetof(belt_config_t, speed_window),     offsetof(belt_config_t, congestion_scale),
    offsetof(belt_config_t, connectivity),     offsetof(belt_config_t, service_rate_max),
    offsetof(belt_config_t, service_time),     offsetof(belt_config_t, level_capacity),
    offsetof(belt_config_t, rework_rate),      offsetof(belt_config_t, loss_rate[0]),
    offsetof(belt_config_t, loss_rate[1]),     offsetof(belt_config_t, level_setpoint),
    offsetof(belt_config_t, nominal_flux_max), offsetof(belt_config_t, slope),
    offsetof(belt_config_t, period),           offsetof(belt_config_t, inlet_flux_max),
    offsetof(belt_config_t, estimator_time),   offsetof(belt_config_t, flux_rate_max),
    offsetof(belt_config_t, substitute_flux),  offsetof(belt_config_t, level_step_max),
    offsetof(belt_config_t, transfer_time),
};

/** 2^(sixteenths/16), near enough. */
static belt_real_t power(int sixteenths) {
    const belt_real_t sixteenth = BELT_REAL(1.0442737824274138);
    const belt_real_t factor = (sixteenths < 0) ? BELT_REAL(1) / sixteenth : sixteenth;
    belt_real_t result = BELT_REAL(1);
    for (int i = (sixteenths < 0) ? -sixteenths : sixteenths; i > 0; --i) {
        result *= factor;
    }
    return result;
}

static void change_field(fuzz_input_t *input, belt_config_t *config, uint8_t kind) {
    unsigned char *const memory =
        (unsigned char *)config + fields[kind % (sizeof fields / sizeof fields[0])];
    belt_real_t value;
    memcpy(&value, memory, sizeof value);
    if (kind < 0x80u) {
        value *= power((int)fuzz_byte(input) - 128);
    } else {
        value = fuzz_real(input, BELT_REAL(1));
    }
    memcpy(memory, &value, sizeof value);
}

static void exchange_bytes(fuzz_input_t *input, belt_config_t *config) {
    uint8_t bytes[4];
    const size_t at =
        (size_t)(fuzz_byte(input) | fuzz_byte(input) << 8) % (sizeof *config - sizeof bytes + 1u);
    fuzz_bytes(input, bytes, sizeof bytes);
    memcpy((unsigned char *)config + at, bytes, sizeof bytes);
}

static void lay_over(fuzz_input_t *input, belt_config_t *config) {
    unsigned char *const memory = (unsigned char *)config;
    for (size_t i = 0; (i < sizeof *config) && (input->left > 0); ++i) {
        memory[i] = (unsigned char)(memory[i] ^ fuzz_byte(input));
    }
    input->left = 0;
}

static void change(fuzz_input_t *input, belt_config_t *config) {
    for (unsigned i = 0; (i < CHANGES_MAX) && (input->left > 0); ++i) {
        const uint8_t kind = fuzz_byte(input);
        if (kind < 0xC0u) {
            change_field(input, config, kind);
        } else if (kind < 0xE0u) {
            exchange_bytes(input, config);
        } else {
            lay_over(input, config);
        }
    }
}

/** The mask, the first broken rule and each rule by itself say the same. */
static belt_status_t check(const belt_config_t *config) {
    uint64_t broken = ~(uint64_t)0;
    const belt_status_t status = belt_config_check(config, &broken);
    FUZZ_CHECK((status == BELT_OK) == (broken == 0u));
    if (status != BELT_OK) {
        FUZZ_CHECK((status >= BELT_RULE_FIRST) && (status <= BELT_RULE_LAST));
        FUZZ_CHECK((broken & BELT_RULE_BIT(status)) != 0u);
        FUZZ_CHECK((broken & (BELT_RULE_BIT(status) - 1u)) == 0u);
        const belt_rule_t rule = belt_config_rule(config, status);
        FUZZ_CHECK(!belt_rule_holds(&rule));
    }
    return status;
}

static void run(belt_controller_t *controller) {
    const belt_real_t capacity = controller->config.level_capacity;
    belt_measurement_t measurement;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = BELT_HAS_LEVEL;
    for (unsigned period = 0; period < PERIODS; ++period) {
        belt_command_t command;
        fuzz_spoil_command(&command);
        measurement.level = capacity * (belt_real_t)period / BELT_REAL(PERIODS - 1u);
        measurement.sample_count = period;
        measurement.elapsed_ticks = 1;
        const belt_status_t status = belt_step(controller, &measurement, &command);
        FUZZ_CHECK((status == BELT_OK) || (status == BELT_INPUT_REJECTED) ||
                   (status == BELT_LINE_DEVIATES));
        fuzz_check_command(&command, controller->config.inlet_flux_max);
    }
    fuzz_check_controller(controller);
}

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    for (unsigned i = 0; i < FUZZ_CASE_COUNT; ++i) {
        const belt_config_t config = fuzz_case(i);
        FUZZ_CHECK(belt_config_check(&config, NULL) == BELT_OK);
    }
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_input_t input = {data, size};
    belt_config_t config = fuzz_case(fuzz_byte(&input) % FUZZ_CASE_COUNT);
    change(&input, &config);

    static belt_controller_t controller;
    static belt_controller_t before;
    if (before.state == 0u) {
        memset(&before, 0x5A, sizeof before);
        controller = before;
    }
    const belt_status_t status = check(&config);
    FUZZ_CHECK(belt_init(&controller, &config) == status);
    if (status != BELT_OK) {
        FUZZ_CHECK(memcmp(&controller, &before, sizeof controller) == 0);
        return 0;
    }
    FUZZ_CHECK(memcmp(&controller.config, &config, sizeof config) == 0);
    run(&controller);
    memcpy(&controller, &before, sizeof controller);
    return 0;
}
