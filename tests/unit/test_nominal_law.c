/* SPDX-License-Identifier: MIT */
#include "belt/nominal_law.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_nominal_law_t law;

void setUp(void) {
    config = paper_case();
    belt_nominal_law_init(&law, &config);
}

void tearDown(void) {
}

static belt_real_t flux(double level) {
    return belt_nominal_law_flux(&law, BELT_REAL(level));
}

/* Gains and reaches carry a dozen roundings of numbers not above Bmax; the largest, of the gain in
 * the exponent, counts Lambda*Q* = 11 times less than exp(-11) shows. */
#define ROUNDING (12.0 * EPSILON * 1.2)

/* Set-points and slopes from gentle to steep. */
#define CASES 12
static void take_case(int i) {
    config = paper_case();
    config.level_setpoint = BELT_REAL(0.08) + BELT_REAL(0.04) * BELT_REAL(i);
    config.slope = BELT_REAL(pow(2.5, i - 6));
    TEST_ASSERT_EQUAL(BELT_OK, belt_config_check(&config, NULL));
    belt_nominal_law_init(&law, &config);
}

static void test_empty_buffer_gets_the_greatest_flux(void) {
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 1.2, (double)flux(0.0));
}

static void test_setpoint_gets_exactly_the_flux_that_holds_it(void) {
    for (int i = 0; i < CASES; ++i) {
        take_case(i);
        TEST_ASSERT_TRUE(belt_nominal_law_flux(&law, config.level_setpoint) ==
                         belt_config_setpoint_flux(&config));
    }
}

static void test_full_buffer_gets_nothing(void) {
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING, 0.0, (double)flux(1.0));
}

static void test_ends_are_met_for_gentle_and_steep_laws(void) {
    for (int i = 0; i < CASES; ++i) {
        take_case(i);
        /* The steepness carries 8 roundings; near 1 a branch is a straight line through two
         * differences and keeps them, so twice the rounding of the paper's case. */
        TEST_ASSERT_DOUBLE_WITHIN(2 * ROUNDING, 1.2, (double)flux(0.0));
        TEST_ASSERT_DOUBLE_WITHIN(2 * ROUNDING, 0.0, (double)flux(1.0));
    }
}

static void test_law_follows_its_two_equations(void) {
    /* bangBl, bangBr with the gains the struct shows. */
    for (int i = 0; i < CASES; ++i) {
        take_case(i);
        const double below = (double)law.gains.below;
        const double above = (double)law.gains.above;
        const double setpoint = (double)config.level_setpoint;
        const double hold = setpoint / (double)config.connectivity;
        for (double level = 0.0; level <= 1.0; level += 0.001) {
            const double truth = (level <= setpoint)
                                     ? hold + (1.2 - hold) * expm1(-below * (setpoint - level)) /
                                                  expm1(-below * setpoint)
                                     : hold - hold * expm1(-above * (level - setpoint)) /
                                                  expm1(-above * (1.0 - setpoint));
            TEST_ASSERT_DOUBLE_WITHIN(2 * ROUNDING, truth, (double)flux(level));
        }
    }
}

static void test_value_is_continuous_at_the_setpoint(void) {
    const belt_real_t setpoint = config.level_setpoint;
    const double below = (double)belt_nominal_law_flux(&law, real_next(setpoint, BELT_REAL(0)));
    const double above = (double)belt_nominal_law_flux(&law, real_next(setpoint, BELT_REAL(1)));
    /* A neighbour is at most 0.25*EPSILON away, at a slope of 22, plus the rounding of the flux. */
    TEST_ASSERT_DOUBLE_WITHIN((0.25 * 22.0 + 1.0) * EPSILON, 0.6, below);
    TEST_ASSERT_DOUBLE_WITHIN((0.25 * 22.0 + 1.0) * EPSILON, 0.6, above);
}

/** Slope from the set-point to `step` beyond it, by a difference. */
static double slope_towards(double step) {
    const double from = (double)config.level_setpoint;
    const belt_real_t to = BELT_REAL(from + step);
    return ((double)belt_nominal_law_flux(&law, to) - (double)law.setpoint_flux) /
           ((double)to - from);
}

