/* SPDX-License-Identifier: MIT */
/* The window that slides from recorded into predicted levels. */
#include "predictor_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- congestion and window --- */

static void test_held_congestion_keeps_the_pace(void) {
    config.prediction = BELT_HOLD_CONGESTION;
    config.speed_window = BELT_REAL(0.05);
    lay(wave, level_falling);
    march();
    const double pace = 0.25 * (1.0 + (double)model.present.congestion) * 0.1;
    for (uint32_t i = 0; i < prediction.inlet.count; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(rounding() * pace, pace, (double)prediction.pace[i]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 20.0 * pace, (double)prediction.inlet.arrival);
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), (double)model.present.congestion,
                              (double)prediction.inlet.congestion);
}

/** Integral of the predicted level over the window that ends at the last model.line. */
static double window_of_predicted_levels(void) {
    const double from = (double)prediction.inlet.arrival - (double)config.speed_window;
    double sum = 0.0;
    for (uint32_t i = 0; i < prediction.inlet.count; ++i) {
        const double start = (double)prediction.arrival[i];
        const double end = (double)prediction.arrival[i + 1u];
        const double first = fmax(start, from);
        if (end > first) {
            const double rise =
                ((double)prediction.level[i + 1u] - (double)prediction.level[i]) / (end - start);
            sum += (end - first) *
                   ((double)prediction.level[i] + rise * (0.5 * (first + end) - start));
        }
    }
    return sum;
}

static void test_window_that_slid_past_now_uses_predicted_levels_only(void) {
    const double windows[] = {0.02, 0.06, 0.2, 0.4};
    config.node_count = 80;
    for (size_t i = 0; i < sizeof windows / sizeof windows[0]; ++i) {
        config.speed_window = BELT_REAL(windows[i]);
        lay(wave, level_falling);
        march();
        TEST_ASSERT_TRUE((double)prediction.inlet.arrival > windows[i]);
        /* Trapezoids against midpoints: h^2/8 of Q'', h = 0.015 s, Q'' up to 8 for a wave of 0.2 at
         * 3*4/s; and the congestion is a difference of slownesses. */
        TEST_ASSERT_DOUBLE_WITHIN(0.015 * 0.015 + rounding(), window_of_predicted_levels(),
                                  (double)prediction.inlet.congestion);
    }
}

static void test_window_longer_than_the_dead_time_still_uses_recorded_levels(void) {
    config.speed_window = BELT_REAL(1);
    config.congestion_scale = BELT_REAL(10);
    config.node_count = 80;
    lay(wave, level_falling);
    march();
    const double recorded = 1.0 - (double)prediction.inlet.arrival;
    const double truth = recorded * level_falling(0.5 * recorded) + (window_of_predicted_levels());
    /* As above; the difference of slownesses counts ten times. */
    TEST_ASSERT_DOUBLE_WITHIN(0.015 * 0.015 + 10 * rounding(), truth,
                              (double)prediction.inlet.congestion);
}

static void test_window_shorter_than_a_stretch_follows_the_level_within_it(void) {
    /* A stretch takes 0.05 s and less; the window of 0.0025 s has left all lines that are predicted, and the
     * level goes on as it did. Were it to stay, the congestion would be off by the first power. */
    config.speed_window = config.period;
    for (uint16_t nodes = 20; nodes <= 160; nodes = (uint16_t)(nodes * 2)) {
        config.node_count = nodes;
        lay(wave, level_falling);
        march();
        const double window = (double)config.speed_window;
        /* In a window the level changes by 2*0.0025 at most, half of which counts. */
        TEST_ASSERT_DOUBLE_WITHIN(0.2 / ((double)nodes * nodes) + window * window + rounding(),
                                  window * (double)prediction.inlet.level,
                                  (double)prediction.inlet.congestion);
    }
}

static void test_level_that_leaves_the_window_at_the_inlet_is_told(void) {
    config.node_count = 80;
    lay(wave, level_constant);
    march();
    const double then = (double)prediction.inlet.arrival - 0.2;
    uint32_t i = 0;
    while ((double)prediction.arrival[i + 1u] < then) {
        ++i;
    }
    /* Taken in the middle of the last stretch, half of up to three spacings before the end. */
    const double slope = 2.0 * 4.0 * 0.25;
    TEST_ASSERT_DOUBLE_WITHIN(slope * 0.02, (double)prediction.level[i],
                              (double)prediction.inlet.tail);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_held_congestion_keeps_the_pace);
    RUN_TEST(test_window_that_slid_past_now_uses_predicted_levels_only);
    RUN_TEST(test_window_longer_than_the_dead_time_still_uses_recorded_levels);
    RUN_TEST(test_window_shorter_than_a_stretch_follows_the_level_within_it);
    RUN_TEST(test_level_that_leaves_the_window_at_the_inlet_is_told);
    return UNITY_END();
}
