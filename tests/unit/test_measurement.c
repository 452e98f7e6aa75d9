/* SPDX-License-Identifier: MIT */
#include "belt/measurement.h"

#include "paper_case.h"
#include "reals.h"
#include <math.h>

#include "unity.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])
#define ALL_PRESENT                                                                                \
    (BELT_HAS_LEVEL | BELT_HAS_OUTLET_FLUX | BELT_HAS_APPLIED_FLUX | BELT_HAS_DENSITY)
#define COMMAND BELT_REAL(0.75)

static belt_config_t config;
static belt_line_t line;
static belt_trusted_t last;
static belt_measurement_t measurement;
static belt_real_t density[BELT_NODE_CAPACITY + 1];

void setUp(void) {
    config = paper_case();
    belt_line_init(&line, &config);
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = BELT_REAL(0.25);
    }
    last = (belt_trusted_t){.level = BELT_REAL(0.125), .outlet_flux = BELT_REAL(0.5)};
    measurement = (belt_measurement_t){.present = ALL_PRESENT,
                                       .level = BELT_REAL(0.5),
                                       .outlet_flux = BELT_REAL(0.625),
                                       .applied_flux = BELT_REAL(0.875),
                                       .density = density};
}

void tearDown(void) {
}

static belt_trusted_t gate(void) {
    return belt_measurement_gate(&measurement, &last, COMMAND, &line);
}

#if BELT_REAL_IS_DOUBLE
#define SIGNALLING_NAN 0x7FF0000000000001u
#define QUIET_NAN_NEGATIVE 0xFFF8000000000000u
#define ALL_ONES 0xFFFFFFFFFFFFFFFFu
#else
#define SIGNALLING_NAN 0x7F800001u
#define QUIET_NAN_NEGATIVE 0xFFC00000u
#define ALL_ONES 0xFFFFFFFFu
#endif

/* No numbers at all. Kept as bits: loading a signalling NaN may quieten it. */
static const uint64_t no_numbers[] = {SIGNALLING_NAN, QUIET_NAN_NEGATIVE, ALL_ONES};

static void store(belt_real_t *place, uint64_t bits) {
    const belt_word_t word = (belt_word_t)bits;
    memcpy(place, &word, sizeof word);
}

/* --- bounds --- */

static void test_bounds_are_ten_times_what_the_law_can_ask_for(void) {
    /* 1.2 at the outlet, the line 1 + 0.2*1/1 times slower then, a loss of 1 over 0.6 s made up for;
     * as a density times 0.25*1.2. Five roundings at most, and 2 of the exponential. */
    const double flux = 10 * 1.2 * 1.2 * exp(0.6);
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON * flux, flux, (double)line.flux_bound);
    TEST_ASSERT_DOUBLE_WITHIN(10 * EPSILON * flux * 0.3, flux * 0.3, (double)line.density_bound);
}

static void test_bounds_grow_with_the_congestion_the_line_can_have(void) {
    config.congestion_scale = BELT_REAL(0.1);
    config.level_capacity = BELT_REAL(2);
    /* 1 + 0.2*2/0.1 times slower: 2.5 s. The exponent's own roundings count 2.5 times. */
    const double most = 10 * 1.2 * 5 * exp(2.5) * 0.25 * 5;
    TEST_ASSERT_DOUBLE_WITHIN(20 * EPSILON * most, most,
                              (double)belt_config_density_bound(&config));
}

static void test_the_most_that_losses_can_make_the_law_ask_for_is_sound(void) {
    /* 1/survival = exp(9.9): what is fed then is more than 10,000 times what arrives. */
    config.loss_rate[0] = BELT_REAL(16.5);
    const double most = 1.2 * exp(16.5 * 0.6);
    TEST_ASSERT_TRUE((double)belt_config_flux_bound(&config) > 9 * most);
}

/* --- what is sound passes --- */

static void test_sound_inputs_pass_unchanged(void) {
    const belt_trusted_t trusted = gate();
    TEST_ASSERT_EQUAL_HEX32(0u, trusted.error_bits);
    TEST_ASSERT_TRUE(trusted.level == BELT_REAL(0.5));
    TEST_ASSERT_TRUE(trusted.outlet_flux == BELT_REAL(0.625));
    TEST_ASSERT_TRUE(trusted.applied_flux == BELT_REAL(0.875));
    TEST_ASSERT_TRUE(trusted.level_is_new && trusted.has_outlet_flux && trusted.has_density);
}

