/* SPDX-License-Identifier: MIT */
/* The gains, and what estimator and line do together over many periods. */
#include "belt/estimator.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_line_t line;
static belt_estimator_gains_t gains;
static belt_estimator_t estimator;

static void begin(double level) {
    belt_line_init(&line, &config);
    belt_estimator_gains_init(&gains, &config);
    estimator = (belt_estimator_t){0};
    belt_estimator_begin(&estimator, BELT_REAL(level));
}

void setUp(void) {
    config = paper_case();
    config.estimator = BELT_ESTIMATOR_ON;
    begin(0.5);
}

void tearDown(void) {
}

/* Time constants from the shortest allowed, one period, over the default to very slow. */
static const double times[] = {0.0025, 0.005, 0.0173, 0.1, 0.37, 2.0, 25.0};
#define TIMES (sizeof times / sizeof times[0])

/* --- gains --- */

static void test_estimator_is_off_unless_it_is_asked_for(void) {
    TEST_ASSERT_EQUAL_UINT32(1u, gains.is_on);
    config.estimator = BELT_ESTIMATOR_OFF;
    begin(0.5);
    TEST_ASSERT_EQUAL_UINT32(0u, gains.is_on);
}

static void test_disturbance_is_bounded_by_what_the_law_can_make_up_for(void) {
    /* alpha*Bmax = 0.5*1.2; two roundings. */
    TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON * 0.6, 0.6, (double)gains.disturbance_max);
}

static void test_default_time_is_that_of_the_rule(void) {
    const belt_estimator_gains_t by_default = gains;
    config.estimator_time = belt_config_estimator_time(&config);
    begin(0.5);
    TEST_ASSERT_TRUE(gains.filter == by_default.filter);
    TEST_ASSERT_TRUE(gains.level == by_default.level);
    TEST_ASSERT_TRUE(gains.disturbance == by_default.disturbance);
}

static void test_gains_are_those_of_the_three_poles(void) {
    /* The product of the three poles is what the filter keeps: 1 - F = exp(-(1 + 1 + 50)*x),
     * x = period/time. At z = 1 the polynomial is F*period*M = (1 - a)^2*(1 - b), a = exp(-x),
     * b = exp(-50x); and the sum of the poles, the trace, gives F*(1 + L + period*M) = 3 - 2a - b.
     * x carries a rounding and each expm1 two units: six roundings of each of three factors. */
    for (size_t i = 0; i < TIMES; ++i) {
        config.estimator_time = BELT_REAL(times[i]);
        begin(0.5);
        const double period = (double)config.period;
        const double x = period / (double)config.estimator_time;
        const double filter = -expm1(-52.0 * x);
        const double product = -expm1(-x) * expm1(-x) * expm1(-50.0 * x);
        const double trace = -2.0 * expm1(-x) - expm1(-50.0 * x);
        TEST_ASSERT_DOUBLE_WITHIN(18 * EPSILON * filter, filter, (double)gains.filter);
        const double disturbance = product / (filter * period);
        TEST_ASSERT_DOUBLE_WITHIN(24 * EPSILON * disturbance, disturbance,
                                  (double)gains.disturbance);
        const double level = (trace - filter - product) / filter;
        TEST_ASSERT_DOUBLE_WITHIN(24 * EPSILON * level + 1e-14, level, (double)gains.level);
    }
}

static void test_gains_keep_their_ranges(void) {
    for (size_t i = 0; i < TIMES; ++i) {
        config.estimator_time = BELT_REAL(times[i]);
        begin(0.5);
        /* Of the shortest time the filter takes on all but exp(-52): 1, or a rounding beside it. */
        TEST_ASSERT_TRUE((gains.filter > BELT_REAL(0)) && ((double)gains.filter <= 1.0 + EPSILON));
        TEST_ASSERT_TRUE((gains.level > BELT_REAL(0)) && (gains.level <= BELT_REAL(1)));
        TEST_ASSERT_TRUE(gains.disturbance > BELT_REAL(0));
    }
}

