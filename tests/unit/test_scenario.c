/* SPDX-License-Identifier: MIT */
#include "scenario.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "unity.h"

static scenario_t scenario;
static char message[1024];
static bool was_read;

void setUp(void) {
    memset(&scenario, 0, sizeof scenario);
}

void tearDown(void) {
}

static void read_bytes(const char *text, size_t length, const scenario_settings_t *settings) {
    FILE *const messages = tmpfile();
    TEST_ASSERT_NOT_NULL(messages);
    was_read = scenario_read_with(text, length, "x.ini", settings, &scenario, messages);
    rewind(messages);
    message[fread(message, 1, sizeof message - 1, messages)] = '\0';
    fclose(messages);
}

static void read_text(const char *text) {
    const scenario_settings_t nothing = {0};
    read_bytes(text, strlen(text), &nothing);
}

static void read_set(const char *text, const char *first, const char *second) {
    const char *const texts[] = {first, second};
    const scenario_settings_t settings = {.text = texts, .count = second != NULL ? 2 : 1};
    read_bytes(text, strlen(text), &settings);
}

static void assert_read(void) {
    TEST_ASSERT_TRUE_MESSAGE(was_read, message);
    TEST_ASSERT_EQUAL_STRING("", message);
}

static void assert_refused(const char *part) {
    TEST_ASSERT_FALSE_MESSAGE(was_read, part);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(message, part), message);
    TEST_ASSERT_EQUAL_PTR(message + strlen(message) - 1, strchr(message, '\n')); /* one line */
}

/* Numbers that pass through the reader unchanged are compared as they are: exact. */
static void assert_number(double expected, double actual) {
    TEST_ASSERT_TRUE(fabs(expected - actual) <= 0.0);
}

static void test_empty_file_is_the_case_of_the_paper(void) {
    read_text("");
    assert_read();
    assert_number(2.0, scenario.line.belt_length);
    assert_number(0.25, scenario.line.processing_time);
    assert_number(0.2, scenario.line.speed_window);
    assert_number(0.5, scenario.line.connectivity);
    assert_number(0.8, scenario.line.service_rate_max);
    assert_number(0.1, scenario.line.rework_rate);
    assert_number(0.3, scenario.law.level_setpoint);
    assert_number(1.2, scenario.law.nominal_flux_max);
    assert_number(20.0, scenario.law.slope);
    TEST_ASSERT_FALSE(scenario.law.slope_is_absolute);
    TEST_ASSERT_EQUAL_INT(20, scenario.controller.node_count);
    assert_number(0.0025, scenario.controller.period);
    assert_number(10.0, scenario.run.duration);
    TEST_ASSERT_EQUAL_INT(0, (int)scenario.run.setpoints.count);
    TEST_ASSERT_TRUE(isinf(scenario.controller.inlet_flux_max));
    TEST_ASSERT_TRUE(isinf(scenario.plant.inlet_flux_max));
}

static void test_defaults_are_what_an_empty_file_gives(void) {
    scenario_t defaults;
    scenario_defaults(&defaults);
    read_text("");
    TEST_ASSERT_EQUAL_MEMORY(&defaults, &scenario, sizeof defaults);
}

static void test_plant_without_keys_of_its_own_is_the_line(void) {
    read_text("[line]\nbelt_length = 3\nloss_rate = 1, 2\n");
    assert_read();
    TEST_ASSERT_EQUAL_MEMORY(&scenario.line, &scenario.plant.line, sizeof(line_t));
}

static void test_plant_follows_a_line_that_a_setting_changes(void) {
    read_set("[line]\nbelt_length = 3\n[plant]\nprocessing_time = 0.3\n", "line.belt_length=4",
             "line.processing_time=0.2");
    assert_read();
    assert_number(4.0, scenario.plant.line.belt_length);
    assert_number(0.3, scenario.plant.line.processing_time);
    assert_number(0.2, scenario.line.processing_time);
}

static void test_plant_keeps_its_own_key_wherever_the_section_stands(void) {
    read_text("[plant]\nloss_rate = 5\n[line]\nloss_rate = 1, 2, 3\n");
    assert_read();
    TEST_ASSERT_EQUAL_INT(1, (int)scenario.plant.line.loss_rate.count);
    TEST_ASSERT_EQUAL_INT(3, (int)scenario.line.loss_rate.count);
}

static void test_plant_discretisation_defaults_to_its_schemes(void) {
    read_text("");
    TEST_ASSERT_EQUAL_INT(400, scenario.plant.node_count);
    TEST_ASSERT_EQUAL_INT(4, scenario.plant.substeps);
    read_set("", "plant.scheme=upwind", NULL);
    TEST_ASSERT_EQUAL_INT(80, scenario.plant.node_count);
    TEST_ASSERT_EQUAL_INT(1, scenario.plant.substeps);
    read_set("[plant]\nscheme = upwind\nsubsteps = 3\n", "plant.node_count=160", NULL);
    TEST_ASSERT_EQUAL_INT(160, scenario.plant.node_count);
    TEST_ASSERT_EQUAL_INT(3, scenario.plant.substeps);
}

static void test_file_yields_to_settings_and_earlier_settings_to_later_ones(void) {
    read_set("[law]\nlevel_setpoint = 0.2\n", "law.level_setpoint=0.4", "law.level_setpoint=0.5");
    assert_read();
    assert_number(0.5, scenario.law.level_setpoint);
}

