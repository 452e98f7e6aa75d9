/* SPDX-License-Identifier: MIT */
/* Every rule has its own code, and its bit in the mask. */
#include "config_case.h"

void setUp(void) {
    begin_with_papers_case();
}

void tearDown(void) {
}

static const belt_real_t none = BELT_REAL(NAN);

static void break_line_rule(belt_status_t code) {
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
        default: TEST_FAIL_MESSAGE("no rule of the line"); break;
    }
}

static void break_discretisation_rule(belt_status_t code) {
    switch (code) {
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
        default: TEST_FAIL_MESSAGE("no rule of the discretisation"); break;
    }
}

static void break_later_rule(belt_status_t code) {
    switch (code) {
        case BELT_NOMINAL_FLUX_MAX: config.nominal_flux_max = none; break;
        case BELT_LEVEL_SETPOINT: config.level_setpoint = none; break;
        case BELT_SLOPE_KIND: config.slope_kind = (belt_slope_kind_t)2; break;
        case BELT_SETPOINT_SLOPE: config.slope = none; break;
        case BELT_PERIOD_PER_SLOPE: config.slope = BELT_REAL(400); break;
        case BELT_INLET_FLUX_MAX: config.inlet_flux_max = none; break;
        case BELT_PREDICTION_KIND: config.prediction = (belt_prediction_kind_t)2; break;
        case BELT_ESTIMATOR_KIND: config.estimator = (belt_estimator_kind_t)2; break;
        case BELT_ESTIMATOR_TIME: config.estimator_time = none; break;
        case BELT_FLUX_RATE_MAX: config.flux_rate_max = none; break;
        case BELT_SUBSTITUTE_FLUX: config.substitute_flux = none; break;
        case BELT_LEVEL_STEP_MAX: config.level_step_max = none; break;
        case BELT_TRANSFER_TIME: config.transfer_time = none; break;
        default: TEST_FAIL_MESSAGE("no rule"); break;
    }
}

/* Breaks a rule; rules before it stay kept. */
static void break_rule(belt_status_t code) {
    if (code <= BELT_LOSS_RATE) {
        break_line_rule(code);
    } else if (code <= BELT_CONGESTION_PER_NODE) {
        break_discretisation_rule(code);
    } else {
        break_later_rule(code);
    }
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

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_every_rule_can_be_the_first_one_broken);
    RUN_TEST(test_refused_init_gives_the_rules_code_and_leaves_the_struct_untouched);
    RUN_TEST(test_of_two_broken_rules_the_first_is_returned_and_both_are_in_the_mask);
    RUN_TEST(test_mask_holds_no_bit_that_is_no_rule);
    return UNITY_END();
}