static void test_error_matrix_has_the_three_poles_as_its_eigenvalues(void) {
    /* Errors of level, disturbance and the filter's content, one period on:
     *     y' = (1 - F) y + F (q + T d),  q' = q + T d - L y',  d' = d - M y'.
     * Coefficients of det(z - A) by trace, principal minors and determinant, against
     * (z - a)^2 (z - b). Each entry carries the gains' roundings, at most 24 EPSILON of 1. */
    for (size_t i = 0; i < TIMES; ++i) {
        config.estimator_time = BELT_REAL(times[i]);
        begin(0.5);
        const double T = (double)config.period;
        const double x = T / (double)config.estimator_time;
        const double a = exp(-x);
        const double b = exp(-50.0 * x);
        const double F = (double)gains.filter;
        const double L = (double)gains.level;
        const double M = (double)gains.disturbance;
        const double A[3][3] = {{1 - L * F, T * (1 - L * F), -L * (1 - F)},
                                {-M * F, 1 - M * F * T, -M * (1 - F)},
                                {F, F * T, 1 - F}};
        const double trace = A[0][0] + A[1][1] + A[2][2];
        const double minors = A[0][0] * A[1][1] - A[0][1] * A[1][0] + A[0][0] * A[2][2] -
                              A[0][2] * A[2][0] + A[1][1] * A[2][2] - A[1][2] * A[2][1];
        const double determinant = A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
                                   A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
                                   A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
        TEST_ASSERT_DOUBLE_WITHIN(72 * EPSILON, 2 * a + b, trace);
        TEST_ASSERT_DOUBLE_WITHIN(72 * EPSILON, a * a + 2 * a * b, minors);
        TEST_ASSERT_DOUBLE_WITHIN(72 * EPSILON, a * a * b, determinant);
    }
}

static void test_samples_every_few_periods_count_as_longer_periods(void) {
    config.sample_periods = 4;
    begin(0.5);
    const belt_estimator_gains_t four = gains;
    config.sample_periods = 0;
    config.period = BELT_REAL(4) * config.period;
    begin(0.5);
    /* Four times a number is exact. */
    TEST_ASSERT_TRUE(gains.filter == four.filter);
    TEST_ASSERT_TRUE(gains.level == four.level);
    TEST_ASSERT_TRUE(gains.disturbance == four.disturbance);
    config.sample_periods = 1;
    begin(0.5);
    TEST_ASSERT_TRUE(gains.filter == four.filter);
}

/* --- the error of the level in a running estimator --- */

/** One period of a buffer at full service, which makes the line straight: alpha*0.25 = mu = 0.125
 * and whatever `leak` adds. Returns the level's error. */
static double run(double *truth, double leak) {
    *truth = fmin(fmax(*truth + (double)config.period * leak, 0.0), 1.0);
    belt_estimator_expect(&estimator, &line, BELT_REAL(0.25), config.period);
    belt_estimator_correct(&estimator, &gains, &line, BELT_REAL(*truth));
    return (double)estimator.level - *truth;
}

static void test_error_obeys_the_polynomial_of_the_poles(void) {
    config.service_rate_max = BELT_REAL(0.125);
    for (size_t i = 0; i < TIMES; ++i) {
        config.estimator_time = BELT_REAL(times[i]);
        begin(0.5 + fmin(0.25, times[i])); /* the disturbance stays below its limit */
        const double x = (double)config.period / (double)config.estimator_time;
        const double a = exp(-x);
        const double b = exp(-50.0 * x);
        double truth = 0.5;
        double e[3] = {run(&truth, 0.0), run(&truth, 0.0), run(&truth, 0.0)};
        for (int k = 0; k < 100; ++k) {
            const double next = run(&truth, 0.0);
            const double wanted =
                (2 * a + b) * e[2] - (a * a + 2 * a * b) * e[1] + a * a * b * e[0];
            /* Ten roundings of a level of 0.75, once, and up to seven times in what was before; the
             * gains' 24, of an error of 0.25. */
            TEST_ASSERT_DOUBLE_WITHIN(100 * EPSILON, wanted, next);
            e[0] = e[1];
            e[1] = e[2];
            e[2] = next;
        }
    }
}

static void test_error_dies_with_the_time_constant(void) {
    config.service_rate_max = BELT_REAL(0.125);
    begin(0.75);
    double truth = 0.5;
    double error = 0.25;
    /* 20 time constants of 148 periods: (1 + 20)*exp(-20) of the error for a double pole. The
     * disturbance stands still once a share of it, M, does not change it. */
    for (int k = 0; k < 20 * 148; ++k) {
        error = run(&truth, 0.0);
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.25 * 21.0 * exp(-20.0) + 40 * EPSILON, 0.0, error);
}

/* --- no offset --- */

