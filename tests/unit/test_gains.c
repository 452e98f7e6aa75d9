/* SPDX-License-Identifier: MIT */
#include "belt/exponential.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

/* The stage with its exponentials counted: one a Newton step. */
static unsigned exponentials;

static belt_real_t counted_expm1(belt_real_t x) {
    ++exponentials;
    return belt_expm1(x);
}

#define belt_expm1 counted_expm1
#include "belt/gains.c"
#undef belt_expm1

static belt_config_t config;

void setUp(void) {
    config = paper_case();
}

void tearDown(void) {
}

/** Root of x = s*(1 - exp(-x)) by bisection, to the last place of a double. */
static double root_by_bisection(double steepness) {
    double low = (steepness - 1.0) / steepness; /* the root lies above: 1 - exp(-x) > x/(1 + x) */
    double high = steepness;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle + steepness * expm1(-middle) < 0.0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

#define STEEPNESS_FACTOR 1.01

/* Steepness - 1 from 1e-6 to 1e4, each rounded to the build's numbers. */
static belt_real_t next_steepness(belt_real_t steepness) {
    const belt_real_t less_one = (steepness - BELT_REAL(1)) * BELT_REAL(STEEPNESS_FACTOR);
    const belt_real_t further = BELT_REAL(1) + less_one;
    return (further > steepness) ? further : real_next(steepness, BELT_REAL_MAX);
}

static void assert_gain(double slope, double reach, double flux, belt_real_t gain) {
    /* flux*gain = slope*(1 - exp(-gain*reach)), eq:lambda_left and _right. Five roundings on the
     * way to the steepness, and Newton's own two; where exp(-gain*reach) is not small they move
     * the gain by up to 1/(steepness - 1) times as much. */
    const double steepness = slope * reach / flux;
    const double tolerance = 8.0 * EPSILON * (1.0 + 1.0 / (steepness - 1.0));
    const double root = root_by_bisection(steepness) / reach;
    TEST_ASSERT_TRUE(gain > BELT_REAL(0));
    TEST_ASSERT_DOUBLE_WITHIN(tolerance * root, root, (double)gain);
}

static void assert_both_gains(void) {
    const belt_gains_t gains = belt_gains_solve(&config);
    const double flux =
        (double)config.level_setpoint / ((double)config.connectivity * (double)config.service_time);
    const double below = (double)config.nominal_flux_max - flux;
    const double reach = (double)config.level_capacity - (double)config.level_setpoint;
    const double least = fmax(below / (double)config.level_setpoint, flux / reach);
    const double slope =
        (double)config.slope + ((config.slope_kind == BELT_SLOPE_MARGIN) ? least : 0.0);
    assert_gain(slope, (double)config.level_setpoint, below, gains.below);
    assert_gain(slope, reach, flux, gains.above);
}

static void test_root_of_steepness_with_root_one(void) {
    /* x = 1: s = 1/(1 - exp(-1)). s is rounded once, Newton adds two roundings; the root moves
     * 1/(1 - s*exp(-1)) = 2.4 times as much. */
    const double steepness = -1.0 / expm1(-1.0);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON, 1.0, (double)belt_gains_root(BELT_REAL(steepness)));
}

static void test_steep_root_is_the_steepness(void) {
    /* exp(-x) is below the last place. */
    TEST_ASSERT_TRUE(belt_gains_root(BELT_REAL(100)) == BELT_REAL(100));
    TEST_ASSERT_TRUE(belt_gains_root(BELT_REAL(1e4)) == BELT_REAL(1e4));
    TEST_ASSERT_TRUE(belt_gains_root(BELT_REAL(1e12)) == BELT_REAL(1e12));
}

static void test_root_is_that_of_bisection_for_every_steepness(void) {
    for (belt_real_t s = BELT_REAL(1) + BELT_REAL(1e-6); s < BELT_REAL(1e4);
         s = next_steepness(s)) {
        const double root = root_by_bisection((double)s);
        /* A few units in the last place of steepness - 1, as gains.h promises: of 1, while the root
         * is small, and of the root itself above. */
        TEST_ASSERT_DOUBLE_WITHIN(4.0 * EPSILON * fmax(1.0, root), root,
                                  (double)belt_gains_root(s));
    }
}

