/* SPDX-License-Identifier: MIT */
/* Counts, words and numbers that no configuration may have. */
#include "config_case.h"

void setUp(void) {
    begin_with_papers_case();
}

void tearDown(void) {
}

/* --- counts and words --- */

static void test_edges_of_node_count(void) {
    config.node_count = 4;
    config.loss_rate[0] = BELT_REAL(0.5);
    assert_breaks_nothing_but(BELT_OK);
    config.node_count = BELT_NODE_CAPACITY;
    TEST_ASSERT_FALSE(breaks(BELT_NODE_COUNT));
    const uint16_t refused[] = {0, 1, 3, BELT_NODE_CAPACITY + 1, UINT16_MAX};
    for (size_t i = 0; i < COUNT(refused); ++i) {
        config.node_count = refused[i];
        TEST_ASSERT_TRUE(breaks(BELT_NODE_COUNT));
        assert_refused_and_untouched(BELT_NODE_COUNT);
    }
}

static void test_edges_of_loss_count(void) {
    config.loss_count = BELT_LOSS_CAPACITY;
    assert_breaks_nothing_but(BELT_OK);
    const uint16_t refused[] = {0, BELT_LOSS_CAPACITY + 1, UINT16_MAX};
    for (size_t i = 0; i < COUNT(refused); ++i) {
        config.loss_count = refused[i];
        TEST_ASSERT_TRUE(breaks(BELT_LOSS_COUNT));
        assert_refused_and_untouched(BELT_LOSS_COUNT);
    }
}

static void test_words_that_do_not_exist_are_refused(void) {
    const unsigned words[] = {2u, 77u, 0x7FFFFFFFu};
    for (size_t i = 0; i < COUNT(words); ++i) {
        config = paper_case();
        config.slope_kind = (belt_slope_kind_t)words[i];
        assert_breaks_nothing_but(BELT_SLOPE_KIND);
        config = paper_case();
        config.prediction = (belt_prediction_kind_t)words[i];
        assert_breaks_nothing_but(BELT_PREDICTION_KIND);
        config = paper_case();
        config.estimator = (belt_estimator_kind_t)words[i];
        assert_breaks_nothing_but(BELT_ESTIMATOR_KIND);
    }
    config = paper_case();
    config.prediction = BELT_HOLD_CONGESTION;
    config.estimator = BELT_ESTIMATOR_ON;
    assert_breaks_nothing_but(BELT_OK);
}

/* --- the loss profile --- */

static void test_every_value_of_the_loss_profile_is_looked_at(void) {
    const belt_real_t senseless[] = {BELT_REAL(NAN), BELT_REAL(-INFINITY), BELT_REAL(INFINITY)};
    config.loss_count = BELT_LOSS_CAPACITY;
    for (size_t i = 0; i < BELT_LOSS_CAPACITY; ++i) {
        for (size_t kind = 0; kind < COUNT(senseless); ++kind) {
            const belt_real_t before = config.loss_rate[i];
            config.loss_rate[i] = senseless[kind];
            TEST_ASSERT_EQUAL(BELT_LOSS_RATE, belt_config_check(&config, NULL));
            config.loss_rate[i] = before;
        }
    }
}

static void test_values_behind_the_loss_count_are_not_looked_at(void) {
    config.loss_count = BELT_LOSS_CAPACITY - 1;
    config.loss_rate[BELT_LOSS_CAPACITY - 1] = BELT_REAL(NAN);
    assert_breaks_nothing_but(BELT_OK);
}

static void test_loss_exponent_takes_the_mean_of_the_profile_and_the_node_its_worst(void) {
    config.loss_count = 3;
    config.loss_rate[0] = BELT_REAL(1);
    config.loss_rate[1] = BELT_REAL(4);
    config.loss_rate[2] = BELT_REAL(2);
    /* Trapezoids: (1/2 + 4 + 2/2)/2 = 2.75 over a dead time of 0.6; the worst 4 over 0.6/20. */
    const belt_rule_t exponent = belt_config_rule(&config, BELT_LOSS_EXPONENT);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 1.65, 1.65, (double)exponent.value);
    const belt_rule_t node = belt_config_rule(&config, BELT_LOSS_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.12, 0.12, (double)node.value);
}

static void test_growth_counts_by_its_size_and_feeds_the_rework(void) {
    config.loss_count = 3;
    config.loss_rate[0] = BELT_REAL(1);
    config.loss_rate[1] = BELT_REAL(-4);
    config.loss_rate[2] = BELT_REAL(2);
    const belt_rule_t worst = belt_config_rule(&config, BELT_LOSS_RATE);
    TEST_ASSERT_TRUE(worst.value == BELT_REAL(-4));
    /* The sizes are those of the test above; their mean is 2.75, that of the values -1.25. */
    const belt_rule_t exponent = belt_config_rule(&config, BELT_LOSS_EXPONENT);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 1.65, 1.65, (double)exponent.value);
    const belt_rule_t node = belt_config_rule(&config, BELT_LOSS_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.12, 0.12, (double)node.value);
    TEST_ASSERT_TRUE(belt_config_loss_mean(&config) == BELT_REAL(-1.25));
    /* A*D/2 over 0.6 s is 0.06; what comes back grows by exp((2.75 + 1.25)/2*0.6) at most. */
    const belt_rule_t gain = belt_config_rule(&config, BELT_REWORK_GAIN);
    const double grown = 0.06 * exp(1.2);
    TEST_ASSERT_DOUBLE_WITHIN(12 * EPSILON * grown, grown, (double)gain.value);
}