static void test_limits_themselves_are_sound(void) {
    measurement.level = config.level_capacity;
    measurement.outlet_flux = line.flux_bound;
    measurement.applied_flux = line.flux_bound;
    density[0] = line.density_bound;
    TEST_ASSERT_EQUAL_HEX32(0u, gate().error_bits);
    measurement.level = BELT_REAL(0);
    measurement.outlet_flux = BELT_REAL(0);
    measurement.applied_flux = BELT_REAL(0);
    density[0] = BELT_REAL(0);
    TEST_ASSERT_EQUAL_HEX32(0u, gate().error_bits);
}

static void test_negative_zero_and_subnormal_numbers_are_sound(void) {
    const belt_real_t small[] = {BELT_REAL(-0.0), real_from_bits(1u), real_from_bits(12345u)};
    for (size_t i = 0; i < COUNT(small); ++i) {
        measurement.level = small[i];
        measurement.outlet_flux = small[i];
        measurement.applied_flux = small[i];
        density[3] = small[i];
        TEST_ASSERT_EQUAL_HEX32(0u, gate().error_bits);
    }
}

static void test_bits_of_an_earlier_period_are_forgotten(void) {
    last.error_bits = 0xFFFFFFFFu;
    TEST_ASSERT_EQUAL_HEX32(0u, gate().error_bits);
}

/* --- the level --- */

static void assert_last_level_stands_in(uint32_t error_bits) {
    const belt_trusted_t trusted = gate();
    TEST_ASSERT_EQUAL_HEX32(error_bits, trusted.error_bits);
    TEST_ASSERT_TRUE(trusted.level == last.level);
    TEST_ASSERT_FALSE(trusted.level_is_new);
}

static void test_missing_level_is_said_and_the_last_one_stands_in(void) {
    last.level_is_new = true;
    measurement.present = ALL_PRESENT & ~BELT_HAS_LEVEL;
    assert_last_level_stands_in(BELT_ERROR_LEVEL_MISSING);
}

static void test_level_that_is_no_number_is_invalid_and_the_last_one_stands_in(void) {
    for (size_t i = 0; i < COUNT(no_numbers); ++i) {
        store(&measurement.level, no_numbers[i]);
        assert_last_level_stands_in(BELT_ERROR_LEVEL_INVALID);
    }
    measurement.level = BELT_REAL(INFINITY);
    assert_last_level_stands_in(BELT_ERROR_LEVEL_INVALID);
    measurement.level = BELT_REAL(-INFINITY);
    assert_last_level_stands_in(BELT_ERROR_LEVEL_INVALID);
}

static void assert_level_is_clamped(belt_real_t level, belt_real_t clamped) {
    measurement.level = level;
    const belt_trusted_t trusted = gate();
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_RANGE, trusted.error_bits);
    TEST_ASSERT_TRUE(trusted.level == clamped);
    TEST_ASSERT_TRUE(trusted.level_is_new);
}

static void test_level_out_of_range_is_clamped_and_counts_as_new(void) {
    const belt_real_t full = config.level_capacity;
    assert_level_is_clamped(real_next(full, BELT_REAL_MAX), full);
    assert_level_is_clamped(BELT_REAL_MAX, full);
    assert_level_is_clamped(-real_from_bits(1u), BELT_REAL(0));
    assert_level_is_clamped(BELT_REAL(-1), BELT_REAL(0));
    assert_level_is_clamped(-BELT_REAL_MAX, BELT_REAL(0));
}

/* --- the fluxes --- */

/* Everything that is no flux. */
static size_t senseless_fluxes(belt_real_t *fluxes) {
    size_t count = 0;
    for (; count < COUNT(no_numbers); ++count) {
        store(&fluxes[count], no_numbers[count]);
    }
    fluxes[count++] = BELT_REAL(INFINITY);
    fluxes[count++] = BELT_REAL(-INFINITY);
    fluxes[count++] = BELT_REAL_MAX;
    fluxes[count++] = -BELT_REAL_MAX;
    fluxes[count++] = real_next(line.flux_bound, BELT_REAL_MAX);
    fluxes[count++] = -real_from_bits(1u);
    return count;
}

#define SENSELESS_CAPACITY 16

