/* SPDX-License-Identifier: MIT */
/* Faults, modes and schedules of a scenario: what is read, and what is refused with which words. */
#include "scenario.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "unity.h"

static scenario_t scenario;
static char message[1024];

void setUp(void) {
    memset(&scenario, 0, sizeof scenario);
}

void tearDown(void) {
}

/* With up to two texts of --fault. */
static bool was_read(const char *text, const char *first, const char *second) {
    const char *const faults[] = {first, second};
    const size_t count = first == NULL ? 0 : second == NULL ? 1 : 2;
    const scenario_settings_t settings = {.fault = faults, .fault_count = count};
    FILE *const messages = tmpfile();
    TEST_ASSERT_NOT_NULL(messages);
    const bool result =
        scenario_read_with(text, strlen(text), "x.ini", &settings, &scenario, messages);
    rewind(messages);
    message[fread(message, 1, sizeof message - 1, messages)] = '\0';
    fclose(messages);
    return result;
}

static void read_text(const char *text) {
    TEST_ASSERT_TRUE_MESSAGE(was_read(text, NULL, NULL), message);
}

static void refuse(const char *text, const char *fault, const char *part) {
    TEST_ASSERT_FALSE_MESSAGE(was_read(text, fault, NULL), fault != NULL ? fault : text);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(message, part), message);
    TEST_ASSERT_EQUAL_PTR(message + strlen(message) - 1, strchr(message, '\n')); /* one line */
}

static void assert_fault(size_t index, fault_signal_t signal, fault_word_t word, double value,
                         double start, double length) {
    const fault_t *const fault = &scenario.run.faults[index];
    TEST_ASSERT_EQUAL(signal, fault->signal);
    TEST_ASSERT_EQUAL(word, fault->word);
    /* numbers pass through the reader unchanged: exact */
    TEST_ASSERT_TRUE(fabs(value - fault->value) <= 0.0);
    TEST_ASSERT_TRUE(fabs(start - fault->start) <= 0.0);
    TEST_ASSERT_TRUE(fabs(length - fault->length) <= 0.0);
}

static void test_list_of_faults_is_read_in_order(void) {
    read_text("[run]\nfaults = buffer_level:stuck@5+2, valve:wrong=0.8@0+1.5 ,period:off@1e1+.5\n");
    TEST_ASSERT_EQUAL_UINT(3, scenario.run.fault_count);
    assert_fault(0, FAULT_ON_BUFFER_LEVEL, FAULT_STUCK, 0.0, 5.0, 2.0);
    assert_fault(1, FAULT_ON_VALVE, FAULT_WRONG, 0.8, 0.0, 1.5);
    assert_fault(2, FAULT_ON_PERIOD, FAULT_OFF, 0.0, 10.0, 0.5);
}

static void test_every_word_is_read_on_a_measured_signal(void) {
    static const char *const texts[] = {"off",    "stuck",     "garbage",       "wrong=-2",
                                        "slow=2", "delayed=2", "intermittent=1"};
    static const double values[] = {0.0, 0.0, 0.0, -2.0, 2.0, 2.0, 1.0};
    for (size_t index = 0; index < sizeof texts / sizeof texts[0]; index++) {
        char text[64];
        (void)snprintf(text, sizeof text, "applied_flux:%s@1+1", texts[index]);
        TEST_ASSERT_TRUE_MESSAGE(was_read("", text, NULL), message);
        assert_fault(0, FAULT_ON_APPLIED_FLUX, (fault_word_t)index, values[index], 1.0, 1.0);
    }
}

static void test_faults_of_the_command_line_follow_those_of_the_file(void) {
    const char *const file = "[run]\nfaults = valve:off@1+1\n";
    TEST_ASSERT_TRUE_MESSAGE(was_read(file, "valve:stuck@2+1", "period:stuck@3+1, period:off@4+1"),
                             message);
    TEST_ASSERT_EQUAL_UINT(4, scenario.run.fault_count);
    assert_fault(0, FAULT_ON_VALVE, FAULT_OFF, 0.0, 1.0, 1.0);
    assert_fault(1, FAULT_ON_VALVE, FAULT_STUCK, 0.0, 2.0, 1.0);
    assert_fault(3, FAULT_ON_PERIOD, FAULT_OFF, 0.0, 4.0, 1.0);
}

