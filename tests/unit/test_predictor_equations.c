/* SPDX-License-Identifier: MIT */
/* The march against the equations as printed. */
#include "predictor_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- against the equations as printed --- */

/** Second order: what is left falls with the square of the spacing, for odd and even counts alike. The
 * window's end passes a corner of the level, now, at some place in a stretch, so that the error jumps
 * up and down under this bound; measured are up to 0.092/N^2. Eight roundings. */
static void assert_error_falls_with_the_square(double factor, along_t *density, along_t *past) {
    const uint16_t counts[] = {20, 21, 40, 41, 80, 81, 160, 161};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
        const double nodes = counts[i];
        TEST_ASSERT_DOUBLE_WITHIN(factor / (nodes * nodes) + 8 * EPSILON, 0.0,
                                  error_on(counts[i], density, past));
    }
}

static void test_march_finds_the_future_of_the_equations(void) {
    assert_error_falls_with_the_square(0.1, wave, level_falling);
    assert_error_falls_with_the_square(0.1, wave, level_constant);
}

static void test_march_finds_the_future_of_a_long_and_of_a_short_window(void) {
    config.speed_window = BELT_REAL(3); /* congestion itself is up to 1; measured 0.176/N^2 */
    assert_error_falls_with_the_square(0.2, wave, level_constant);
    config.speed_window = BELT_REAL(0.1);
    assert_error_falls_with_the_square(0.1, wave, level_constant);
}

static void test_march_finds_the_future_of_a_loss_profile(void) {
    config.loss_count = 3;
    config.loss_rate[0] = BELT_REAL(0.5);
    config.loss_rate[1] = BELT_REAL(2);
    config.loss_rate[2] = BELT_REAL(1);
    assert_error_falls_with_the_square(0.1, wave, level_falling);
}

static void test_march_finds_the_future_of_much_rework(void) {
    config.rework_rate = BELT_REAL(0.8);
    config.loss_rate[0] = BELT_REAL(0.3);
    /* Measured 0.114/N^2 where the rework comes from a table (tests/laws). */
    assert_error_falls_with_the_square(0.13, wave, level_constant);
}

/** At constant speed there is no corner, and the error is smooth: level, survival, rework. */
static double error_at_constant_speed(uint16_t nodes) {
    config.node_count = nodes;
    lay(wave, level_constant);
    march();
    const future_t future = future_of(wave, level_constant);
    return fabs((double)prediction.inlet.level - future.level) +
           fabs((double)prediction.inlet_rework - future.rework);
}

static void test_half_the_spacing_leaves_a_quarter_of_the_error(void) {
    hold_speed();
    config.rework_rate = BELT_REAL(0.8);
    for (uint16_t coarse = 10; coarse <= 20; coarse = (uint16_t)(coarse * 2)) {
        const double before = error_at_constant_speed(coarse);
        const double after = error_at_constant_speed((uint16_t)(2 * coarse));
        /* A tenth for what is of higher order, and eight roundings. */
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * 0.25 * before + 8 * EPSILON, 0.25 * before, after);
        TEST_ASSERT_TRUE(before > 1e-5); /* or there was nothing to divide */
    }
}

static void test_odd_and_even_node_counts_agree_to_second_order(void) {
    for (uint16_t nodes = 20; nodes <= 160; nodes = (uint16_t)(nodes * 2)) {
        config.node_count = (uint16_t)(nodes + 1);
        lay(wave, level_falling);
        march();
        const double odd = (double)prediction.inlet.level;
        config.node_count = nodes;
        lay(wave, level_falling);
        march();
        /* The bound of above, for the level alone. */
        TEST_ASSERT_DOUBLE_WITHIN(0.02 / ((double)nodes * nodes) + 8 * EPSILON, odd,
                                  (double)prediction.inlet.level);
    }
}

/* --- loss profiles --- */

static void test_profile_of_equal_values_is_the_uniform_loss_bit_for_bit(void) {
    static belt_prediction_t uniform;
    lay(wave, level_falling);
    march();
    uniform = prediction;
    config.loss_count = 3;
    config.loss_rate[1] = config.loss_rate[0];
    config.loss_rate[2] = config.loss_rate[0];
    lay(wave, level_falling);
    march();
    TEST_ASSERT_TRUE(memcmp(&uniform, &prediction, sizeof uniform) == 0);
}