static void test_senseless_outlet_flux_is_not_used(void) {
    belt_real_t fluxes[SENSELESS_CAPACITY];
    const size_t count = senseless_fluxes(fluxes);
    for (size_t i = 0; i < count; ++i) {
        memcpy(&measurement.outlet_flux, &fluxes[i], sizeof fluxes[i]);
        const belt_trusted_t trusted = gate();
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_OUTLET_FLUX_INVALID, trusted.error_bits);
        TEST_ASSERT_FALSE(trusted.has_outlet_flux);
        TEST_ASSERT_TRUE(trusted.outlet_flux == last.outlet_flux);
    }
}

static void test_missing_outlet_flux_is_no_error(void) {
    last.has_outlet_flux = true;
    measurement.present = ALL_PRESENT & ~BELT_HAS_OUTLET_FLUX;
    const belt_trusted_t trusted = gate();
    TEST_ASSERT_EQUAL_HEX32(0u, trusted.error_bits);
    TEST_ASSERT_FALSE(trusted.has_outlet_flux);
}

static void test_command_stands_in_for_a_senseless_applied_flux(void) {
    belt_real_t fluxes[SENSELESS_CAPACITY];
    const size_t count = senseless_fluxes(fluxes);
    for (size_t i = 0; i < count; ++i) {
        memcpy(&measurement.applied_flux, &fluxes[i], sizeof fluxes[i]);
        const belt_trusted_t trusted = gate();
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_APPLIED_FLUX_INVALID, trusted.error_bits);
        TEST_ASSERT_TRUE(trusted.applied_flux == COMMAND);
    }
}

static void test_command_stands_in_for_a_missing_applied_flux_without_error(void) {
    measurement.present = ALL_PRESENT & ~BELT_HAS_APPLIED_FLUX;
    const belt_trusted_t trusted = gate();
    TEST_ASSERT_EQUAL_HEX32(0u, trusted.error_bits);
    TEST_ASSERT_TRUE(trusted.applied_flux == COMMAND);
}

/* --- the density --- */

static void assert_density_is_refused(uint32_t error_bits) {
    const belt_trusted_t trusted = gate();
    TEST_ASSERT_EQUAL_HEX32(error_bits, trusted.error_bits);
    TEST_ASSERT_FALSE(trusted.has_density);
}

static void test_null_density_is_invalid(void) {
    measurement.density = NULL;
    assert_density_is_refused(BELT_ERROR_DENSITY_INVALID);
}

static void test_null_density_that_is_not_present_is_no_error(void) {
    last.has_density = true;
    measurement.present = ALL_PRESENT & ~BELT_HAS_DENSITY;
    measurement.density = NULL;
    assert_density_is_refused(0u);
}

static void test_one_senseless_value_anywhere_refuses_the_profile(void) {
    for (size_t node = 0; node <= config.node_count; ++node) {
        for (size_t i = 0; i < COUNT(no_numbers); ++i) {
            store(&density[node], no_numbers[i]);
            assert_density_is_refused(BELT_ERROR_DENSITY_INVALID);
        }
        density[node] = BELT_REAL(INFINITY);
        assert_density_is_refused(BELT_ERROR_DENSITY_INVALID);
        density[node] = BELT_REAL_MAX;
        assert_density_is_refused(BELT_ERROR_DENSITY_INVALID);
        density[node] = real_next(line.density_bound, BELT_REAL_MAX);
        assert_density_is_refused(BELT_ERROR_DENSITY_INVALID);
        density[node] = BELT_REAL(0.25);
    }
}

static void test_one_negative_value_anywhere_refuses_the_profile_as_out_of_range(void) {
    const belt_real_t negative[] = {-real_from_bits(1u), BELT_REAL(-1), -BELT_REAL_MAX,
                                    BELT_REAL(-INFINITY)};
    for (size_t node = 0; node <= config.node_count; ++node) {
        for (size_t i = 0; i < COUNT(negative); ++i) {
            density[node] = negative[i];
            assert_density_is_refused(BELT_ERROR_DENSITY_RANGE);
        }
        density[node] = BELT_REAL(0.25);
    }
}

static void test_negative_and_senseless_values_in_one_profile_are_both_said(void) {
    density[1] = BELT_REAL(-1);
    density[7] = BELT_REAL(NAN);
    assert_density_is_refused(BELT_ERROR_DENSITY_INVALID | BELT_ERROR_DENSITY_RANGE);
}