static void test_plus_sign_of_an_exponent_is_not_the_one_between_start_and_length(void) {
    TEST_ASSERT_TRUE_MESSAGE(was_read("", "valve:off@1e+1+2E+1", NULL), message);
    assert_fault(0, FAULT_ON_VALVE, FAULT_OFF, 0.0, 10.0, 20.0);
    TEST_ASSERT_TRUE_MESSAGE(was_read("", "valve:off@+1++2", NULL), message);
    assert_fault(0, FAULT_ON_VALVE, FAULT_OFF, 0.0, 1.0, 2.0);
}

static void test_part_of_a_fault_that_is_wrong_is_named_with_what_it_must_be(void) {
    static const char *const refusals[][2] = {
        {"level:off@1+1", "signal \"level\" must be one of: buffer_level outlet_flux applied_flux "
                          "density valve period"},
        {":off@1+1", "signal \"\" must be one of"},
        {"valve:of@1+1", "word \"of\" must be one of: off stuck wrong slow delayed intermittent"},
        {"valve:garbage@1+1", "word \"garbage\" must be one of: off stuck wrong"},
        {"period:slow=1@1+1", "must be one of: off stuck garbage wrong intermittent"},
        {"period:delayed=1@1+1", "must be one of: off stuck garbage wrong intermittent"},
        {"buffer_level:@1+1", "word \"\" must be one of: off stuck garbage wrong slow"},
        {"valve:off=1@1+1", "value \"1\" must be left out"},
        {"valve:off=@1+1", "value \"\" must be left out"},
        {"valve:wrong@1+1", "value \"\" must be a decimal number"},
        {"valve:wrong=@1+1", "value \"\" must be a decimal number"},
        {"valve:wrong=x@1+1", "value \"x\" must be a decimal number"},
        {"valve:wrong=nan@1+1", "value \"nan\" must be a decimal number"},
        {"valve:wrong=-1@1+1", "value \"-1\" must be at least 0"},
        {"period:wrong=201@1+1", "value \"201\" must be at least 0 and at most 200"},
        {"valve:slow=0@1+1", "value \"0\" must be greater than 0"},
        {"valve:delayed=0@1+1", "value \"0\" must be greater than 0"},
        {"valve:intermittent=0@1+1", "value \"0\" must be greater than 0 and at most 1"},
        {"valve:intermittent=1.1@1+1", "value \"1.1\" must be greater than 0 and at most 1"},
        {"valve:off@-1+1", "start \"-1\" must be at least 0"},
        {"valve:off@1+0", "length \"0\" must be greater than 0"},
        {"valve:off@1+-1", "length \"-1\" must be greater than 0"},
        {"valve:off@1", "time \"1\" must be start+length"},
        {"valve:off@", "time \"\" must be start+length"},
        {"valve:off@+1", "time \"+1\" must be start+length"},
        {"valve:off@1+", "length \"\" must be a decimal number"},
        {"valve:off@1 s+1", "start \"1 s\" must be a decimal number"},
        {"valve:off", "must be signal:word[=value]@start+length"},
        {"valve@1+1", "must be signal:word[=value]@start+length"},
        {"valve", "must be signal:word[=value]@start+length"},
        {"valve:off@1+1,", "value 2 of the list is empty"},
        {"valve:delayed=1e9@1+1", "a delay must be at most 10000 periods"},
        {"outlet_flux:off@1+1", "controller.outlet_flux must be measured for a fault of"},
        {"density:off@1+1", "controller.density must be measured for a fault of density"},
    };
    for (size_t index = 0; index < sizeof refusals / sizeof refusals[0]; index++) {
        char text[128];
        refuse("", refusals[index][0], refusals[index][1]);
        (void)snprintf(text, sizeof text, "[run]\nfaults = %s\n", refusals[index][0]);
        refuse(text, NULL, refusals[index][1]);
    }
}

static void test_message_names_where_the_fault_stands(void) {
    refuse("[run]\n\nfaults = valve:of@1+1\n", NULL,
           "x.ini:3: [run] faults = valve:of@1+1: valve:of@1+1: word \"of\"");
    refuse("", "valve:of@1+1", "--fault: [run] faults = valve:of@1+1: valve:of@1+1: word \"of\"");
    refuse("", "valve:off@1+1\n", "--fault: must be UTF-8 without control characters");
}

static void test_one_fault_beyond_the_capacity_is_refused(void) {
    char text[1024] = "";
    for (int index = 0; index < FAULT_CAPACITY; index++) {
        strcat(text, index > 0 ? ",valve:off@1+1" : "valve:off@1+1");
    }
    TEST_ASSERT_TRUE_MESSAGE(was_read("", text, NULL), message);
    TEST_ASSERT_FALSE(was_read("", text, "valve:off@1+1"));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(message, "must hold at most 32 values"), message);
}

