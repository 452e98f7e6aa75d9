/* SPDX-License-Identifier: MIT */
#include "belt/fast_forward.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

#define STRETCHES 10

static belt_config_t config;
static belt_line_t line;
static belt_real_t width[STRETCHES];
static belt_real_t pace[STRETCHES];
static belt_real_t outlet_density[STRETCHES];
static belt_passed_t passed;

static void begin(double loss_at_outlet, double loss_at_inlet, double rework) {
    config = paper_case();
    config.loss_count = 2;
    config.loss_rate[0] = BELT_REAL(loss_at_outlet);
    config.loss_rate[1] = BELT_REAL(loss_at_inlet);
    config.rework_rate = BELT_REAL(rework);
    belt_line_init(&line, &config);
}

/** `count` stretches 2 spacings wide, all at one pace, all leaving with one density. */
static void pass(uint32_t count, double one_pace, double density) {
    for (uint32_t i = 0; i < count; ++i) {
        width[i] = BELT_REAL(2);
        pace[i] = BELT_REAL(one_pace);
        outlet_density[i] = BELT_REAL(density);
    }
    passed = (belt_passed_t){width, pace, outlet_density, count};
}

void setUp(void) {
    begin(1.0, 1.0, 0.1);
    pass(STRETCHES, 0.025, 0.5);
}

void tearDown(void) {
}

/** What the series of the survival falls short by, over `ways`. */
static double series_error(double loss, double ways) {
    return ways * loss * loss * loss * loss / 24.0;
}

/* Four roundings a stretch of numbers up to 1. */
#define ROUNDING (4 * STRETCHES * EPSILON)

static void test_nothing_passed_changes_nothing(void) {
    pass(0, 0.025, 0.5);
    const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(7.25));
    TEST_ASSERT_TRUE(transfer.survival == BELT_REAL(1));
    TEST_ASSERT_TRUE(transfer.rework == BELT_REAL(0));
}

static void test_no_loss_and_no_rework_changes_nothing(void) {
    begin(0.0, 0.0, 0.0);
    belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(20));
    belt_fast_forward_last(&transfer, &line, BELT_REAL(0.5), BELT_REAL(0.025), BELT_REAL(1));
    TEST_ASSERT_TRUE(transfer.survival == BELT_REAL(1));
    TEST_ASSERT_TRUE(transfer.rework == BELT_REAL(0));
}

static void test_constant_loss_at_constant_pace_is_exponential(void) {
    for (uint32_t count = 1; count <= STRETCHES; ++count) {
        pass(count, 0.025, 0.0);
        const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(20));
        TEST_ASSERT_DOUBLE_WITHIN(series_error(0.05, count) + ROUNDING, exp(-0.05 * count),
                                  (double)transfer.survival);
        TEST_ASSERT_TRUE(transfer.rework == BELT_REAL(0));
    }
}

static void test_every_stretch_takes_its_own_pace_and_width(void) {
    double time = 0.0;
    for (uint32_t i = 0; i < STRETCHES; ++i) {
        width[i] = BELT_REAL((i % 3u == 0u) ? 1.0 : 2.0);
        pace[i] = BELT_REAL(0.02 + 0.002 * i);
        time += (double)width[i] * (double)pace[i];
    }
    const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(18.5));
    TEST_ASSERT_DOUBLE_WITHIN(series_error(0.08, STRETCHES) + ROUNDING, exp(-time),
                              (double)transfer.survival);
}

static void test_rework_of_a_known_outlet_density_without_loss(void) {
    /* From 20 spacings on over 2*count: A*v*pace*spacing*integral of y, y spacings from the inlet;
     * the middle of each stretch is exact. 0.1*0.1*0.5*0.025*(2*count)^2/2. */
    begin(0.0, 0.0, 0.1);
    for (uint32_t count = 1; count <= STRETCHES; ++count) {
        pass(count, 0.025, 0.5);
        const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(20));
        const double way = 2.0 * count;
        TEST_ASSERT_DOUBLE_WITHIN(ROUNDING * 0.025, 0.000125 * 0.5 * way * way,
                                  (double)transfer.rework);
    }
}

static void test_rework_of_a_piece_that_starts_further_out_is_larger(void) {
    /* From 12 to 4: y runs from 8 to 16. */
    begin(0.0, 0.0, 0.1);
    pass(4, 0.025, 0.5);
    const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(12));
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING * 0.025, 0.000125 * 0.5 * (256.0 - 64.0),
                              (double)transfer.rework);
}

static void test_rework_of_each_stretch_is_that_of_the_density_then_leaving(void) {
    begin(0.0, 0.0, 0.1);
    double truth = 0.0;
    for (uint32_t i = 0; i < STRETCHES; ++i) {
        outlet_density[i] = BELT_REAL(0.1 * i);
        truth += 0.00025 * 0.1 * i * 2.0 * (2.0 * i + 1.0);
    }
    const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(20));
    TEST_ASSERT_DOUBLE_WITHIN(ROUNDING * 0.05, truth, (double)transfer.rework);
}

static void test_rework_is_lost_on_the_way_too(void) {
    /* A*v*w*(a/C - (1 - exp(-C*a))/C^2), a = 0.5, w = 4. */
    const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(20));
    const double truth = 0.1 * 0.5 * 4.0 * (0.5 + expm1(-0.5));
    /* Second order in the loss of a stretch, 0.05: a sixth of its square for keeping half of it, as
     * much each for the place in the stretch and for the pieces' own slope. */
    TEST_ASSERT_DOUBLE_WITHIN((3.0 / 6.0 * 0.05 * 0.05 + ROUNDING) * truth, truth,
                              (double)transfer.rework);
}

