/* SPDX-License-Identifier: MIT */
/* Every rule of scenario.h's format, each broken by the smallest text that breaks it. */
#include "scenario.h"

#include <stdio.h>
#include <string.h>

#include "unity.h"

typedef struct {
    const char *text;
    const char *message; /* a part that tells this rule from the others */
} refusal_t;

void setUp(void) {
}

void tearDown(void) {
}

static void read_refused(const char *text, size_t length, const char *setting, const char *part) {
    char message[1024];
    scenario_t scenario;
    FILE *const messages = tmpfile();
    TEST_ASSERT_NOT_NULL(messages);
    const scenario_settings_t settings = {.text = &setting, .count = setting != NULL ? 1 : 0};
    TEST_ASSERT_FALSE_MESSAGE(
        scenario_read_with(text, length, "x.ini", &settings, &scenario, messages),
        setting != NULL ? setting : text);
    rewind(messages);
    message[fread(message, 1, sizeof message - 1, messages)] = '\0';
    fclose(messages);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(message, part), message);
    TEST_ASSERT_EQUAL_PTR(message + strlen(message) - 1, strchr(message, '\n')); /* one line */
}

static void refuse_texts(const refusal_t *refusals, size_t count) {
    for (size_t index = 0; index < count; index++) {
        const refusal_t *const refusal = &refusals[index];
        read_refused(refusal->text, strlen(refusal->text), NULL, refusal->message);
    }
}

/* Each number by way of a setting too: the same rules hold there. */
static void refuse_values(const char *section, const char *key, const refusal_t *refusals,
                          size_t count) {
    char text[512];
    for (size_t index = 0; index < count; index++) {
        const char *const value = refusals[index].text;
        (void)snprintf(text, sizeof text, "[%s]\n%s = %s\n", section, key, value);
        read_refused(text, strlen(text), NULL, refusals[index].message);
        (void)snprintf(text, sizeof text, "%s.%s=%s", section, key, value);
        read_refused("", 0, text, refusals[index].message);
    }
}

#define COUNT_OF(array) (sizeof(array) / sizeof(array)[0])

static void test_text_that_is_no_decimal_number_is_refused(void) {
    static const char *const texts[] = {
        "fast", "nan",   "inf",   "-Infinity", "0x10",  "0x1p3",     "2 m",
        "2m",   "1_000", "1 000", "2,",        "1,5",   ".",         "+",
        "e5",   "1e",    "1e+",   "1.2.3",     "--1",   "\"2\"",     "2=3",
        "2:3",  "1d3",   "1e5.0", "${x}",      "%(x)s", "2\xC2\xA0", "\xD9\xA3",
    };
    for (size_t index = 0; index < COUNT_OF(texts); index++) {
        const refusal_t refusal = {texts[index], "is not a decimal number"};
        refuse_values("line", "belt_length", &refusal, 1);
    }
}

static void test_decimal_number_out_of_range_is_refused(void) {
    static const refusal_t refusals[] = {
        {"", "has no value"},
        {"1e999", "of a size from 2.3e-308 to 1.7e308"},
        {"-1e999", "of a size from"},
        {"1e-999", "of a size from"},
        {"-1", "greater than 0"},
        {"0", "must be greater than 0"},
        {"-0", "must be greater than 0"},
    };
    refuse_values("line", "belt_length", refusals, COUNT_OF(refusals));
}

static void test_count_that_is_no_whole_number_in_range_is_refused(void) {
    static const refusal_t refusals[] = {
        {"2.0", "whole number"},  {"1e1", "whole number"},
        {"many", "whole number"}, {"", "has no value"},
        {"0x10", "whole number"}, {"-5", "at least 1 and at most 1"},
        {"0", "at least 1"},      {"10000000", "at most 1"},
        {"2,3", "whole number"},  {"99999999999999999999999", "at most 1"},
    };
    refuse_values("controller", "node_count", refusals, COUNT_OF(refusals));
    refuse_values("plant", "node_count", refusals, COUNT_OF(refusals));
    refuse_values("plant", "substeps", refusals, COUNT_OF(refusals));
}