static void test_constant_disturbance_is_found_and_leaves_no_error(void) {
    const double leaks[] = {-0.02, 0.0, 0.015};
    config.service_rate_max = BELT_REAL(0.125);
    config.estimator_time = BELT_REAL(0.05);
    for (size_t i = 0; i < sizeof leaks / sizeof leaks[0]; ++i) {
        begin(0.5);
        double truth = 0.5;
        double error = 0.0;
        for (int k = 0; k < 2000; ++k) { /* 100 time constants; 5 s */
            error = run(&truth, leaks[i]);
        }
        /* At rest corrections are below half a rounding of a level of up to 1, EPSILON/2 over
         * L = 0.08, and the drift of a period, T times the disturbance's error, is no larger. */
        TEST_ASSERT_DOUBLE_WITHIN(10 * EPSILON, 0.0, error);
        TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON / 0.0025, leaks[i], (double)estimator.disturbance);
    }
}

static void test_wrong_connectivity_ends_up_in_the_disturbance(void) {
    /* The line has alpha 0.4, so that of a flux of 0.6 0.06 less arrives; level at rest 0.24. */
    begin(0.3);
    for (int k = 0; k < 80 * 148;
         ++k) { /* service that follows the level halves the slowest pole */
        belt_estimator_expect(&estimator, &line, BELT_REAL(0.6), config.period);
        belt_estimator_correct(&estimator, &gains, &line, BELT_REAL(0.24));
    }
    /* A rounding of the level in every period of one time constant, 148 of them. */
    TEST_ASSERT_DOUBLE_WITHIN(148 * EPSILON * 0.24, 0.24, (double)estimator.level);
    TEST_ASSERT_DOUBLE_WITHIN(EPSILON / 0.0025, -0.06, (double)estimator.disturbance);
}

/* --- at the ends of the buffer --- */

static void test_spilling_buffer_says_nothing_about_the_disturbance(void) {
    begin(1.0);
    estimator.disturbance = BELT_REAL(0.125);
    for (int k = 0; k < 10000; ++k) {
        belt_estimator_expect(&estimator, &line, BELT_REAL(2), config.period); /* 1 + 0.125 > 0.8 */
        belt_estimator_correct(&estimator, &gains, &line, BELT_REAL(1));
        TEST_ASSERT_TRUE(estimator.disturbance == BELT_REAL(0.125));
        TEST_ASSERT_TRUE(estimator.level == BELT_REAL(1));
    }
}

static void test_empty_buffer_says_nothing_about_the_disturbance(void) {
    begin(0.0);
    estimator.disturbance = BELT_REAL(-0.125);
    for (int k = 0; k < 10000; ++k) {
        belt_estimator_expect(&estimator, &line, BELT_REAL(0.125), config.period);
        belt_estimator_correct(&estimator, &gains, &line, BELT_REAL(0));
        TEST_ASSERT_TRUE(estimator.disturbance == BELT_REAL(-0.125));
        TEST_ASSERT_TRUE(estimator.level == BELT_REAL(0));
    }
}

static void test_senseless_state_is_forgotten(void) {
    for (int field = 0; field < 3; ++field) {
        config.estimator_time = BELT_REAL(0.05);
        begin(0.5);
        belt_real_t *const fields[] = {&estimator.level, &estimator.difference,
                                       &estimator.disturbance};
        *fields[field] = BELT_REAL(NAN);
        for (int k = 0; k < 2000; ++k) {
            belt_estimator_expect(&estimator, &line, BELT_REAL(1), config.period);
            belt_estimator_correct(&estimator, &gains, &line, BELT_REAL(0.5));
        }
        /* As for a constant disturbance of nothing: 0.5*1 flows in, 0.5 is served. */
        TEST_ASSERT_DOUBLE_WITHIN(10 * EPSILON, 0.5, (double)estimator.level);
        TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON / 0.0025, 0.0, (double)estimator.disturbance);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_estimator_is_off_unless_it_is_asked_for);
    RUN_TEST(test_disturbance_is_bounded_by_what_the_law_can_make_up_for);
    RUN_TEST(test_default_time_is_that_of_the_rule);
    RUN_TEST(test_gains_are_those_of_the_three_poles);
    RUN_TEST(test_gains_keep_their_ranges);
    RUN_TEST(test_error_matrix_has_the_three_poles_as_its_eigenvalues);
    RUN_TEST(test_samples_every_few_periods_count_as_longer_periods);
    RUN_TEST(test_error_obeys_the_polynomial_of_the_poles);
    RUN_TEST(test_error_dies_with_the_time_constant);
    RUN_TEST(test_constant_disturbance_is_found_and_leaves_no_error);
    RUN_TEST(test_wrong_connectivity_ends_up_in_the_disturbance);
    RUN_TEST(test_spilling_buffer_says_nothing_about_the_disturbance);
    RUN_TEST(test_empty_buffer_says_nothing_about_the_disturbance);
    RUN_TEST(test_senseless_state_is_forgotten);
    return UNITY_END();
}