static void test_residual_is_a_rounding_for_every_steepness(void) {
    for (belt_real_t s = BELT_REAL(1) + BELT_REAL(1e-6); s < BELT_REAL(1e4);
         s = next_steepness(s)) {
        const double x = (double)belt_gains_root(s);
        TEST_ASSERT_TRUE(x > 0.0);
        /* Both terms are as large as x; the exponential carries two units in the last place, their
         * product and sum one more each. */
        TEST_ASSERT_DOUBLE_WITHIN(4.0 * EPSILON * x, 0.0, x + (double)s * expm1(-x));
    }
}

static void test_steps_are_eight_or_fewer_and_one_that_finds_nothing_better(void) {
    for (belt_real_t s = BELT_REAL(1) + BELT_REAL(1e-6); s < BELT_REAL(1e13);
         s = next_steepness(s)) {
        exponentials = 0;
        (void)belt_gains_root(s);
        TEST_ASSERT_LESS_OR_EQUAL_UINT(9u, exponentials);
    }
}

static void test_steps_are_bounded_whatever_the_steepness(void) {
    const belt_real_t senseless[] = {BELT_REAL(NAN), BELT_REAL(INFINITY), BELT_REAL(0),
                                     BELT_REAL(-1),  BELT_REAL(1),        BELT_REAL_MAX};
    for (size_t i = 0; i < sizeof senseless / sizeof senseless[0]; ++i) {
        exponentials = 0;
        (void)belt_gains_root(senseless[i]);
        TEST_ASSERT_LESS_OR_EQUAL_UINT(BELT_GAIN_ITERATIONS, exponentials);
    }
}

static void test_both_equations_hold_for_every_setpoint_and_slope(void) {
    for (int share = 1; share < 40; ++share) {
        config.level_setpoint = BELT_REAL(0.6) * BELT_REAL(share) / BELT_REAL(40);
        for (double margin = 1e-3; margin < 300.0; margin *= 1.7) {
            config.slope = BELT_REAL(margin);
            TEST_ASSERT_EQUAL(BELT_OK, belt_config_check(&config, NULL));
            assert_both_gains();
        }
    }
}

static void test_service_time_enters_the_flux_that_holds_the_setpoint(void) {
    config.service_time = BELT_REAL(1.25);
    assert_both_gains();
}

static void test_slope_just_above_the_least_gives_gains_above_zero(void) {
    /* A unit in the last place of S above Smin, for many set-points: what the check accepts, the
     * law must bear. */
    config.slope_kind = BELT_SLOPE_ABSOLUTE;
    for (int share = 1; share < 200; ++share) {
        config.level_setpoint = BELT_REAL(0.6) * BELT_REAL(share) / BELT_REAL(200);
        config.slope = real_next(belt_config_slope_min(&config), BELT_REAL_MAX);
        if (belt_config_check(&config, NULL) == BELT_OK) {
            const belt_gains_t gains = belt_gains_solve(&config);
            TEST_ASSERT_TRUE(gains.below > BELT_REAL(0));
            TEST_ASSERT_TRUE(gains.above > BELT_REAL(0));
        }
    }
}

static void test_gains_of_the_papers_case(void) {
    const belt_gains_t gains = belt_gains_solve(&config);
    /* Roots of x = 11*(1 - exp(-x)) over 0.3 and of x = 77/3*(1 - exp(-x)) over 0.7, to four
     * decimals; the paper prints 36.667 for both. */
    TEST_ASSERT_DOUBLE_WITHIN(5e-5, 36.6661, (double)gains.below);
    TEST_ASSERT_DOUBLE_WITHIN(5e-5, 36.6667, (double)gains.above);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_root_of_steepness_with_root_one);
    RUN_TEST(test_steep_root_is_the_steepness);
    RUN_TEST(test_root_is_that_of_bisection_for_every_steepness);
    RUN_TEST(test_residual_is_a_rounding_for_every_steepness);
    RUN_TEST(test_steps_are_eight_or_fewer_and_one_that_finds_nothing_better);
    RUN_TEST(test_steps_are_bounded_whatever_the_steepness);
    RUN_TEST(test_both_equations_hold_for_every_setpoint_and_slope);
    RUN_TEST(test_service_time_enters_the_flux_that_holds_the_setpoint);
    RUN_TEST(test_slope_just_above_the_least_gives_gains_above_zero);
    RUN_TEST(test_gains_of_the_papers_case);
    return UNITY_END();
}