static void test_unknown_word_is_refused_with_the_known_ones(void) {
    static const refusal_t refusals[] = {
        {"smith", "must be one of: predictor frozen uncompensated open_loop"},
        {"Predictor", "must be one of"},
        {"predictor frozen", "must be one of"},
        {"predict", "must be one of"},
        {"1", "must be one of"},
        {"", "has no value"},
    };
    refuse_values("controller", "law", refusals, COUNT_OF(refusals));
}

static void test_list_with_a_hole_is_refused(void) {
    static const refusal_t refusals[] = {
        {"1,", "value 2 of the list is empty"},    {",1", "value 1 of the list is empty"},
        {"1,,2", "value 2 of the list is empty"},  {"1, ,2", "value 2 of the list is empty"},
        {",", "value 1 of the list is empty"},     {"1 2", "\"1 2\" is not a decimal number"},
        {"1, x", "\"x\" is not a decimal number"}, {"1; 2", ""},
    };
    static const refusal_t below_0[] = {{"1, -1", "must be at least 0"}};
    refuse_values("line", "loss_rate", refusals, COUNT_OF(refusals));
    refuse_values("initial", "density", refusals, COUNT_OF(refusals));
    refuse_values("initial", "density", below_0, COUNT_OF(below_0));
}

static void test_line_that_is_no_ini_as_both_readers_know_it_is_refused(void) {
    static const refusal_t refusals[] = {
        {"[line]\nbelt_length\n", "x.ini:2: must be `key = value`"},
        {"[line]\nbelt_length : 2\n", "x.ini:2: must be `key = value`"},
        {"[line]\nbelt_length : a = 2\n", "x.ini:2: must be `key = value`"},
        {"[line]\n = 2\n", "indented"},
        {"[line]\n= 2\n", "unknown key"},
        {"[line]\nloss_rate = 1,\n 2\n", "empty"},
        {"[line]\nloss_rate = 1\n  2\n", "x.ini:3: indented"},
        {"[line]\n belt_length = 2\n", "x.ini:2: indented"},
        {"[line]\n\t# comment\n", "x.ini:2: indented"},
        {"[line]\nbelt_length = 2 ; m\n", "lines of their own"},
        {"[line]\nbelt_length = 2 # m\n", "lines of their own"},
        {"[line] ; comment\n", "text behind the section"},
        {"[line\n", "section without ']'"},
        {"[line]]\n", "text behind the section"},
    };
    refuse_texts(refusals, COUNT_OF(refusals));
}

static void test_unknown_and_misplaced_names_are_refused(void) {
    static const refusal_t refusals[] = {
        {"[lines]\n", "x.ini:1: unknown section [lines]"},
        {"[Line]\n", "unknown section [Line]"},
        {"[ line ]\n", "unknown section"},
        {"[]\n", "unknown section []"},
        {"[DEFAULT]\nbelt_length = 2\n", "unknown section [DEFAULT]"},
        {"[line]\nBelt_length = 2\n", "x.ini:2: [line] Belt_length = 2: unknown key"},
        {"[line]\nduration = 2\n", "unknown key"},
        {"[line]\nbelt_lengt = 2\n", "unknown key"},
        {"[controller]\nestimater = off\n", "unknown key"},
        {"belt_length = 2\n", "x.ini:1: belt_length stands outside a section"},
    };
    refuse_texts(refusals, COUNT_OF(refusals));
}

static void test_what_is_stated_twice_is_refused(void) {
    static const refusal_t refusals[] = {
        {"[line]\nbelt_length = 2\nbelt_length = 2\n",
         "x.ini:3: [line] belt_length = 2: belt_length"},
        {"[line]\nbelt_length = 2\n[law]\n[line]\nbelt_length = 3\n",
         "x.ini:4: section [line] stands"},
        {"[line]\n[line]\n", "x.ini:2: section [line] stands twice"},
        {"[law]\nslope_margin = 1\nsetpoint_slope = 22\n", "slope_margin stands in this file"},
        {"[law]\nsetpoint_slope = 22\nslope_margin = 1\n", "setpoint_slope stands in this file"},
    };
    refuse_texts(refusals, COUNT_OF(refusals));
}

