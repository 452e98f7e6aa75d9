/* SPDX-License-Identifier: MIT */
#include "belt/belt.h"

#include <stddef.h>
#include <string.h>

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_controller_t controller;

/* The finest line of these tests; the presets have room for it. */
#define CELLS_NEEDED 64

void setUp(void) {
    TEST_ASSERT_TRUE_MESSAGE(BELT_NODE_CAPACITY >= CELLS_NEEDED, "build with a preset");
    config = paper_case();
}

void tearDown(void) {
}

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* Fields that are numbers, each with the rule whose value it is. */
typedef struct {
    belt_status_t code;
    size_t offset;
} field_t;

static const field_t fields[] = {
    {BELT_BELT_LENGTH, offsetof(belt_config_t, belt_length)},
    {BELT_PROCESSING_TIME, offsetof(belt_config_t, processing_time)},
    {BELT_SPEED_WINDOW, offsetof(belt_config_t, speed_window)},
    {BELT_CONGESTION_SCALE, offsetof(belt_config_t, congestion_scale)},
    {BELT_CONNECTIVITY, offsetof(belt_config_t, connectivity)},
    {BELT_SERVICE_RATE_MAX, offsetof(belt_config_t, service_rate_max)},
    {BELT_SERVICE_TIME, offsetof(belt_config_t, service_time)},
    {BELT_LEVEL_CAPACITY, offsetof(belt_config_t, level_capacity)},
    {BELT_REWORK_RATE, offsetof(belt_config_t, rework_rate)},
    {BELT_LOSS_RATE, offsetof(belt_config_t, loss_rate)},
    {BELT_PERIOD, offsetof(belt_config_t, period)},
    {BELT_NOMINAL_FLUX_MAX, offsetof(belt_config_t, nominal_flux_max)},
    {BELT_LEVEL_SETPOINT, offsetof(belt_config_t, level_setpoint)},
    {BELT_INLET_FLUX_MAX, offsetof(belt_config_t, inlet_flux_max)},
};

/* The slope is a number too, but its rule's value is S. */
static const field_t slope_field = {BELT_SETPOINT_SLOPE, offsetof(belt_config_t, slope)};

static void set(const field_t *field, belt_real_t value) {
    memcpy((unsigned char *)&config + field->offset, &value, sizeof value);
}

static belt_real_t value_of(const field_t *field) {
    belt_real_t value;
    memcpy(&value, (const unsigned char *)&config + field->offset, sizeof value);
    return value;
}

static bool breaks(belt_status_t code) {
    uint64_t broken = 0;
    (void)belt_config_check(&config, &broken);
    return (broken & BELT_RULE_BIT(code)) != 0u;
}

static void assert_breaks_nothing_but(belt_status_t code) {
    uint64_t broken = 0;
    TEST_ASSERT_EQUAL_STRING(belt_status_name(code),
                             belt_status_name(belt_config_check(&config, &broken)));
    TEST_ASSERT_EQUAL_HEX64((code == BELT_OK) ? 0u : BELT_RULE_BIT(code), broken);
}

static void assert_limits(belt_status_t code, belt_real_t lower, belt_real_t upper) {
    const belt_rule_t rule = belt_config_rule(&config, code);
    TEST_ASSERT_EQUAL_DOUBLE((double)lower, (double)rule.lower);
    TEST_ASSERT_EQUAL_DOUBLE((double)upper, (double)rule.upper);
}

static void assert_refused_and_untouched(belt_status_t status) {
    static belt_controller_t before;
    memset(&controller, 0xA5, sizeof controller);
    memset(&before, 0xA5, sizeof before);
    TEST_ASSERT_EQUAL_STRING(belt_status_name(status),
                             belt_status_name(belt_init(&controller, &config)));
    TEST_ASSERT_TRUE(memcmp(&controller, &before, sizeof controller) == 0);
}