static void test_linear_loss_profile_is_the_exponential_of_its_integral(void) {
    /* C = 2*x/D: from the inlet over k spacings the exponent is 0.025*(k - k*k/40)*2. */
    begin(0.0, 2.0, 0.0);
    for (uint32_t count = 1; count <= STRETCHES; ++count) {
        pass(count, 0.025, 0.5);
        const double way = 2.0 * count;
        const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(20));
        TEST_ASSERT_DOUBLE_WITHIN(series_error(0.1, count) + ROUNDING,
                                  exp(-0.05 * (way - way * way / 40.0)), (double)transfer.survival);
    }
}

static void test_loss_profile_is_met_from_the_place_where_the_piece_lies(void) {
    /* From 12 to 4 spacings: 0.1 a spacing, the mean place 8: 0.8*0.025*8. */
    begin(0.0, 2.0, 0.0);
    pass(4, 0.025, 0.5);
    const belt_transfer_t transfer = belt_fast_forward(&line, &passed, BELT_REAL(12));
    TEST_ASSERT_DOUBLE_WITHIN(series_error(0.06, 4.0) + ROUNDING, exp(-0.16),
                              (double)transfer.survival);
}

static void test_last_way_is_added(void) {
    belt_transfer_t transfer = {BELT_REAL(0.5), BELT_REAL(0.25)};
    belt_fast_forward_last(&transfer, &line, BELT_REAL(1.5), BELT_REAL(0.025), BELT_REAL(0.5));
    const double kept = exp(-0.0375);
    TEST_ASSERT_DOUBLE_WITHIN(series_error(0.0375, 1.0) + ROUNDING, 0.5 * kept,
                              (double)transfer.survival);
    /* Rework on the way: A*(D - x) in its middle, x = 0.075 m; half of its loss kept. */
    const double gained = 0.1 * (2.0 - 0.075) * 0.5 * 0.0375 * (1.0 - 0.5 * 0.0375);
    TEST_ASSERT_DOUBLE_WITHIN(series_error(0.0375, 1.0) + ROUNDING + 0.5 * 0.0375 * 0.0375 * gained,
                              0.25 * kept + gained, (double)transfer.rework);
}

static void test_last_way_of_no_length_changes_nothing(void) {
    belt_transfer_t transfer = {BELT_REAL(0.5), BELT_REAL(0.25)};
    belt_fast_forward_last(&transfer, &line, BELT_REAL(0), BELT_REAL(0.025), BELT_REAL(0.5));
    TEST_ASSERT_TRUE(transfer.survival == BELT_REAL(0.5));
    TEST_ASSERT_TRUE(transfer.rework == BELT_REAL(0.25));
}

/** A way of 2 spacings on which half is lost or so, far beyond what a configuration may have: what is kept
 * is off by the first term that the series leaves out, what stays of the rework by that over the loss. The
 * rework's rate falls along the belt; where it is taken is right up to loss^3/720 of the way. */
static void test_way_of_a_great_loss_is_the_exponential_up_to_the_fifth_power(void) {
    const double loss = 0.5;
    begin(1.0, 1.0, 0.1);
    belt_transfer_t transfer = {BELT_REAL(1), BELT_REAL(0)};
    belt_fast_forward_last(&transfer, &line, BELT_REAL(2), BELT_REAL(0.5 * loss), BELT_REAL(1));
    const double kept = exp(-loss);
    TEST_ASSERT_DOUBLE_WITHIN(pow(loss, 5.0) / 120.0 + ROUNDING, kept, (double)transfer.survival);
    /* Integral of A*(20 - place)*spacing*exp(-loss*place/2) over the way and its time, which is `loss`. */
    const double staying = (1.0 - kept) / loss;
    const double leaning = (1.0 - kept * (1.0 + loss)) / (loss * loss);
    const double put_back = 0.1 * 0.1 * loss * (20.0 * staying - 2.0 * leaning);
    const double greatest = 0.1 * 2.0 * loss;
    TEST_ASSERT_DOUBLE_WITHIN(
        greatest * (pow(loss, 4.0) / 120.0 + 2.0 / 20.0 * pow(loss, 3.0) / 720.0 + ROUNDING),
        put_back, (double)transfer.rework);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_nothing_passed_changes_nothing);
    RUN_TEST(test_no_loss_and_no_rework_changes_nothing);
    RUN_TEST(test_constant_loss_at_constant_pace_is_exponential);
    RUN_TEST(test_every_stretch_takes_its_own_pace_and_width);
    RUN_TEST(test_rework_of_a_known_outlet_density_without_loss);
    RUN_TEST(test_rework_of_a_piece_that_starts_further_out_is_larger);
    RUN_TEST(test_rework_of_each_stretch_is_that_of_the_density_then_leaving);
    RUN_TEST(test_rework_is_lost_on_the_way_too);
    RUN_TEST(test_linear_loss_profile_is_the_exponential_of_its_integral);
    RUN_TEST(test_loss_profile_is_met_from_the_place_where_the_piece_lies);
    RUN_TEST(test_last_way_is_added);
    RUN_TEST(test_last_way_of_no_length_changes_nothing);
    RUN_TEST(test_way_of_a_great_loss_is_the_exponential_up_to_the_fifth_power);
    return UNITY_END();
}