static void test_keys_that_contradict_each_other_are_refused(void) {
    static const refusal_t refusals[] = {
        {"[run]\nsetpoint_times = 1, 2\nsetpoint_levels = 0.3\n",
         "2 values, but setpoint_levels has 1"},
        {"[run]\nsetpoint_times = 1\n", "1 values, but setpoint_levels has 0"},
        {"[run]\nsetpoint_levels = 1\n", "0 values, but setpoint_levels has 1"},
        {"[run]\nsetpoint_times = 2, 1\nsetpoint_levels = 1, 2\n", "times must ascend"},
        {"[run]\nsetpoint_times = 1, 1\nsetpoint_levels = 1, 2\n", "times must ascend"},
        {"[run]\nsetpoint_times = -1\nsetpoint_levels = 1\n", "must be at least 0"},
        {"[run]\nduration = 1e7\n", "more than 1e+08 periods"},
        {"[controller]\nperiod = 1e-12\n", "more than 1e+08 periods"},
        {"[initial]\nbuffer_level = 2\n", "2 must be at most the plant's level_capacity 1"},
        {"[line]\nconnectivity = 1.5\n", "must be greater than 0 and at most 1"},
    };
    refuse_texts(refusals, COUNT_OF(refusals));
}

static void test_bytes_that_are_no_text_are_refused(void) {
    static const refusal_t refusals[] = {
        {"\xEF\xBB\xBF[line]\n", "x.ini:1: byte 0xEF at column 1"},
        {"# \x01\n", "byte 0x01 at column 3"},
        {"# \x7F\n", "byte 0x7F"},
        {"# a\rb\n", "byte 0x0D at column 4"},
        {"# \f\n", "byte 0x0C"},
        {"# \x1B[31m\n", "byte 0x1B"},
        {"# \xE9\n", "byte 0xE9"},             /* Latin-1 */
        {"# \xC0\xAF\n", "byte 0xC0"},         /* overlong */
        {"# \xE0\x80\xAF\n", "byte 0xE0"},     /* overlong in three bytes */
        {"# \xED\xA0\x80\n", "byte 0xED"},     /* surrogate */
        {"# \xF4\x90\x80\x80\n", "byte 0xF4"}, /* beyond Unicode */
        {"# \xC2\x85\n", "byte 0xC2"},         /* C1 control: a line end to some */
        {"# \xE2\x82", "byte 0xE2"},           /* cut short */
        {"# \x80\n", "byte 0x80"},
    };
    refuse_texts(refusals, COUNT_OF(refusals));
    read_refused("# \0\n", 4, NULL, "byte 0x00 at column 3");
    read_refused("# \xE2\x82\xAC", 4, NULL, "byte 0xE2"); /* ends where the file does */
}

static void test_file_of_more_than_the_greatest_size_is_refused(void) {
    static char text[SCENARIO_SIZE_MAX + 1];
    memset(text, '\n', sizeof text);
    read_refused(text, sizeof text, NULL, "65537 bytes; a scenario has at most 65536");
}

static void test_setting_of_another_shape_is_refused(void) {
    static const char *const settings[] = {"",       "=",       "belt_length=2", "line.belt_length",
                                           "line=2", "line=a.b"};
    for (size_t index = 0; index < COUNT_OF(settings); index++) {
        read_refused("", 0, settings[index], "--set: must be section.key=value");
    }
    read_refused("", 0, "line.=2", "unknown key");
    read_refused("", 0, "lines.belt_length=2", "unknown key");
    read_refused("", 0, "line.belt_length =2", "unknown key");
    read_refused("", 0, "line.belt_length=2\n3", "UTF-8 without control characters");
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_text_that_is_no_decimal_number_is_refused);
    RUN_TEST(test_decimal_number_out_of_range_is_refused);
    RUN_TEST(test_count_that_is_no_whole_number_in_range_is_refused);
    RUN_TEST(test_unknown_word_is_refused_with_the_known_ones);
    RUN_TEST(test_list_with_a_hole_is_refused);
    RUN_TEST(test_line_that_is_no_ini_as_both_readers_know_it_is_refused);
    RUN_TEST(test_unknown_and_misplaced_names_are_refused);
    RUN_TEST(test_what_is_stated_twice_is_refused);
    RUN_TEST(test_keys_that_contradict_each_other_are_refused);
    RUN_TEST(test_bytes_that_are_no_text_are_refused);
    RUN_TEST(test_file_of_more_than_the_greatest_size_is_refused);
    RUN_TEST(test_setting_of_another_shape_is_refused);
    return UNITY_END();
}
