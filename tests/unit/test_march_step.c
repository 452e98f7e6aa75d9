/* SPDX-License-Identifier: MIT */
/* One step of the march by itself: its mean pace to third order, its mean level in closed form. */
#include "belt/march_pairs.h"

#include "march_case.h"

void setUp(void) {
    config = paper_case();
    begin();
}

void tearDown(void) {
}

/* --- the mean pace of the stretch ahead --- */

/** Level and window's end along the belt, both linear [parts, parts a spacing]. */
typedef struct {
    double level;
    double level_rise;
    double tail;
    double tail_rise;
} ahead_t;

/** p' = k*(level - tail)*p over `width` spacings, k the pace gained per congestion: its mean by the
 * midpoint rule, wrong by (width*p'/p/FINE)^2/24 < 1e-8 of it, a hundredth of the least error looked at. */
#define FINE 2000

static double pace_by_the_equation(const ahead_t *ahead, double width) {
    const double k = (double)model.line.slowness_slope * (double)model.line.spacing;
    const double empty = (double)model.line.slowness_empty * (double)model.line.spacing;
    const double net = ahead->level - ahead->tail;
    const double net_rise = ahead->level_rise - ahead->tail_rise;
    double sum = 0.0;
    for (int i = 0; i < FINE; ++i) {
        const double x = width * (i + 0.5) / FINE;
        sum += exp(k * x * (net + 0.5 * x * net_rise));
    }
    return empty * sum / FINE;
}

/** The step looks in the middle of the stretch and, a stretch of the same width before, did so too. */
static double pace_of_the_step(const ahead_t *ahead, double width) {
    belt_front_t *front = &prediction.inlet;
    front->level = BELT_REAL(ahead->level);
    front->rise = BELT_REAL(ahead->level_rise);
    front->congestion = BELT_REAL(0);
    front->tail = BELT_REAL(ahead->tail - 0.5 * width * ahead->tail_rise);
    const belt_real_t middle = BELT_REAL(ahead->tail + 0.5 * width * ahead->tail_rise);
    const belt_real_t early = belt_march_seen_once(front, middle);
    TEST_ASSERT_TRUE(front->tail == middle);
    return (double)belt_march_pace_ahead(&model.line, front, BELT_REAL(width), early);
}

static double error_of_the_pace(const ahead_t *ahead, double width) {
    return fabs(pace_of_the_step(ahead, width) - pace_by_the_equation(ahead, width));
}

/** Third order, an eighth of the error for half the width; a sixth leaves room for the fourth, and a term
 * of second order would leave a quarter. Rounding: four of the pace, of the slowness twice as many. */
static void assert_pace_is_of_third_order(const ahead_t *ahead) {
    const double rounding = 8.0 * EPSILON * (double)prediction.inlet.pace;
    double before = error_of_the_pace(ahead, 2.0);
    TEST_ASSERT_TRUE(before > 100.0 * rounding); /* or there was nothing to divide */
    for (double width = 1.0; width >= 0.25; width *= 0.5) {
        const double error = error_of_the_pace(ahead, width);
        TEST_ASSERT_TRUE(error <= before / 6.0 + rounding);
        before = error;
    }
}

/** A pace that doubles with 0.05 parts s: a level of 0.5 makes it grow by a fourth in a spacing. */
static void crowd(void) {
    config.congestion_scale = BELT_REAL(0.05);
    begin();
}

static void test_pace_follows_the_level_to_third_order(void) {
    crowd();
    const ahead_t steady = {0.5, 0.0, 0.0, 0.0};
    assert_pace_is_of_third_order(&steady);
    const ahead_t sinking = {0.1, 0.0, 0.6, 0.0};
    assert_pace_is_of_third_order(&sinking);
}

static void test_pace_follows_a_rising_level_to_third_order(void) {
    crowd();
    const ahead_t rising = {0.5, 0.2, 0.1, 0.0};
    assert_pace_is_of_third_order(&rising);
    const ahead_t falling = {0.8, -0.1, 0.9, 0.0};
    assert_pace_is_of_third_order(&falling);
}

