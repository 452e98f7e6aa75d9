/* SPDX-License-Identifier: MIT */
/*
 * fuzz_scenario.c - the scenario reader on any text. What it takes is translated for the controller
 * and held against every rule, as the command `check` does.
 *
 * Input: when the first byte is NUL, what stands up to the next NUL is a setting; when the next one is 1,
 * what stands up to a NUL is a fault; the rest is text.
 */
#include "fuzz_cases.h"
#include "fuzz_input.h"

#include "model.h"
#include "scenario.h"

#define SETTING_MAX 200u

static FILE *messages;

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    messages = fopen("/dev/null", "w");
    FUZZ_CHECK(messages != NULL);
    return 0;
}

/** Takes what `mark` begins off the front of the input, as a string. */
static bool take(fuzz_input_t *input, uint8_t mark, char setting[SETTING_MAX + 1u]) {
    if ((input->left == 0) || (*input->next != mark)) {
        return false;
    }
    (void)fuzz_byte(input);
    size_t length = 0;
    for (uint8_t byte = fuzz_byte(input); byte != 0u; byte = fuzz_byte(input)) {
        if (length < SETTING_MAX) {
            setting[length] = (char)byte;
            ++length;
        }
    }
    setting[length] = '\0';
    return true;
}

static void check_taken(const scenario_t *scenario) {
    FUZZ_CHECK(scenario->name != NULL);
    FUZZ_CHECK((scenario->run.fault_count <= FAULT_CAPACITY) && (scenario->run.duration > 0.0));
    belt_config_t config;
    memset(&config, 0, sizeof config);
    model_config(scenario, &config);
    (void)belt_config_check(&config, NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_input_t input = {data, size};
    char setting[SETTING_MAX + 1u];
    char fault[SETTING_MAX + 1u];
    const char *const setting_text = setting;
    const char *const fault_text = fault;
    scenario_settings_t settings;
    memset(&settings, 0, sizeof settings);
    settings.text = &setting_text;
    settings.count = take(&input, 0u, setting) ? 1u : 0u;
    settings.fault = &fault_text;
    settings.fault_count = take(&input, 1u, fault) ? 1u : 0u;

    static scenario_t scenario;
    static scenario_t before;
    memset(&before, 0x5A, sizeof before);
    memcpy(&scenario, &before, sizeof scenario);
    if (scenario_read_with((const char *)input.next, input.left, "fuzz", &settings, &scenario,
                           messages)) {
        check_taken(&scenario);
    } else {
        FUZZ_CHECK(memcmp(&scenario, &before, sizeof scenario) == 0);
    }
    return 0;
}