static void test_value_behind_the_profile_is_not_read(void) {
    density[config.node_count + 1] = BELT_REAL(NAN);
    TEST_ASSERT_EQUAL_HEX32(0u, gate().error_bits);
}

/* --- everything at once --- */

static void test_absent_inputs_are_not_read(void) {
    measurement.present = 0u;
    store(&measurement.level, SIGNALLING_NAN);
    store(&measurement.outlet_flux, SIGNALLING_NAN);
    store(&measurement.applied_flux, SIGNALLING_NAN);
    measurement.density = NULL;
    assert_last_level_stands_in(BELT_ERROR_LEVEL_MISSING);
}

static void test_errors_of_all_inputs_are_said_together(void) {
    measurement.level = BELT_REAL(NAN);
    measurement.outlet_flux = BELT_REAL(NAN);
    measurement.applied_flux = BELT_REAL(NAN);
    density[0] = BELT_REAL(NAN);
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_INVALID | BELT_ERROR_OUTLET_FLUX_INVALID |
                                BELT_ERROR_APPLIED_FLUX_INVALID | BELT_ERROR_DENSITY_INVALID,
                            gate().error_bits);
}

static bool is_within(belt_real_t value, belt_real_t bound) {
    return (value >= BELT_REAL(0)) && (value <= bound);
}

static void test_whatever_the_bits_what_passes_is_in_range(void) {
    uint64_t random = 0x9E3779B97F4A7C15u;
    for (int i = 0; i < 200000; ++i) {
        measurement.present = (uint32_t)random_bits(&random);
        store(&measurement.level, random_bits(&random));
        store(&measurement.outlet_flux, random_bits(&random));
        store(&measurement.applied_flux, random_bits(&random));
        store(&density[i % (int)(config.node_count + 1u)], random_bits(&random));
        const belt_trusted_t trusted = gate();
        TEST_ASSERT_TRUE(is_within(trusted.level, config.level_capacity));
        TEST_ASSERT_TRUE(is_within(trusted.applied_flux, line.flux_bound));
        TEST_ASSERT_TRUE(is_within(trusted.outlet_flux, line.flux_bound));
        if (trusted.has_density) {
            for (size_t node = 0; node <= config.node_count; ++node) {
                TEST_ASSERT_TRUE(is_within(density[node], line.density_bound));
            }
        }
        last = trusted;
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_bounds_are_ten_times_what_the_law_can_ask_for);
    RUN_TEST(test_the_most_that_losses_can_make_the_law_ask_for_is_sound);
    RUN_TEST(test_bounds_grow_with_the_congestion_the_line_can_have);
    RUN_TEST(test_sound_inputs_pass_unchanged);
    RUN_TEST(test_limits_themselves_are_sound);
    RUN_TEST(test_negative_zero_and_subnormal_numbers_are_sound);
    RUN_TEST(test_bits_of_an_earlier_period_are_forgotten);
    RUN_TEST(test_missing_level_is_said_and_the_last_one_stands_in);
    RUN_TEST(test_level_that_is_no_number_is_invalid_and_the_last_one_stands_in);
    RUN_TEST(test_level_out_of_range_is_clamped_and_counts_as_new);
    RUN_TEST(test_senseless_outlet_flux_is_not_used);
    RUN_TEST(test_missing_outlet_flux_is_no_error);
    RUN_TEST(test_command_stands_in_for_a_senseless_applied_flux);
    RUN_TEST(test_command_stands_in_for_a_missing_applied_flux_without_error);
    RUN_TEST(test_null_density_is_invalid);
    RUN_TEST(test_null_density_that_is_not_present_is_no_error);
    RUN_TEST(test_one_senseless_value_anywhere_refuses_the_profile);
    RUN_TEST(test_one_negative_value_anywhere_refuses_the_profile_as_out_of_range);
    RUN_TEST(test_negative_and_senseless_values_in_one_profile_are_both_said);
    RUN_TEST(test_value_behind_the_profile_is_not_read);
    RUN_TEST(test_absent_inputs_are_not_read);
    RUN_TEST(test_errors_of_all_inputs_are_said_together);
    RUN_TEST(test_whatever_the_bits_what_passes_is_in_range);
    return UNITY_END();
}