/* --- hostile values --- */

static void assert_refused_whole(const field_t *field, belt_real_t value) {
    config = paper_case();
    set(field, value);
    TEST_ASSERT_TRUE(breaks(field->code));
    assert_refused_and_untouched(belt_config_check(&config, NULL));
}

/** Below 0 a density grows by itself. */
static bool may_be_negative(belt_status_t code) {
    return code == BELT_LOSS_RATE;
}

static void test_no_field_may_be_nan_or_infinite_or_negative(void) {
    const belt_real_t hostile[] = {BELT_REAL(NAN),       -BELT_REAL(NAN),    BELT_REAL(INFINITY),
                                   BELT_REAL(-INFINITY), -BELT_REAL_MAX,     BELT_REAL(-1),
                                   BELT_REAL(-1e-9),     -real_from_bits(1u)};
    for (size_t i = 0; i < COUNT(fields); ++i) {
        for (size_t kind = 0; kind < COUNT(hostile); ++kind) {
            const bool is_small =
                (hostile[kind] >= BELT_REAL(-1)) && (hostile[kind] <= BELT_REAL(1));
            if (!(is_small && may_be_negative(fields[i].code))) {
                assert_refused_whole(&fields[i], hostile[kind]);
            }
        }
    }
}

static bool may_be_zero(belt_status_t code) {
    return (code == BELT_REWORK_RATE) || (code == BELT_LOSS_RATE) || (code > BELT_PREDICTION_KIND);
}

static void test_zero_is_refused_but_for_rework_and_loss_and_what_has_a_default(void) {
    for (size_t i = 0; i < COUNT(fields); ++i) {
        if (may_be_zero(fields[i].code)) {
            config = paper_case();
            set(&fields[i], BELT_REAL(0));
            assert_breaks_nothing_but(BELT_OK);
        } else {
            assert_refused_whole(&fields[i], BELT_REAL(0));
            assert_refused_whole(&fields[i], BELT_REAL(-0.0));
        }
    }
}

static void test_huge_is_refused_but_for_the_actuator(void) {
    for (size_t i = 0; i < COUNT(fields); ++i) {
        if (fields[i].code == BELT_INLET_FLUX_MAX) {
            config = paper_case();
            set(&fields[i], BELT_NO_FLUX_LIMIT);
            assert_breaks_nothing_but(BELT_OK);
        } else {
            assert_refused_whole(&fields[i], BELT_REAL_MAX);
        }
    }
}

/* The slope is a number too, but its rule's value is S. */
static const field_t slope_field = {BELT_SETPOINT_SLOPE, offsetof(belt_config_t, slope)};

static void test_no_slope_of_either_kind_may_be_senseless(void) {
    const belt_real_t low[] = {BELT_REAL(NAN),    BELT_REAL(-INFINITY), -BELT_REAL_MAX,
                               BELT_REAL(-1),     BELT_REAL(0),         -real_from_bits(1u),
                               real_from_bits(1u)};
    const belt_real_t high[] = {BELT_REAL(INFINITY), BELT_REAL_MAX};
    for (int kind = (int)BELT_SLOPE_MARGIN; kind <= (int)BELT_SLOPE_ABSOLUTE; ++kind) {
        config = paper_case();
        config.slope_kind = (belt_slope_kind_t)kind;
        for (size_t i = 0; i < COUNT(low); ++i) {
            set(&slope_field, low[i]);
            assert_refused_and_untouched(BELT_SETPOINT_SLOPE);
        }
        set(&slope_field, high[0]);
        TEST_ASSERT_TRUE(breaks(BELT_SETPOINT_SLOPE));
        set(&slope_field, high[1]);
        TEST_ASSERT_TRUE(breaks(BELT_PERIOD_PER_SLOPE));
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_edges_of_node_count);
    RUN_TEST(test_edges_of_loss_count);
    RUN_TEST(test_words_that_do_not_exist_are_refused);
    RUN_TEST(test_every_value_of_the_loss_profile_is_looked_at);
    RUN_TEST(test_values_behind_the_loss_count_are_not_looked_at);
    RUN_TEST(test_growth_counts_by_its_size_and_feeds_the_rework);
    RUN_TEST(test_loss_exponent_takes_the_mean_of_the_profile_and_the_node_its_worst);
    RUN_TEST(test_no_field_may_be_nan_or_infinite_or_negative);
    RUN_TEST(test_zero_is_refused_but_for_rework_and_loss_and_what_has_a_default);
    RUN_TEST(test_huge_is_refused_but_for_the_actuator);
    RUN_TEST(test_no_slope_of_either_kind_may_be_senseless);
    return UNITY_END();
}
