/* SPDX-License-Identifier: MIT */
/* Each edge, a unit in the last place to either side. */
#include "config_case.h"

void setUp(void) {
    begin_with_papers_case();
}

void tearDown(void) {
}

static void test_edges_of_every_field_are_where_its_rule_says(void) {
    for (size_t i = 0; i < COUNT(fields); ++i) {
        const belt_rule_t rule = belt_config_rule(&config, fields[i].code);
        set(&fields[i], rule.lower);
        TEST_ASSERT_TRUE(breaks(fields[i].code) == rule.lower_open);
        set(&fields[i], real_next(rule.lower, BELT_REAL(-INFINITY)));
        TEST_ASSERT_TRUE(breaks(fields[i].code));
        set(&fields[i], real_next(rule.lower, BELT_REAL(INFINITY)));
        TEST_ASSERT_FALSE(breaks(fields[i].code));

        set(&fields[i], rule.upper);
        TEST_ASSERT_TRUE(breaks(fields[i].code) == rule.upper_open);
        set(&fields[i], real_next(rule.upper, BELT_REAL(INFINITY)));
        TEST_ASSERT_TRUE(breaks(fields[i].code));
        set(&fields[i], real_next(rule.upper, BELT_REAL(-INFINITY)));
        TEST_ASSERT_FALSE(breaks(fields[i].code));
        config = paper_case();
    }
}

/* A line whose numbers are powers of two, so that derived numbers are exact. */
static void make_dyadic(void) {
    config.processing_time = BELT_REAL(0.25);
    config.speed_window = BELT_REAL(0.25);
    config.node_count = 16;
    config.period = BELT_REAL(0.00390625);
    config.slope_kind = BELT_SLOPE_ABSOLUTE;
    config.level_setpoint = BELT_REAL(0.25);
    config.nominal_flux_max = BELT_REAL(1);
    config.slope = BELT_REAL(16);
    config.rework_rate = BELT_REAL(0.125);
    assert_breaks_nothing_but(BELT_OK);
}

static void test_period_may_be_the_time_of_one_node_spacing_and_not_more(void) {
    make_dyadic();
    config.slope = BELT_REAL(8);
    config.period = BELT_REAL(0.03125);
    assert_breaks_nothing_but(BELT_OK);
    config.period = real_next(config.period, BELT_REAL(1));
    assert_breaks_nothing_but(BELT_PERIOD_PER_NODE);
}

static void test_window_may_be_one_period_and_not_less(void) {
    make_dyadic();
    config.speed_window = config.period;
    assert_breaks_nothing_but(BELT_OK);
    config.speed_window = real_next(config.speed_window, BELT_REAL(0));
    assert_breaks_nothing_but(BELT_WINDOW_SHORT);
}

static void test_window_may_fill_the_memory_and_not_more(void) {
    make_dyadic();
    config.congestion_scale = BELT_REAL(1024); /* keeps the dead time short */
    config.speed_window = config.period * (BELT_REAL(BELT_WINDOW_CAPACITY) - BELT_REAL(2));
    assert_breaks_nothing_but(BELT_OK);
    /* A unit in the last place of the number compared, speed_window/period + 2. */
    const belt_real_t count = real_next(BELT_REAL(BELT_WINDOW_CAPACITY), BELT_REAL_MAX);
    config.speed_window = config.period * (count - BELT_REAL(2));
    assert_breaks_nothing_but(BELT_WINDOW_LONG);
}

static void test_dead_time_may_be_its_greatest_number_of_periods_and_not_more(void) {
    make_dyadic();
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
    config.node_count = 128;
    config.congestion_scale = BELT_REAL(8) * config.period;
    config.speed_window = BELT_REAL(63) * config.congestion_scale; /* dead time 0.5*(1 + 63) */
    assert_breaks_nothing_but(BELT_OK);
    TEST_ASSERT_TRUE(belt_config_rule(&config, BELT_DEAD_TIME).value == BELT_REAL(8192));
    config.processing_time = real_next(config.processing_time, BELT_REAL(1));
    assert_breaks_nothing_but(BELT_DEAD_TIME);
}

static void test_loss_exponent_may_be_ten_and_not_more(void) {
    make_dyadic();
    config.node_count = 64;
    config.rework_rate = BELT_REAL(0);
    config.loss_rate[0] = BELT_REAL(16); /* dead time 0.5*(1 + 0.25) */
    assert_breaks_nothing_but(BELT_OK);
    TEST_ASSERT_TRUE(belt_config_rule(&config, BELT_LOSS_EXPONENT).value == BELT_REAL(10));
    config.loss_rate[0] = real_next(config.loss_rate[0], BELT_REAL(100));
    assert_breaks_nothing_but(BELT_LOSS_EXPONENT);
}

