/* SPDX-License-Identifier: MIT */
/*
 * fuzz_snapshot.c - a warm restart from any bytes in both slots: refused, and the controller is as it
 * was or to be initialised; or taken, and every step after it keeps its promises.
 *
 * Input: a byte for the running controller whose two snapshots lie in the slots (0x80: the changed
 * slots get a right CRC, as if somebody had written them on purpose); the periods it was down, four
 * bytes; then changes to the slots, three bytes each: where (little endian), and the byte that is
 * laid over by exclusive or.
 */
#include "fuzz_cases.h"
#include "fuzz_input.h"

#include "belt/snapshot.h"

#define CHANGES_MAX 8u
#define PERIODS 3u
#define SEALED 0x80u

static belt_config_t configs[FUZZ_CASE_COUNT];
static belt_snapshot_t kept[FUZZ_CASE_COUNT][2];

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    static belt_controller_t controller;
    belt_measurement_t measurement;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = BELT_HAS_LEVEL;
    for (unsigned i = 0; i < FUZZ_CASE_COUNT; ++i) {
        configs[i] = fuzz_case(i);
        FUZZ_CHECK(belt_init(&controller, &configs[i]) == BELT_OK);
        for (unsigned period = 0; period < 40u; ++period) {
            belt_command_t command;
            measurement.level = BELT_REAL(0.005) * (belt_real_t)period;
            (void)belt_step(&controller, &measurement, &command);
            belt_snapshot_take(&controller, kept[i]);
        }
    }
    return 0;
}

static void change(fuzz_input_t *input, belt_snapshot_t slots[2]) {
    for (unsigned i = 0; (i < CHANGES_MAX) && (input->left > 0); ++i) {
        const unsigned low = fuzz_byte(input);
        const size_t at = (low | (unsigned)fuzz_byte(input) << 8) % (2u * sizeof *slots);
        ((unsigned char *)slots)[at] =
            (unsigned char)(((unsigned char *)slots)[at] ^ fuzz_byte(input));
    }
}

static void run(belt_controller_t *controller) {
    belt_measurement_t measurement;
    memset(&measurement, 0, sizeof measurement);
    measurement.present = BELT_HAS_LEVEL;
    for (unsigned period = 0; period < PERIODS; ++period) {
        belt_command_t command;
        fuzz_spoil_command(&command);
        measurement.level = BELT_REAL(0.2);
        (void)belt_step(controller, &measurement, &command);
        fuzz_check_command(&command, controller->config.inlet_flux_max);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_input_t input = {data, size};
    const uint8_t start = fuzz_byte(&input);
    const unsigned index = start % FUZZ_CASE_COUNT;
    const uint32_t down = fuzz_word(&input);
    belt_snapshot_t slots[2];
    memcpy(slots, kept[index], sizeof slots);
    change(&input, slots);
    if ((start & SEALED) != 0u) {
        for (unsigned i = 0; i < 2u; ++i) {
            slots[i].crc = belt_snapshot_crc(0, &slots[i], offsetof(belt_snapshot_t, crc));
        }
    }

    static belt_controller_t controller;
    static belt_controller_t before;
    memcpy(&controller, &before, sizeof controller);
    const belt_status_t status = belt_snapshot_restore(&controller, &configs[index], slots, down);
    if (status == BELT_NO_SNAPSHOT) {
        belt_command_t command;
        belt_measurement_t measurement;
        memset(&measurement, 0, sizeof measurement);
        FUZZ_CHECK(belt_step(&controller, &measurement, &command) == BELT_MISUSE);
        return 0;
    }
    FUZZ_CHECK((status == BELT_OK) || (status == BELT_SNAPSHOT_OLD));
    run(&controller);
    return 0;
}