static void test_fault_is_at_work_from_its_start_up_to_its_end(void) {
    const fault_t fault = {FAULT_ON_VALVE, FAULT_OFF, 0.0, 0.3, 0.3};
    /* 0.3/0.1 and 0.6/0.1 are whole but for a rounding */
    for (size_t index = 0; index < 10; index++) {
        TEST_ASSERT_EQUAL(index >= 3 && index < 6, fault_is_active(&fault, index, 0.1));
    }
}

static void test_schedules_are_read(void) {
    read_text("[plant]\ndisturbance_times = 1, 2\ndisturbance_values = -0.1, 0.2\n"
              "service_times = 3\nservice_values = 0\n"
              "[run]\nmode_times = 1, 2, 3\nmode_values = manual, off , automatic\n"
              "manual_flux = 0.5\nmanual_times = 1.5\nmanual_values = 0.7\n");
    TEST_ASSERT_EQUAL_UINT(2, scenario.plant.disturbance.count);
    TEST_ASSERT_TRUE(fabs(scenario.plant.disturbance.values[0] + 0.1) <= 0.0);
    TEST_ASSERT_EQUAL_UINT(1, scenario.plant.service.count);
    TEST_ASSERT_EQUAL_UINT(3, scenario.run.modes.count);
    TEST_ASSERT_EQUAL(MODE_MANUAL, scenario.run.modes.words[0]);
    TEST_ASSERT_EQUAL(MODE_OFF, scenario.run.modes.words[1]);
    TEST_ASSERT_EQUAL(MODE_AUTOMATIC, scenario.run.modes.words[2]);
    TEST_ASSERT_TRUE(scenario.run.manual_flux_is_stated);
    TEST_ASSERT_EQUAL_UINT(1, scenario.run.manual.count);
}

static void test_schedules_that_contradict_themselves_are_refused(void) {
    static const char *const refusals[][2] = {
        {"[run]\nmode_times = 1\n", "1 values, but mode_values has 0; must be as many"},
        {"[run]\nmode_values = off\n", "0 values, but mode_values has 1"},
        {"[run]\nmode_times = 2, 1\nmode_values = off, off\n", "1 after 2; times must ascend"},
        {"[run]\nmode_times = 1\nmode_values = hold\n", "must be one of: off manual automatic"},
        {"[run]\nmode_times = 1\nmode_values = off,\n", "value 2 of the list is empty"},
        {"[run]\nmanual_times = 1\nmanual_values = 1\n", "at 1 the mode must be manual"},
        {"[run]\nmode_times = 0, 2\nmode_values = manual, off\nmanual_times = 1, 2\n"
         "manual_values = 1, 1\n",
         "at 2 the mode must be manual"},
        {"[run]\nmanual_times = 1\n", "1 values, but manual_values has 0"},
        {"[run]\nmanual_flux = -1\n", "must be at least 0"},
        {"[controller]\ninlet_flux_max = 1\n[run]\nmanual_flux = 2\n",
         "manual_flux: 2 must be at most controller.inlet_flux_max 1"},
        {"[controller]\ninlet_flux_max = 1\n[run]\nmode_times = 0\nmode_values = manual\n"
         "manual_times = 1\nmanual_values = 2\n",
         "manual_values: 2 must be at most controller.inlet_flux_max 1"},
        {"[controller]\nlaw = open_loop\n[run]\nmode_times = 0\nmode_values = manual\n",
         "controller.law must be predictor or frozen"},
        {"[plant]\ndisturbance_times = 1\n", "1 values, but disturbance_values has 0"},
        {"[plant]\nservice_times = 1, 1\nservice_values = 1, 1\n", "times must ascend"},
        {"[plant]\nservice_times = 1\nservice_values = -1\n", "must be at least 0"},
    };
    for (size_t index = 0; index < sizeof refusals / sizeof refusals[0]; index++) {
        refuse(refusals[index][0], NULL, refusals[index][1]);
    }
}

