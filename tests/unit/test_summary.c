/* SPDX-License-Identifier: MIT */
#include "summary.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "unity.h"

static summary_t summary;

void setUp(void) {
    summary_begin(&summary);
}

void tearDown(void) {
}

static void take(double time, double level, double setpoint, double flux) {
    const loop_row_t row = {
        .time = time, .buffer_level = level, .level_setpoint = setpoint, .inlet_flux = flux};
    summary_take(&summary, &row);
}

/* Levels at 0, 1, 2, ... s under one set-point of 1. */
static void take_levels(const double *levels, size_t count) {
    for (size_t index = 0; index < count; index++) {
        take((double)index, levels[index], 1.0, 0.0);
    }
}

/* A few roundings of numbers of size 1: 1e-15. */
#define ROUNDING 1e-15

static void test_settling_ends_at_the_row_from_which_the_level_stays(void) {
    take_levels((const double[]){0.0, 1.0, 0.97, 0.981, 1.019}, 5);
    TEST_ASSERT_TRUE(summary.is_settled);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 3.0, summary.settling_time);
}

static void test_level_outside_the_band_at_the_end_has_not_settled(void) {
    take_levels((const double[]){0.0, 1.0, 1.021}, 3);
    TEST_ASSERT_FALSE(summary.is_settled);
}

static void test_level_that_never_leaves_settles_at_once(void) {
    take_levels((const double[]){1.0, 1.01, 0.99}, 3);
    TEST_ASSERT_TRUE(summary.is_settled);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, summary.settling_time);
}

static void test_settling_counts_from_the_last_change_of_the_setpoint(void) {
    take(0.0, 1.0, 1.0, 0.0);
    take(1.0, 1.0, 2.0, 0.0);
    take(2.0, 1.5, 2.0, 0.0);
    take(3.0, 2.0, 2.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 2.0, summary.settling_time);
}

static void test_overshoot_is_the_share_of_the_setpoint_beyond_it(void) {
    take(0.0, 0.0, 0.5, 0.0);
    take(1.0, 0.6, 0.5, 0.0);
    take(2.0, 0.4, 0.5, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.2, summary.overshoot);
}

static void test_level_that_starts_above_overshoots_below(void) {
    take(0.0, 1.0, 0.5, 0.0);
    take(1.0, 0.45, 0.5, 0.0);
    take(2.0, 0.6, 0.5, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.1, summary.overshoot);
}

static void test_overshoot_before_the_last_change_is_forgotten(void) {
    take(0.0, 0.0, 0.5, 0.0);
    take(1.0, 0.8, 0.5, 0.0);
    take(2.0, 0.8, 1.0, 0.0);
    take(3.0, 1.0, 1.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, summary.overshoot);
}

static void test_setpoint_step_down_counts_as_a_change(void) {
    take(0.0, 1.0, 1.0, 0.0);
    take(1.0, 1.0, 0.5, 0.0);
    take(2.0, 0.4, 0.5, 0.0);
    take(3.0, 0.5, 0.5, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 2.0, summary.settling_time);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.2, summary.overshoot);
}

static void test_error_is_integrated_by_trapezoids_over_the_whole_run(void) {
    take(0.0, 0.0, 1.0, 0.0);
    take(0.5, 0.5, 1.0, 0.0); /* 0.5 (1 + 0.5)/2 */
    take(1.5, 1.5, 1.0, 0.0); /* 1.0 (0.5 + 0.5)/2: without sign */
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.875, summary.iae);
}

static void test_interval_before_a_change_counts_under_the_old_setpoint(void) {
    take(0.0, 1.0, 1.0, 0.0);
    take(1.0, 1.0, 3.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, summary.iae);
    take(2.0, 2.0, 3.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 1.5, summary.iae);
}

static void test_flux_has_its_peak_and_total_variation(void) {
    take(0.0, 0.0, 1.0, 0.5);
    take(1.0, 0.0, 1.0, 2.0);
    take(2.0, 0.0, 1.0, 1.25);
    take(3.0, 0.0, 1.0, 1.5);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 2.0, summary.inlet_flux_peak);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 2.5, summary.inlet_flux_variation);
}

static void test_peak_of_a_flux_that_is_never_positive_is_not_zero(void) {
    take(0.0, 0.0, 1.0, -2.0);
    take(1.0, 0.0, 1.0, -1.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, -1.0, summary.inlet_flux_peak);
}

