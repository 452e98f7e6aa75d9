/* SPDX-License-Identifier: MIT */
/* What level and fluxes may be. How the level fares from period to period is in test_measurement_level.c. */
#include "gate_case.h"

void setUp(void) {
    begin_with_all_inputs();
}

void tearDown(void) {
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
    TEST_ASSERT_EQUAL_UINT32(1u, trusted.periods);
}

/* Any level and any applied flux: what they may be next to the last one has its own tests. */
static void allow_any_change(void) {
    limits.level_step_max = BELT_REAL(4);
    limits.flux_tolerance = BELT_REAL_MAX;
}

static void test_limits_themselves_are_sound(void) {
    allow_any_change();
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
    allow_any_change();
    for (size_t i = 0; i < COUNT(small); ++i) {
        measurement.level = small[i];
        measurement.outlet_flux = small[i];
        measurement.applied_flux = small[i];
        density[3] = small[i];
        TEST_ASSERT_EQUAL_HEX32(0u, gate().error_bits);
    }
}

/* --- the level --- */

static void assert_last_level_stands_in(uint32_t error_bits) {
    memory.level = BELT_REAL(0.375);
    const belt_trusted_t trusted = gate();
    TEST_ASSERT_EQUAL_HEX32(error_bits, trusted.error_bits);
    TEST_ASSERT_TRUE(trusted.level == BELT_REAL(0.375));
    TEST_ASSERT_FALSE(trusted.level_is_new);
}

static void test_missing_level_is_said_and_the_last_one_stands_in(void) {
    measurement.present = ALL_PRESENT & ~BELT_HAS_LEVEL;
    assert_last_level_stands_in(BELT_ERROR_LEVEL_MISSING);
}

static void test_level_that_is_no_number_is_invalid_and_the_last_one_stands_in(void) {
    belt_real_t levels[SENSELESS_CAPACITY];
    const size_t count = senseless_numbers(levels);
    for (size_t i = 0; i < count; ++i) {
        memcpy(&measurement.level, &levels[i], sizeof levels[i]);
        assert_last_level_stands_in(BELT_ERROR_LEVEL_INVALID);
    }
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
    allow_any_change();
    assert_level_is_clamped(real_next(full, BELT_REAL_MAX), full);
    assert_level_is_clamped(full + BELT_LEVEL_MARGIN * full, full);
    assert_level_is_clamped(-real_from_bits(1u), BELT_REAL(0));
    assert_level_is_clamped(-BELT_LEVEL_MARGIN * full, BELT_REAL(0));
}

static void test_level_further_out_than_the_margin_is_invalid(void) {
    const belt_real_t margin = BELT_LEVEL_MARGIN * config.level_capacity;
    const belt_real_t far[] = {real_next(config.level_capacity + margin, BELT_REAL_MAX),
                               BELT_REAL_MAX, real_next(-margin, -BELT_REAL_MAX), -BELT_REAL_MAX};
    allow_any_change();
    for (size_t i = 0; i < COUNT(far); ++i) {
        measurement.level = far[i];
        assert_last_level_stands_in(BELT_ERROR_LEVEL_INVALID);
    }
}

/* --- the fluxes --- */

/* Everything that is no flux. */
static size_t senseless_fluxes(belt_real_t *fluxes) {
    size_t count = senseless_numbers(fluxes);
    fluxes[count++] = BELT_REAL_MAX;
    fluxes[count++] = -BELT_REAL_MAX;
    fluxes[count++] = real_next(line.flux_bound, BELT_REAL_MAX);
    fluxes[count++] = -real_from_bits(1u);
    return count;
}

static bool is_within(belt_real_t value, belt_real_t bound) {
    return (value >= BELT_REAL(0)) && (value <= bound);
}

static void test_senseless_outlet_flux_is_not_used(void) {
    belt_real_t fluxes[SENSELESS_CAPACITY];
    const size_t count = senseless_fluxes(fluxes);
    for (size_t i = 0; i < count; ++i) {
        memcpy(&measurement.outlet_flux, &fluxes[i], sizeof fluxes[i]);
        const belt_trusted_t trusted = gate();
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_OUTLET_FLUX_INVALID, trusted.error_bits);
        TEST_ASSERT_FALSE(trusted.has_outlet_flux);
        TEST_ASSERT_TRUE(is_within(trusted.outlet_flux, line.flux_bound));
    }
}

static void test_missing_outlet_flux_is_no_error(void) {
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

static void test_whatever_the_bits_what_passes_is_in_range(void) {
    uint64_t random = 0x9E3779B97F4A7C15u;
    for (int i = 0; i < 200000; ++i) {
        measurement.present = (uint32_t)random_bits(&random);
        store(&measurement.level, random_bits(&random));
        store(&measurement.outlet_flux, random_bits(&random));
        store(&measurement.applied_flux, random_bits(&random));
        store(&density[i % (int)(config.node_count + 1u)], random_bits(&random));
        measurement.sample_count = (uint32_t)random_bits(&random) & 3u;
        measurement.elapsed_ticks = (uint32_t)random_bits(&random) >> (i % 32);
        const belt_trusted_t trusted = step();
        TEST_ASSERT_TRUE(is_within(trusted.level, config.level_capacity));
        TEST_ASSERT_TRUE(is_within(trusted.applied_flux, line.flux_bound));
        TEST_ASSERT_TRUE(is_within(trusted.outlet_flux, line.flux_bound));
        if (trusted.has_density) {
            for (size_t node = 0; node <= config.node_count; ++node) {
                TEST_ASSERT_TRUE(is_within(density[node], line.density_bound));
            }
        }
        TEST_ASSERT_TRUE(trusted.periods <= BELT_CATCH_UP_PERIODS);
        TEST_ASSERT_TRUE(is_within(memory.level_quality, BELT_REAL(1)));
        TEST_ASSERT_TRUE(memory.health <= BELT_LEVEL_LOST);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_bounds_are_ten_times_what_the_law_can_ask_for);
    RUN_TEST(test_bounds_grow_with_the_congestion_the_line_can_have);
    RUN_TEST(test_the_most_that_losses_can_make_the_law_ask_for_is_sound);
    RUN_TEST(test_sound_inputs_pass_unchanged);
    RUN_TEST(test_limits_themselves_are_sound);
    RUN_TEST(test_negative_zero_and_subnormal_numbers_are_sound);
    RUN_TEST(test_missing_level_is_said_and_the_last_one_stands_in);
    RUN_TEST(test_level_that_is_no_number_is_invalid_and_the_last_one_stands_in);
    RUN_TEST(test_level_out_of_range_is_clamped_and_counts_as_new);
    RUN_TEST(test_level_further_out_than_the_margin_is_invalid);
    RUN_TEST(test_senseless_outlet_flux_is_not_used);
    RUN_TEST(test_missing_outlet_flux_is_no_error);
    RUN_TEST(test_command_stands_in_for_a_senseless_applied_flux);
    RUN_TEST(test_command_stands_in_for_a_missing_applied_flux_without_error);
    RUN_TEST(test_absent_inputs_are_not_read);
    RUN_TEST(test_errors_of_all_inputs_are_said_together);
    RUN_TEST(test_whatever_the_bits_what_passes_is_in_range);
    return UNITY_END();
}
