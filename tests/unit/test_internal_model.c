/* SPDX-License-Identifier: MIT */
/* The model over late periods: how far the belt went, and which density left, while the window's end fell. */
#include "belt/internal_model.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

#include <string.h>

/* Periods made up for at once, in each of which the level that leaves the window falls by 0.01 parts. */
#define LATE 20u
#define FALL 4.0 /* [parts/s] */
#define LEVEL 0.1

static belt_config_t config;
static belt_model_t model;

/** The level fell for the whole window and the late periods hold it: so the congestion falls with the
 * square of the time. */
static void begin(void) {
    belt_model_init(&model, &config);
    for (uint32_t i = model.history.length; i > 0u; --i) {
        const double ago = (double)config.period * (double)(i - 1u);
        belt_level_history_push(&model.history, BELT_REAL(fmin(LEVEL + FALL * ago, 1.0)));
    }
    model.present.level = BELT_REAL(LEVEL);
    model.present.congestion = belt_level_history_congestion(&model.history);
}

void setUp(void) {
    config = paper_case();
    config.congestion_scale = BELT_REAL(0.05);
    config.node_count = 8; /* 0.25 m: in the late periods the belt moves by less */
    begin();
}

void tearDown(void) {
}

/** Slowness after a time, R' = level - tail. */
static double slowness_after(double time) {
    const double tail = LEVEL + FALL * (double)config.speed_window;
    const double congestion =
        (double)model.present.congestion + (LEVEL - tail) * time + 0.5 * FALL * time * time;
    return (double)config.processing_time * (1.0 + congestion / (double)config.congestion_scale);
}

/** Spacings that the belt moves, in small steps. */
static double travel_by_the_equation(void) {
    const double duration = LATE * (double)config.period;
    double travel = 0.0;
    for (int i = 0; i < 2000; ++i) {
        travel += duration / 2000.0 / slowness_after(duration * (i + 0.5) / 2000.0);
    }
    return travel / (double)model.line.spacing;
}

/** All late periods in one stretch; the outlet is measured. */
static void follow_late_periods(double outlet_flux) {
    belt_trusted_t trusted;
    memset(&trusted, 0, sizeof trusted);
    trusted.level = BELT_REAL(LEVEL);
    trusted.outlet_flux = BELT_REAL(outlet_flux);
    trusted.has_outlet_flux = true;
    trusted.level_is_new = true;
    trusted.periods = LATE;
    belt_model_follow(&model, &trusted, NULL, LATE);
}

/** The slowness in the middle is exact, window's end and all; the mean of 1/slowness is off from that in its
 * middle by time^2/24 of its curvature, which is at most 42 here. */
static void test_belt_moves_as_far_as_the_falling_level_lets_it(void) {
    const double duration = LATE * (double)config.period;
    const double close = 42.0 / 24.0 * duration * duration * duration / (double)model.line.spacing;
    const double truth = travel_by_the_equation();
    follow_late_periods(0.5);
    TEST_ASSERT_TRUE(truth < 1.0); /* no cell closed: the open one's share is the way */
    TEST_ASSERT_DOUBLE_WITHIN(close + 16.0 * EPSILON, truth, (double)model.observer.gone);
}

/** The measured flux is that of the last period, and so is the slowness: twice its change up to the middle,
 * which leaves out a quarter of what the window's end falls. */
static void test_density_that_left_is_the_flux_at_the_speed_of_the_end(void) {
    const double duration = LATE * (double)config.period;
    const double truth = 0.5 * slowness_after(duration);
    const double close =
        0.5 * (double)model.line.slowness_slope * 0.25 * FALL * duration * duration;
    follow_late_periods(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(close + 16.0 * EPSILON, truth, (double)model.observer.outlet_density);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_belt_moves_as_far_as_the_falling_level_lets_it);
    RUN_TEST(test_density_that_left_is_the_flux_at_the_speed_of_the_end);
    return UNITY_END();
}