/* Breaks a rule; rules before it stay kept. */
static void break_rule(belt_status_t code) {
    const belt_real_t none = BELT_REAL(NAN);
    switch (code) {
        case BELT_BELT_LENGTH: config.belt_length = none; break;
        case BELT_PROCESSING_TIME: config.processing_time = none; break;
        case BELT_SPEED_WINDOW: config.speed_window = none; break;
        case BELT_CONGESTION_SCALE: config.congestion_scale = none; break;
        case BELT_CONNECTIVITY: config.connectivity = none; break;
        case BELT_SERVICE_RATE_MAX: config.service_rate_max = none; break;
        case BELT_SERVICE_TIME: config.service_time = none; break;
        case BELT_LEVEL_CAPACITY: config.level_capacity = none; break;
        case BELT_REWORK_RATE: config.rework_rate = none; break;
        case BELT_LOSS_COUNT: config.loss_count = 0; break;
        case BELT_LOSS_RATE: config.loss_rate[0] = none; break;
        case BELT_NODE_COUNT: config.node_count = 3; break;
        case BELT_PERIOD: config.period = none; break;
        case BELT_PERIOD_PER_NODE: config.period = BELT_REAL(0.026); break;
        case BELT_WINDOW_SHORT: config.speed_window = BELT_REAL(0.002); break;
        case BELT_WINDOW_LONG:
            config.speed_window = BELT_REAL(0.0025) * BELT_WINDOW_CAPACITY;
            break;
        case BELT_DEAD_TIME: config.congestion_scale = BELT_REAL(1e-6); break;
        case BELT_LOSS_EXPONENT: config.loss_rate[0] = BELT_REAL(17); break;
        case BELT_LOSS_PER_NODE: config.loss_rate[0] = BELT_REAL(9); break;
        case BELT_REWORK_PER_NODE: config.rework_rate = BELT_REAL(5); break;
        case BELT_REWORK_GAIN: config.rework_rate = BELT_REAL(3); break;
        case BELT_SERVICE_PER_NODE: config.service_time = BELT_REAL(0.05); break;
        case BELT_CONGESTION_PER_NODE: /* the dead time stays what it is */
            config.congestion_scale = BELT_REAL(0.09);
            config.speed_window = BELT_REAL(0.018);
            break;
        case BELT_NOMINAL_FLUX_MAX: config.nominal_flux_max = none; break;
        case BELT_LEVEL_SETPOINT: config.level_setpoint = none; break;
        case BELT_SLOPE_KIND: config.slope_kind = (belt_slope_kind_t)2; break;
        case BELT_SETPOINT_SLOPE: config.slope = none; break;
        case BELT_PERIOD_PER_SLOPE: config.slope = BELT_REAL(400); break;
        case BELT_INLET_FLUX_MAX: config.inlet_flux_max = none; break;
        case BELT_PREDICTION_KIND: config.prediction = (belt_prediction_kind_t)2; break;
        case BELT_OK:
        case BELT_MISUSE:
        case BELT_NO_LEVEL:
        case BELT_INPUT_REJECTED: break;
    }
}

/* --- the paper's case in numbers --- */

static void test_papers_case_breaks_no_rule(void) {
    assert_breaks_nothing_but(BELT_OK);
    TEST_ASSERT_EQUAL(BELT_OK, belt_config_check(&config, NULL));
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
}