static void test_slope_stated_one_way_replaces_the_other(void) {
    read_text("[law]\nsetpoint_slope = 22\n");
    TEST_ASSERT_TRUE(scenario.law.slope_is_absolute);
    assert_number(22.0, scenario.law.slope);
    read_set("[law]\nsetpoint_slope = 22\n", "law.slope_margin=7", NULL);
    TEST_ASSERT_FALSE(scenario.law.slope_is_absolute);
    assert_number(7.0, scenario.law.slope);
    read_set("", "law.slope_margin=7", "law.setpoint_slope=23");
    TEST_ASSERT_TRUE(scenario.law.slope_is_absolute);
    assert_number(23.0, scenario.law.slope);
}

static void test_words_become_the_enumerations_they_name(void) {
    read_text("[controller]\nlaw = open_loop\ndensity = measured\noutlet_flux = measured\n");
    assert_read();
    TEST_ASSERT_EQUAL_INT(LAW_OPEN_LOOP, scenario.controller.law);
    TEST_ASSERT_EQUAL_INT(DENSITY_MEASURED, scenario.controller.density);
    TEST_ASSERT_EQUAL_INT(OUTLET_MEASURED, scenario.controller.outlet_flux);
}

static void test_layout_that_carries_no_meaning_is_read_over(void) {
    read_text(
        "; comment \xC3\xA9\r\n\r\n# [line]\r\n[line] \t\r\nbelt_length\t=  3 \r\nloss_rate=1 ,2");
    assert_read();
    assert_number(3.0, scenario.line.belt_length);
    assert_number(2.0, scenario.line.loss_rate.value[1]);
}

static void test_decimal_numbers_are_read_in_each_form(void) {
    read_text("[law]\nlevel_setpoint = -.5e-1\nslope_margin = +2E1\nnominal_flux_max = 1.\n");
    assert_read();
    assert_number(-0.05, scenario.law.level_setpoint);
    assert_number(20.0, scenario.law.slope);
    assert_number(1.0, scenario.law.nominal_flux_max);
}

static void test_list_of_capacity_is_read_and_one_more_refused(void) {
    char text[256] = "[line]\nloss_rate = 1";
    for (int index = 1; index < LIST_CAPACITY; index++) {
        strcat(text, ",1");
    }
    read_text(text);
    assert_read();
    TEST_ASSERT_EQUAL_INT(LIST_CAPACITY, (int)scenario.line.loss_rate.count);
    read_text(strcat(text, ",1"));
    assert_refused("must hold at most 64 values");
}

static void test_longest_line_is_read_and_one_more_byte_refused(void) {
    char text[199];
    memset(text, '#', sizeof text);
    text[197] = '\n';
    read_bytes(text, 198, &(scenario_settings_t){0});
    assert_read();
    text[197] = '#';
    text[198] = '\n';
    read_bytes(text, 199, &(scenario_settings_t){0});
    assert_refused("x.ini:1: line of 198 bytes; at most 197");
}

static void test_message_names_file_line_key_value_and_limit(void) {
    read_text("[line]\n\nbelt_length = -2\n");
    assert_refused("x.ini:3: [line] belt_length = -2: must be greater than 0");
    read_set("", "controller.node_count=0", NULL);
    assert_refused("--set: [controller] node_count = 0: must be at least 1 and at most 10000");
}

static void test_refused_scenario_leaves_the_old_one(void) {
    memset(&scenario, 0x5A, sizeof scenario);
    const scenario_t before = scenario;
    read_text("[line]\nbelt_length = 3\n[run]\nduration = never\n");
    assert_refused("\"never\" is not a decimal number");
    TEST_ASSERT_EQUAL_MEMORY(&before, &scenario, sizeof before);
}

static void test_profile_is_linear_between_its_values_and_flat_beyond(void) {
    const profile_t profile = {{1.0, 3.0, 2.0}, 3};
    const profile_t uniform = {{4.0}, 1};
    /* Halves and quarters: every result is exact in binary. */
    assert_number(1.0, profile_at(&profile, 0.0, 2.0));
    assert_number(2.0, profile_at(&profile, 0.5, 2.0));
    assert_number(3.0, profile_at(&profile, 1.0, 2.0));
    assert_number(2.25, profile_at(&profile, 1.75, 2.0));
    assert_number(2.0, profile_at(&profile, 2.0, 2.0));
    assert_number(1.0, profile_at(&profile, -1.0, 2.0));
    assert_number(2.0, profile_at(&profile, 3.0, 2.0));
    assert_number(4.0, profile_at(&uniform, 1.0, 2.0));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_empty_file_is_the_case_of_the_paper);
    RUN_TEST(test_defaults_are_what_an_empty_file_gives);
    RUN_TEST(test_plant_without_keys_of_its_own_is_the_line);
    RUN_TEST(test_plant_follows_a_line_that_a_setting_changes);
    RUN_TEST(test_plant_keeps_its_own_key_wherever_the_section_stands);
    RUN_TEST(test_plant_discretisation_defaults_to_its_schemes);
    RUN_TEST(test_file_yields_to_settings_and_earlier_settings_to_later_ones);
    RUN_TEST(test_slope_stated_one_way_replaces_the_other);
    RUN_TEST(test_words_become_the_enumerations_they_name);
    RUN_TEST(test_layout_that_carries_no_meaning_is_read_over);
    RUN_TEST(test_decimal_numbers_are_read_in_each_form);
    RUN_TEST(test_list_of_capacity_is_read_and_one_more_refused);
    RUN_TEST(test_longest_line_is_read_and_one_more_byte_refused);
    RUN_TEST(test_message_names_file_line_key_value_and_limit);
    RUN_TEST(test_refused_scenario_leaves_the_old_one);
    RUN_TEST(test_profile_is_linear_between_its_values_and_flat_beyond);
    return UNITY_END();
}