static void test_slope_is_the_configured_one_on_both_sides_of_the_setpoint(void) {
    /* Over 1e-3 the difference falls short of the slope by Lambda*1e-3/2 = 1.8 %, known and taken
     * away; what remains is (Lambda*1e-3)^2/6 = 2.2e-4 of it. */
    const double step = 1e-3;
    const double gain = 110.0 / 3.0;
    TEST_ASSERT_DOUBLE_WITHIN(3e-4 * 22.0, -22.0, slope_towards(step) / (1.0 - 0.5 * gain * step));
    TEST_ASSERT_DOUBLE_WITHIN(3e-4 * 22.0, -22.0, slope_towards(-step) / (1.0 - 0.5 * gain * step));
}

static void test_law_never_rises_with_the_level(void) {
    for (int i = 0; i < CASES; ++i) {
        take_case(i);
        double before = (double)flux(0.0);
        for (double level = 0.0; level <= 1.0; level += 0.0005) {
            const double now = (double)flux(level);
            /* Where a branch is flat only the roundings of exponential, product and sum show. */
            TEST_ASSERT_TRUE(now <= before + 4 * EPSILON);
            before = now;
        }
    }
}

static void test_law_falls_strictly_around_the_setpoint(void) {
    for (double level = 0.15; level < 0.45; level += 0.001) {
        TEST_ASSERT_TRUE(flux(level) > flux(level + 0.001));
    }
}

static void test_law_stays_between_nothing_and_the_greatest_flux(void) {
    for (int i = 0; i < CASES; ++i) {
        take_case(i);
        for (double level = -0.1; level <= 1.1; level += 0.0005) {
            TEST_ASSERT_TRUE((double)flux(level) <= 1.2 + 2 * ROUNDING);
            TEST_ASSERT_TRUE(flux(level) >= BELT_REAL(0));
        }
    }
}

static void test_levels_outside_count_as_the_ends(void) {
    const belt_real_t empty = belt_nominal_law_flux(&law, BELT_REAL(0));
    const belt_real_t full = belt_nominal_law_flux(&law, config.level_capacity);
    TEST_ASSERT_TRUE(flux(-1e-6) == empty);
    TEST_ASSERT_TRUE(flux(-1e30) == empty);
    TEST_ASSERT_TRUE(flux(-INFINITY) == empty);
    TEST_ASSERT_TRUE(flux(1.001) == full);
    TEST_ASSERT_TRUE(flux(1e30) == full);
    TEST_ASSERT_TRUE(flux(INFINITY) == full);
}

static void test_level_that_is_no_number_gets_a_flux_within_the_law(void) {
    const belt_real_t result = flux(NAN);
    TEST_ASSERT_TRUE((result >= BELT_REAL(0)) && ((double)result <= 1.2 + ROUNDING));
}

static void test_reference_numbers_of_the_papers_case(void) {
    /* From the equations with both gains 36.6660 and 36.6667: u(0.25) = 1.1041, u(0.35) = 0.0959.
     * Four decimals. */
    TEST_ASSERT_DOUBLE_WITHIN(5e-5, 1.1041, (double)flux(0.25));
    TEST_ASSERT_DOUBLE_WITHIN(5e-5, 0.0959, (double)flux(0.35));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_empty_buffer_gets_the_greatest_flux);
    RUN_TEST(test_setpoint_gets_exactly_the_flux_that_holds_it);
    RUN_TEST(test_full_buffer_gets_nothing);
    RUN_TEST(test_ends_are_met_for_gentle_and_steep_laws);
    RUN_TEST(test_law_follows_its_two_equations);
    RUN_TEST(test_value_is_continuous_at_the_setpoint);
    RUN_TEST(test_slope_is_the_configured_one_on_both_sides_of_the_setpoint);
    RUN_TEST(test_law_never_rises_with_the_level);
    RUN_TEST(test_law_falls_strictly_around_the_setpoint);
    RUN_TEST(test_law_stays_between_nothing_and_the_greatest_flux);
    RUN_TEST(test_levels_outside_count_as_the_ends);
    RUN_TEST(test_level_that_is_no_number_gets_a_flux_within_the_law);
    RUN_TEST(test_reference_numbers_of_the_papers_case);
    return UNITY_END();
}