static void test_derived_numbers_of_the_papers_case(void) {
    /* Four roundings at most in each: 4 EPSILON of the result. */
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.6, 0.6, (double)belt_config_setpoint_flux(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 2.0, 2.0, (double)belt_config_slope_min(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 22.0, 22.0, (double)belt_config_slope(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.6, 0.6, (double)belt_config_dead_time_max(&config));
}

static void test_above_the_middle_the_upper_branch_sets_the_least_slope(void) {
    /* Q* 0.5: flux 1; below (1.2 - 1)/0.5 = 0.4, above 1/0.5 = 2. Three roundings. */
    config.level_setpoint = BELT_REAL(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(3 * EPSILON * 2.0, 2.0, (double)belt_config_slope_min(&config));
}

static void test_units_enter_the_flux_and_the_dead_time(void) {
    config.service_time = BELT_REAL(2);
    config.congestion_scale = BELT_REAL(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.3, 0.3, (double)belt_config_setpoint_flux(&config));
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.7, 0.7, (double)belt_config_dead_time_max(&config));
}

static void test_absolute_slope_is_the_slope_itself(void) {
    config.slope_kind = BELT_SLOPE_ABSOLUTE;
    TEST_ASSERT_EQUAL_DOUBLE((double)config.slope, (double)belt_config_slope(&config));
}

/* --- every rule has its own code --- */

static void test_every_rule_can_be_the_first_one_broken(void) {
    for (int code = (int)BELT_RULE_FIRST; code <= (int)BELT_RULE_LAST; ++code) {
        config = paper_case();
        break_rule((belt_status_t)code);
        TEST_ASSERT_EQUAL_STRING(belt_status_name((belt_status_t)code),
                                 belt_status_name(belt_config_check(&config, NULL)));
        TEST_ASSERT_TRUE(breaks((belt_status_t)code));
    }
}

static void test_refused_init_gives_the_rules_code_and_leaves_the_struct_untouched(void) {
    for (int code = (int)BELT_RULE_FIRST; code <= (int)BELT_RULE_LAST; ++code) {
        config = paper_case();
        break_rule((belt_status_t)code);
        assert_refused_and_untouched((belt_status_t)code);
    }
}

static void test_of_two_broken_rules_the_first_is_returned_and_both_are_in_the_mask(void) {
    for (int first = (int)BELT_RULE_FIRST; first <= (int)BELT_RULE_LAST; ++first) {
        for (int second = first + 1; second <= (int)BELT_RULE_LAST; ++second) {
            config = paper_case();
            break_rule((belt_status_t)second);
            break_rule((belt_status_t)first);
            TEST_ASSERT_EQUAL_STRING(belt_status_name((belt_status_t)first),
                                     belt_status_name(belt_config_check(&config, NULL)));
            TEST_ASSERT_TRUE(breaks((belt_status_t)first));
            /* Two that share a field, or whose limit the first one moved, may not go together. */
            if ((first <= (int)BELT_LOSS_RATE) && (second >= (int)BELT_NOMINAL_FLUX_MAX)) {
                TEST_ASSERT_TRUE(breaks((belt_status_t)second));
            }
        }
    }
}

static void test_mask_holds_no_bit_that_is_no_rule(void) {
    memset(&config, 0xFF, sizeof config); /* every number NaN, every count its greatest */
    uint64_t broken = 0;
    TEST_ASSERT_EQUAL(BELT_RULE_FIRST, belt_config_check(&config, &broken));
    const uint64_t rules = 2u * BELT_RULE_BIT(BELT_RULE_LAST) - BELT_RULE_BIT(BELT_RULE_FIRST);
    TEST_ASSERT_EQUAL_HEX64(rules, broken);
}

/* --- value and limits --- */

static void test_rule_gives_the_value_of_its_field(void) {
    for (size_t i = 0; i < COUNT(fields); ++i) {
        TEST_ASSERT_EQUAL_DOUBLE((double)value_of(&fields[i]),
                                 (double)belt_config_rule(&config, fields[i].code).value);
    }
    TEST_ASSERT_EQUAL_DOUBLE((double)belt_config_slope(&config),
                             (double)belt_config_rule(&config, BELT_SETPOINT_SLOPE).value);
}

static void test_dimensions_lie_between_a_millionth_and_a_million(void) {
    const belt_status_t dimensions[] = {
        BELT_BELT_LENGTH,      BELT_PROCESSING_TIME, BELT_SPEED_WINDOW,   BELT_CONGESTION_SCALE,
        BELT_SERVICE_RATE_MAX, BELT_SERVICE_TIME,    BELT_LEVEL_CAPACITY, BELT_PERIOD};
    for (size_t i = 0; i < COUNT(dimensions); ++i) {
        assert_limits(dimensions[i], BELT_REAL(1e-6), BELT_REAL(1e6));
    }
    assert_limits(BELT_CONNECTIVITY, BELT_REAL(1e-6), BELT_REAL(1));
    assert_limits(BELT_REWORK_RATE, BELT_REAL(0), BELT_REAL(1e6));
    assert_limits(BELT_LOSS_RATE, BELT_REAL(0), BELT_REAL(1e6));
}

static void test_limits_of_the_law_follow_from_the_line(void) {
    /* Bmax <= min(Qmax/service_time, mu)/alpha = 0.8/0.5; Q* < alpha*Bmax*service_time = 0.6, and
     * eight roundings below it for the flux to stay below Bmax. */
    const belt_rule_t flux = belt_config_rule(&config, BELT_NOMINAL_FLUX_MAX);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 1.6, 1.6, (double)flux.upper);
    const belt_rule_t setpoint = belt_config_rule(&config, BELT_LEVEL_SETPOINT);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 0.6, 0.6 * (1 - 8 * EPSILON), (double)setpoint.upper);
    TEST_ASSERT_TRUE(setpoint.lower_open && setpoint.upper_open);

    config.service_time = BELT_REAL(2); /* now Qmax/service_time = 0.5 is the lesser */
    const belt_rule_t slower = belt_config_rule(&config, BELT_NOMINAL_FLUX_MAX);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, 1.0, (double)slower.upper);
    const belt_rule_t longer = belt_config_rule(&config, BELT_LEVEL_SETPOINT);
    TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON * 1.2, 1.2 * (1 - 8 * EPSILON), (double)longer.upper);
}