static void test_numbers_out_of_range_are_refused(void) {
    static const char *const refusals[][2] = {
        {"[controller]\nestimator = perhaps\n", "must be one of: off on"},
        {"[controller]\nestimator_time = 0\n", "must be greater than 0"},
        {"[controller]\nflux_rate_max = 0\n", "must be greater than 0"},
        {"[controller]\nsubstitute_flux = -1\n", "must be at least 0"},
        {"[controller]\nlevel_step_max = 0\n", "must be greater than 0"},
        {"[controller]\ntransfer_time = 0\n", "must be greater than 0"},
        {"[controller]\nrecovery_samples = 0\n", "must be at least 1 and at most 65535"},
        {"[controller]\nhold_time = 164\n", "hold_time: 164 is more than 65535 periods"},
        {"[controller]\nlevel_sample_time = 164\n", "164 is more than 65535 periods"},
        {"[plant]\nlevel_sample_time = 164\n", "164 is more than 65535 periods"},
        {"[plant]\nlevel_noise = -1\n", "must be at least 0"},
        {"[plant]\nlevel_quantum = -1\n", "must be at least 0"},
        {"[plant]\nseed = -1\n", "must be at least 0 and at most 4.29497e+09"},
        {"[plant]\nseed = 1.5\n", "must be a whole number in digits"},
        {"[run]\nsnapshot_period = 0\n", "must be greater than 0"},
    };
    for (size_t index = 0; index < sizeof refusals / sizeof refusals[0]; index++) {
        refuse(refusals[index][0], NULL, refusals[index][1]);
    }
}

static void test_what_is_left_out_is_left_to_the_controller(void) {
    read_text("");
    TEST_ASSERT_EQUAL(ESTIMATOR_OFF, scenario.controller.estimator);
    TEST_ASSERT_TRUE(fabs(scenario.controller.estimator_time) <= 0.0);
    TEST_ASSERT_TRUE(fabs(scenario.controller.flux_rate_max) <= 0.0);
    TEST_ASSERT_TRUE(fabs(scenario.controller.hold_time) <= 0.0);
    TEST_ASSERT_TRUE(fabs(scenario.controller.level_sample_time) <= 0.0);
    TEST_ASSERT_EQUAL(0, scenario.controller.recovery_samples);
    TEST_ASSERT_EQUAL(1, scenario.plant.seed);
    TEST_ASSERT_FALSE(scenario.run.manual_flux_is_stated);
    TEST_ASSERT_EQUAL_UINT(0, scenario.run.fault_count);
}

static void test_controller_expects_samples_as_often_as_the_plant_gives_them(void) {
    read_text("[plant]\nlevel_sample_time = 0.01\n");
    TEST_ASSERT_TRUE(fabs(scenario.controller.level_sample_time - 0.01) <= 0.0);
    read_text("[controller]\nlevel_sample_time = 0.02\n[plant]\nlevel_sample_time = 0.01\n");
    TEST_ASSERT_TRUE(fabs(scenario.controller.level_sample_time - 0.02) <= 0.0);
}

static void test_snapshots_are_taken_each_period_when_the_power_may_go(void) {
    read_text("");
    TEST_ASSERT_TRUE(fabs(scenario.run.snapshot_period) <= 0.0);
    read_text("[run]\nfaults = period:stuck@1+1\n");
    TEST_ASSERT_TRUE(fabs(scenario.run.snapshot_period) <= 0.0);
    TEST_ASSERT_TRUE_MESSAGE(was_read("", "period:off@1+1", NULL), message);
    TEST_ASSERT_TRUE(fabs(scenario.run.snapshot_period - 0.0025) <= 0.0);
    TEST_ASSERT_TRUE_MESSAGE(was_read("[run]\nsnapshot_period = 1\n", "period:off@1+1", NULL),
                             message);
    TEST_ASSERT_TRUE(fabs(scenario.run.snapshot_period - 1.0) <= 0.0);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_list_of_faults_is_read_in_order);
    RUN_TEST(test_every_word_is_read_on_a_measured_signal);
    RUN_TEST(test_faults_of_the_command_line_follow_those_of_the_file);
    RUN_TEST(test_plus_sign_of_an_exponent_is_not_the_one_between_start_and_length);
    RUN_TEST(test_part_of_a_fault_that_is_wrong_is_named_with_what_it_must_be);
    RUN_TEST(test_message_names_where_the_fault_stands);
    RUN_TEST(test_one_fault_beyond_the_capacity_is_refused);
    RUN_TEST(test_fault_is_at_work_from_its_start_up_to_its_end);
    RUN_TEST(test_schedules_are_read);
    RUN_TEST(test_schedules_that_contradict_themselves_are_refused);
    RUN_TEST(test_numbers_out_of_range_are_refused);
    RUN_TEST(test_what_is_left_out_is_left_to_the_controller);
    RUN_TEST(test_controller_expects_samples_as_often_as_the_plant_gives_them);
    RUN_TEST(test_snapshots_are_taken_each_period_when_the_power_may_go);
    return UNITY_END();
}