static void test_loss_of_a_node_spacing_may_be_a_quarter_and_not_more(void) {
    make_dyadic();
    config.congestion_scale = BELT_REAL(0.25); /* dead time 1, a sixteenth a spacing */
    config.loss_rate[0] = BELT_REAL(4);
    assert_breaks_nothing_but(BELT_OK);
    config.loss_rate[0] = real_next(config.loss_rate[0], BELT_REAL(100));
    assert_breaks_nothing_but(BELT_LOSS_PER_NODE);
}

static void test_rework_of_a_node_spacing_may_be_a_quarter_and_not_more(void) {
    make_dyadic();
    config.node_count = 4; /* the longest dead time is 1, of which a node has 1/4 */
    config.speed_window = BELT_REAL(0.5);
    config.congestion_scale = BELT_REAL(0.5);
    config.rework_rate = BELT_REAL(0.5); /* times the belt's length: 1 */
    assert_breaks_nothing_but(BELT_OK);
    config.rework_rate = real_next(config.rework_rate, BELT_REAL(100));
    assert_breaks_nothing_but(BELT_REWORK_PER_NODE);
}

static void test_rework_must_not_fill_the_belt_by_itself(void) {
    /* A*D*T/2 = 0.6*A, at most 0.9. */
    config.rework_rate = BELT_REAL(1.499);
    assert_breaks_nothing_but(BELT_OK);
    config.rework_rate = BELT_REAL(1.501);
    assert_breaks_nothing_but(BELT_REWORK_GAIN);
}

static void test_buffer_may_change_by_half_while_a_node_spacing_passes(void) {
    /* T/node_count = 0.03, at most half the service time; the set-point below alpha*Bmax*that. */
    config.level_setpoint = BELT_REAL(0.01);
    config.service_time = BELT_REAL(0.0601);
    assert_breaks_nothing_but(BELT_OK);
    config.service_time = BELT_REAL(0.0599);
    assert_breaks_nothing_but(BELT_SERVICE_PER_NODE);
}

static void test_speed_may_change_by_a_quarter_while_a_node_spacing_passes(void) {
    /* Qmax*P*D/(congestion_scale*node_count) = 0.025/congestion_scale, at most 0.25. */
    config.congestion_scale = BELT_REAL(0.1001);
    assert_breaks_nothing_but(BELT_OK);
    config.congestion_scale = BELT_REAL(0.0999);
    assert_breaks_nothing_but(BELT_CONGESTION_PER_NODE);
}

static void test_slope_must_exceed_the_least_one_strictly(void) {
    make_dyadic();
    config.slope = belt_config_slope_min(&config);
    TEST_ASSERT_TRUE(config.slope == BELT_REAL(2));
    assert_breaks_nothing_but(BELT_SETPOINT_SLOPE);
    config.slope = real_next(config.slope, BELT_REAL(100));
    assert_breaks_nothing_but(BELT_OK);
}

static void test_margin_that_rounding_swallows_is_no_margin(void) {
    config.slope = BELT_REAL(0.1) * BELT_REAL_EPSILON;
    assert_breaks_nothing_but(BELT_SETPOINT_SLOPE);
}

static void test_slope_times_period_may_be_one_half_and_not_more(void) {
    make_dyadic();
    config.slope = BELT_REAL(256);
    assert_breaks_nothing_but(BELT_OK);
    config.slope = real_next(config.slope, BELT_REAL(1000));
    assert_breaks_nothing_but(BELT_PERIOD_PER_SLOPE);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_edges_of_every_field_are_where_its_rule_says);
    RUN_TEST(test_period_may_be_the_time_of_one_node_spacing_and_not_more);
    RUN_TEST(test_window_may_be_one_period_and_not_less);
    RUN_TEST(test_window_may_fill_the_memory_and_not_more);
    RUN_TEST(test_dead_time_may_be_its_greatest_number_of_periods_and_not_more);
    RUN_TEST(test_loss_exponent_may_be_ten_and_not_more);
    RUN_TEST(test_loss_of_a_node_spacing_may_be_a_quarter_and_not_more);
    RUN_TEST(test_rework_of_a_node_spacing_may_be_a_quarter_and_not_more);
    RUN_TEST(test_rework_must_not_fill_the_belt_by_itself);
    RUN_TEST(test_buffer_may_change_by_half_while_a_node_spacing_passes);
    RUN_TEST(test_speed_may_change_by_a_quarter_while_a_node_spacing_passes);
    RUN_TEST(test_slope_must_exceed_the_least_one_strictly);
    RUN_TEST(test_margin_that_rounding_swallows_is_no_margin);
    RUN_TEST(test_slope_times_period_may_be_one_half_and_not_more);
    return UNITY_END();
}