static void test_pace_follows_the_windows_end_to_third_order(void) {
    crowd();
    const ahead_t falling = {0.5, 0.0, 0.4, -0.15};
    assert_pace_is_of_third_order(&falling);
    const ahead_t rising = {0.2, 0.0, 0.7, 0.1};
    assert_pace_is_of_third_order(&rising);
    const ahead_t both = {0.6, 0.1, 0.3, -0.1};
    assert_pace_is_of_third_order(&both);
}

/* --- the mean level behind a step --- */

/** The level's mean over the step that starts at `level`: seen through the congestion, which begins at 0
 * and, with the window's end at 0, is that mean times the time. */
static double mean_level(double level, double width, double pace, double density) {
    belt_front_t *front = &prediction.inlet;
    const belt_leaving_t leaving = {BELT_REAL(density), BELT_REAL(0)};
    front->level = BELT_REAL(level);
    front->tail = BELT_REAL(0);
    front->congestion = BELT_REAL(0);
    front->count = 0;
    belt_march_pass(&prediction, &model, front, BELT_REAL(width), BELT_REAL(pace), leaving);
    return (double)front->congestion / (width * pace);
}

/** With q the level, q' = inflow - q/service_time: its mean is q + net*(exp(-z) - 1 + z)/z^2, where z is
 * the time over service_time and net what the level would gain if the service did not follow it. The
 * series breaks off before z^3/120; four roundings of numbers up to 1. */
static void assert_mean_is_the_closed_form(double level, double density, double z) {
    const double service_time = (double)config.service_time;
    const double dwell = z * service_time;
    const double inflow = 2.0 * (double)model.line.gain * density;
    const double net = inflow - level * z;
    const double truth = level + net * (exp(-z) - 1.0 + z) / (z * z);
    const double close = fabs(net) * z * z * z / 120.0 + 4.0 * EPSILON;
    TEST_ASSERT_DOUBLE_WITHIN(close, truth, mean_level(level, 2.0, 0.5 * dwell, density));
}

static void test_mean_level_is_that_of_a_constant_inflow(void) {
    config.service_rate_max = BELT_REAL(10); /* never reached */
    begin();
    for (double z = 0.125; z <= 1.0; z *= 2.0) {
        assert_mean_is_the_closed_form(0.2, 6.0, z);
        assert_mean_is_the_closed_form(0.8, 0.0, z);
        assert_mean_is_the_closed_form(0.0, 4.0, z);
    }
}

/* --- the moment of what leaves --- */

/** Over two cells of equal width a straight line from one cell's mean to the other's has the first moment
 * (first - second)/6 about the middle, over width^2: what leaves early is in the buffer for longer. */
static void test_density_that_falls_over_a_pair_is_in_the_buffer_for_longer(void) {
    config.congestion_scale = BELT_REAL(1e6);
    config.service_time = BELT_REAL(1e6);
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
    begin();
    const double first = 6.0;
    const double second = 2.0;
    model.observer.density[0] = BELT_REAL(first);
    model.observer.density[1] = BELT_REAL(second);
    (void)belt_march_plain_pairs(&prediction, &model, 0u, 1u);
    TEST_ASSERT_EQUAL(1, prediction.inlet.count);
    const double gain = 2.0 * (double)model.line.gain;
    const double mean = gain * (0.5 * 0.5 * (first + second) + (first - second) / 6.0);
    /* Eight roundings of a level up to 0.4; of it 1e-7 is served, and the pace grows by as little. */
    TEST_ASSERT_DOUBLE_WITHIN(8.0 * EPSILON + 1e-7, mean,
                              (double)prediction.inlet.congestion /
                                  (double)prediction.inlet.arrival);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_pace_follows_the_level_to_third_order);
    RUN_TEST(test_pace_follows_a_rising_level_to_third_order);
    RUN_TEST(test_pace_follows_the_windows_end_to_third_order);
    RUN_TEST(test_mean_level_is_that_of_a_constant_inflow);
    RUN_TEST(test_density_that_falls_over_a_pair_is_in_the_buffer_for_longer);
    return UNITY_END();
}
