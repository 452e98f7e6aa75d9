/* SPDX-License-Identifier: MIT */
/* What a density profile may be. */
#include "gate_case.h"

void setUp(void) {
    begin_with_all_inputs();
}

void tearDown(void) {
}

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

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_null_density_is_invalid);
    RUN_TEST(test_null_density_that_is_not_present_is_no_error);
    RUN_TEST(test_one_senseless_value_anywhere_refuses_the_profile);
    RUN_TEST(test_one_negative_value_anywhere_refuses_the_profile_as_out_of_range);
    RUN_TEST(test_negative_and_senseless_values_in_one_profile_are_both_said);
    RUN_TEST(test_value_behind_the_profile_is_not_read);
    return UNITY_END();
}