static void test_profile_of_nearly_equal_values_is_close_to_the_uniform_loss(void) {
    for (uint16_t nodes = 20; nodes <= 21; ++nodes) {
        config = paper_case();
        config.node_count = nodes;
        lay(wave, level_falling);
        march();
        const future_t uniform = {(double)prediction.inlet.level, (double)prediction.inlet.arrival,
                                  (double)prediction.inlet.congestion,
                                  (double)prediction.inlet_survival,
                                  (double)prediction.inlet_rework};
        config.loss_count = 2;
        config.loss_rate[1] = real_next(config.loss_rate[0], BELT_REAL(2));
        lay(wave, level_falling);
        march();
        TEST_ASSERT_FALSE(model.line.loss_is_uniform);
        /* Two second-order ways to the same: a twentieth of loss a pair, its square over 12. */
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 12.0 + rounding(), 0.0, distance(&uniform));
    }
}

/* --- what the command needs besides --- */

static void assert_rework_slope_is_the_change_at_the_inlet(uint16_t nodes) {
    config.node_count = nodes;
    lay(wave, level_constant);
    march();
    (void)future_of(wave, level_constant);
    /* Over the last spacing and over the last four: the march may take any piece between. */
    const double share = (double)FINE / nodes;
    future_t at_end;
    future_t one_before;
    future_t four_before;
    look_back(&at_end, FINE, 2.0, 0.0, 0.0);
    look_back(&one_before, (int)(FINE - share), 2.0 - 2.0 / nodes, 0.0, 0.0);
    look_back(&four_before, (int)(FINE - 4.0 * share), 2.0 - 8.0 / nodes, 0.0, 0.0);
    const double last = at_end.rework - one_before.rework;
    const double four = 0.25 * (at_end.rework - four_before.rework);
    TEST_ASSERT_DOUBLE_WITHIN(1.2 * fabs(four - last) + 8 * EPSILON, last,
                              (double)prediction.inlet_rework_slope);
}

static void test_rework_slope_is_the_change_of_rework_at_the_inlet(void) {
    hold_speed();
    config.rework_rate = BELT_REAL(0.8);
    for (int kind = 0; kind < 2; ++kind) {
        assert_rework_slope_is_the_change_at_the_inlet(20);
        assert_rework_slope_is_the_change_at_the_inlet(40);
        assert_rework_slope_is_the_change_at_the_inlet(80);
        config.loss_count = 2;
        config.loss_rate[1] = BELT_REAL(0.2);
    }
}

static double heavy(double x) {
    (void)x;
    return 8.0;
}

static void test_predicted_level_ends_at_the_capacity_where_the_buffer_spills(void) {
    lay(heavy, level_constant);
    march();
    for (uint32_t k = 0; k <= prediction.inlet.count; ++k) {
        TEST_ASSERT_TRUE(prediction.level[k] <= config.level_capacity);
    }
    TEST_ASSERT_TRUE(prediction.inlet.level == config.level_capacity);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_march_finds_the_future_of_the_equations);
    RUN_TEST(test_march_finds_the_future_of_a_long_and_of_a_short_window);
    RUN_TEST(test_march_finds_the_future_of_a_loss_profile);
    RUN_TEST(test_march_finds_the_future_of_much_rework);
    RUN_TEST(test_half_the_spacing_leaves_a_quarter_of_the_error);
    RUN_TEST(test_odd_and_even_node_counts_agree_to_second_order);
    RUN_TEST(test_profile_of_equal_values_is_the_uniform_loss_bit_for_bit);
    RUN_TEST(test_profile_of_nearly_equal_values_is_close_to_the_uniform_loss);
    RUN_TEST(test_rework_slope_is_the_change_of_rework_at_the_inlet);
    RUN_TEST(test_predicted_level_ends_at_the_capacity_where_the_buffer_spills);
    return UNITY_END();
}