static void test_values_of_the_discretisation_rules(void) {
    /* At most six roundings each: 6 EPSILON of the number. */
    const belt_rule_t node = belt_config_rule(&config, BELT_PERIOD_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.025, 0.025, (double)node.upper);
    const belt_rule_t window = belt_config_rule(&config, BELT_WINDOW_LONG);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 82.0, 82.0, (double)window.value);
    const belt_rule_t dead_time = belt_config_rule(&config, BELT_DEAD_TIME);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 240.0, 240.0, (double)dead_time.value);
    const belt_rule_t exponent = belt_config_rule(&config, BELT_LOSS_EXPONENT);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.6, 0.6, (double)exponent.value);
    const belt_rule_t loss = belt_config_rule(&config, BELT_LOSS_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.03, 0.03, (double)loss.value);
    const belt_rule_t rework = belt_config_rule(&config, BELT_REWORK_PER_NODE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.006, 0.006, (double)rework.value);
    const belt_rule_t slope = belt_config_rule(&config, BELT_PERIOD_PER_SLOPE);
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON * 0.0275, 0.0275, (double)slope.value);
}

/* --- each edge, a unit in the last place to either side --- */

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
    }
    config = paper_case();
    config.prediction = BELT_HOLD_CONGESTION;
    assert_breaks_nothing_but(BELT_OK);
}

/* --- the loss profile --- */

static void test_every_value_of_the_loss_profile_is_looked_at(void) {
    const belt_real_t senseless[] = {BELT_REAL(NAN), BELT_REAL(-1e-9), BELT_REAL(INFINITY)};
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

/* --- hostile values --- */

static void assert_refused_whole(const field_t *field, belt_real_t value) {
    config = paper_case();
    set(field, value);
    TEST_ASSERT_TRUE(breaks(field->code));
    assert_refused_and_untouched(belt_config_check(&config, NULL));
}

static void test_no_field_may_be_nan_or_infinite_or_negative(void) {
    const belt_real_t hostile[] = {BELT_REAL(NAN),       -BELT_REAL(NAN),    BELT_REAL(INFINITY),
                                   BELT_REAL(-INFINITY), -BELT_REAL_MAX,     BELT_REAL(-1),
                                   BELT_REAL(-1e-9),     -real_from_bits(1u)};
    for (size_t i = 0; i < COUNT(fields); ++i) {
        for (size_t kind = 0; kind < COUNT(hostile); ++kind) {
            assert_refused_whole(&fields[i], hostile[kind]);
        }
    }
}

static void test_zero_is_refused_but_for_rework_and_loss(void) {
    for (size_t i = 0; i < COUNT(fields); ++i) {
        if ((fields[i].code == BELT_REWORK_RATE) || (fields[i].code == BELT_LOSS_RATE)) {
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
    RUN_TEST(test_papers_case_breaks_no_rule);
    RUN_TEST(test_derived_numbers_of_the_papers_case);
    RUN_TEST(test_above_the_middle_the_upper_branch_sets_the_least_slope);
    RUN_TEST(test_units_enter_the_flux_and_the_dead_time);
    RUN_TEST(test_absolute_slope_is_the_slope_itself);
    RUN_TEST(test_every_rule_can_be_the_first_one_broken);
    RUN_TEST(test_refused_init_gives_the_rules_code_and_leaves_the_struct_untouched);
    RUN_TEST(test_of_two_broken_rules_the_first_is_returned_and_both_are_in_the_mask);
    RUN_TEST(test_mask_holds_no_bit_that_is_no_rule);
    RUN_TEST(test_rule_gives_the_value_of_its_field);
    RUN_TEST(test_dimensions_lie_between_a_millionth_and_a_million);
    RUN_TEST(test_limits_of_the_law_follow_from_the_line);
    RUN_TEST(test_values_of_the_discretisation_rules);
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
    RUN_TEST(test_edges_of_node_count);
    RUN_TEST(test_edges_of_loss_count);
    RUN_TEST(test_words_that_do_not_exist_are_refused);
    RUN_TEST(test_every_value_of_the_loss_profile_is_looked_at);
    RUN_TEST(test_values_behind_the_loss_count_are_not_looked_at);
    RUN_TEST(test_loss_exponent_takes_the_mean_of_the_profile_and_the_node_its_worst);
    RUN_TEST(test_no_field_may_be_nan_or_infinite_or_negative);
    RUN_TEST(test_zero_is_refused_but_for_rework_and_loss);
    RUN_TEST(test_huge_is_refused_but_for_the_actuator);
    RUN_TEST(test_no_slope_of_either_kind_may_be_senseless);
    return UNITY_END();
}
