/* SPDX-License-Identifier: MIT */
#include "belt/exponential.h"

#include "reals.h"
#include "unity.h"

void setUp(void) {
}

void tearDown(void) {
}

/* The promise of exponential.h. */
#define UNITS_IN_THE_LAST_PLACE 2.0L

/** Error of belt_expm1 in units in the last place of the true value; libm with more digits says
 * what is true. */
static long double error_in_units(belt_real_t x) {
    const long double truth = expm1l((long double)x);
    int exponent = 0;
    (void)frexpl(truth, &exponent);
    const long double unit = ldexpl((long double)BELT_REAL_EPSILON, exponent - 1);
    const long double smallest = (long double)real_from_bits(1u);
    return fabsl((long double)belt_expm1(x) - truth) / fmaxl(unit, smallest);
}

static void assert_accurate_and_in_range(belt_real_t x) {
    const belt_real_t result = belt_expm1(x);
    if (!(error_in_units(x) <= UNITS_IN_THE_LAST_PLACE) || !(result >= BELT_REAL(-1)) ||
        !(result <= BELT_REAL(0))) {
        TEST_ASSERT_EQUAL_DOUBLE_MESSAGE(expm1((double)x), (double)result, "beyond 2 units");
    }
}

static void test_zero_gives_zero(void) {
    TEST_ASSERT_TRUE(real_bits(belt_expm1(BELT_REAL(0))) == 0u);
    TEST_ASSERT_TRUE(belt_expm1(BELT_REAL(-0.0)) == BELT_REAL(0));
}

static void test_positive_argument_counts_as_zero(void) {
    const belt_real_t positive[] = {real_from_bits(1u), BELT_REAL(1e-3), BELT_REAL(1),
                                    BELT_REAL(100),     BELT_REAL_MAX,   BELT_REAL(INFINITY)};
    for (size_t i = 0; i < sizeof positive / sizeof positive[0]; ++i) {
        TEST_ASSERT_TRUE(belt_expm1(positive[i]) == BELT_REAL(0));
    }
}

static void test_nan_counts_as_zero(void) {
    TEST_ASSERT_TRUE(belt_expm1(BELT_REAL(NAN)) == BELT_REAL(0));
    TEST_ASSERT_TRUE(belt_expm1(-BELT_REAL(NAN)) == BELT_REAL(0));
}

static void test_far_below_zero_nothing_is_left_beside_minus_one(void) {
    const belt_real_t far[] = {BELT_REAL(-41), BELT_REAL(-100), BELT_REAL(-1e6), -BELT_REAL_MAX,
                               BELT_REAL(-INFINITY)};
    for (size_t i = 0; i < sizeof far / sizeof far[0]; ++i) {
        TEST_ASSERT_TRUE(belt_expm1(far[i]) == BELT_REAL(-1));
    }
}

static void test_tiny_argument_is_its_own_result(void) {
    /* The next term of the series, x*x/2, is below a quarter of a unit. */
    for (belt_real_t x = -BELT_REAL(0.25) * BELT_REAL_EPSILON; x < BELT_REAL(0);
         x *= BELT_REAL(0.37)) {
        TEST_ASSERT_TRUE(belt_expm1(x) == x);
    }
}

static void test_smallest_subnormal_number_is_its_own_result(void) {
    const belt_real_t smallest = -real_from_bits(1u);
    TEST_ASSERT_TRUE(belt_expm1(smallest) == smallest);
}

static void test_result_is_within_two_units_from_minus_fifty_to_one_billionth(void) {
    for (belt_real_t x = BELT_REAL(-50); x < BELT_REAL(-1e-9); x *= BELT_REAL(0.99998)) {
        assert_accurate_and_in_range(x);
    }
}

static void test_result_is_within_two_units_down_to_the_subnormal_numbers(void) {
    for (belt_real_t x = BELT_REAL(-1e-9); x < BELT_REAL(0); x *= BELT_REAL(0.96)) {
        assert_accurate_and_in_range(x);
        if (x == x * BELT_REAL(0.96)) {
            break; /* the smallest number rounds to itself */
        }
    }
}

static void test_result_is_within_two_units_where_the_number_of_halvings_changes(void) {
    for (int odd = 1; odd < 120; odd += 2) {
        const belt_real_t change = BELT_REAL(-0.5 * 0.69314718055994530942 * odd);
        belt_real_t below = change;
        belt_real_t above = change;
        for (int i = 0; i < 100; ++i) {
            assert_accurate_and_in_range(below);
            assert_accurate_and_in_range(above);
            below = real_next(below, BELT_REAL(-1000));
            above = real_next(above, BELT_REAL(0));
        }
    }
}

static void test_reference_number_at_minus_one(void) {
    /* 1/e - 1, to a unit in the last place of a number in [1/2, 1). */
    TEST_ASSERT_DOUBLE_WITHIN(0.5 * EPSILON, -0.63212055882855767840,
                              (double)belt_expm1(BELT_REAL(-1)));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_zero_gives_zero);
    RUN_TEST(test_positive_argument_counts_as_zero);
    RUN_TEST(test_nan_counts_as_zero);
    RUN_TEST(test_far_below_zero_nothing_is_left_beside_minus_one);
    RUN_TEST(test_tiny_argument_is_its_own_result);
    RUN_TEST(test_smallest_subnormal_number_is_its_own_result);
    RUN_TEST(test_result_is_within_two_units_from_minus_fifty_to_one_billionth);
    RUN_TEST(test_result_is_within_two_units_down_to_the_subnormal_numbers);
    RUN_TEST(test_result_is_within_two_units_where_the_number_of_halvings_changes);
    RUN_TEST(test_reference_number_at_minus_one);
    return UNITY_END();
}