static void assert_written(const char *expected) {
    const loop_totals_t totals = {
        .spilled = 0.25, .balance_error = -1.5, .steps = 7, .disturbed = 0.125};
    char text[1024];
    FILE *const file = tmpfile();
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_TRUE(summary_write(&summary, &totals, file));
    rewind(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

#define NO_MODE_BUT_OFF(rows)                                                                      \
    "  \"rows_off\": " rows ",\n  \"rows_manual\": 0,\n  \"rows_automatic\": 0,\n"                 \
    "  \"rows_hold\": 0,\n  \"rows_substitute\": 0\n}\n"

static void test_summary_is_json_in_the_promised_order(void) {
    take(0.0, 0.0, 0.5, 1.0);
    take(1.0, 0.5, 0.5, 0.5);
    assert_written("{\n  \"settling_time\": 1,\n  \"overshoot\": 0,\n  \"iae\": 0.25,\n"
                   "  \"inlet_flux_peak\": 1,\n  \"inlet_flux_variation\": 0.5,\n"
                   "  \"final_error\": 0,\n  \"spilled\": 0.25,\n  \"balance_error\": -1.5,\n"
                   "  \"steps\": 7,\n  \"level_peak\": 0.5,\n  \"disturbed\": 0.125,\n"
                   "  \"error_bits\": 0,\n" NO_MODE_BUT_OFF("2"));
}

static void test_figures_without_value_are_null(void) {
    take(0.0, 0.5, 0.0, 0.0); /* a share of a set-point of 0 */
    assert_written("{\n  \"settling_time\": null,\n  \"overshoot\": null,\n  \"iae\": 0,\n"
                   "  \"inlet_flux_peak\": 0,\n  \"inlet_flux_variation\": 0,\n"
                   "  \"final_error\": 0.5,\n  \"spilled\": 0.25,\n  \"balance_error\": -1.5,\n"
                   "  \"steps\": 7,\n  \"level_peak\": 0.5,\n  \"disturbed\": 0.125,\n"
                   "  \"error_bits\": 0,\n" NO_MODE_BUT_OFF("1"));
}

static void take_answer(double mode, double error_bits) {
    const loop_row_t row = {.mode = mode, .error_bits = error_bits};
    summary_take(&summary, &row);
}

static void test_error_bits_of_all_steps_add_up(void) {
    take_answer(2.0, 1.0);
    take_answer(2.0, 0.0);
    take_answer(2.0, 4096.0);
    TEST_ASSERT_EQUAL_HEX32(0x1001, summary.error_bits);
}

static void test_rows_are_counted_in_their_mode(void) {
    static const double modes[] = {0, 1, 1, 2, 2, 2, 3, 4};
    static const size_t expected[SUMMARY_MODES] = {1, 2, 3, 1, 1};
    for (size_t index = 0; index < sizeof modes / sizeof modes[0]; index++) {
        take_answer(modes[index], 0.0);
    }
    TEST_ASSERT_EQUAL_MEMORY(expected, summary.mode_rows, sizeof expected);
}

static void test_level_has_its_peak_over_the_whole_run(void) {
    take(0.0, 0.2, 1.0, 0.0);
    take(1.0, 0.7, 1.0, 0.0);
    take(2.0, 0.4, 2.0, 0.0);
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.7, summary.level_peak);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_settling_ends_at_the_row_from_which_the_level_stays);
    RUN_TEST(test_level_outside_the_band_at_the_end_has_not_settled);
    RUN_TEST(test_level_that_never_leaves_settles_at_once);
    RUN_TEST(test_settling_counts_from_the_last_change_of_the_setpoint);
    RUN_TEST(test_overshoot_is_the_share_of_the_setpoint_beyond_it);
    RUN_TEST(test_level_that_starts_above_overshoots_below);
    RUN_TEST(test_overshoot_before_the_last_change_is_forgotten);
    RUN_TEST(test_setpoint_step_down_counts_as_a_change);
    RUN_TEST(test_error_is_integrated_by_trapezoids_over_the_whole_run);
    RUN_TEST(test_interval_before_a_change_counts_under_the_old_setpoint);
    RUN_TEST(test_flux_has_its_peak_and_total_variation);
    RUN_TEST(test_peak_of_a_flux_that_is_never_positive_is_not_zero);
    RUN_TEST(test_summary_is_json_in_the_promised_order);
    RUN_TEST(test_figures_without_value_are_null);
    RUN_TEST(test_error_bits_of_all_steps_add_up);
    RUN_TEST(test_rows_are_counted_in_their_mode);
    RUN_TEST(test_level_has_its_peak_over_the_whole_run);
    return UNITY_END();
}
