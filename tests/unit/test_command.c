/* SPDX-License-Identifier: MIT */
#include "belt/command.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_model_t model;
static belt_nominal_law_t law;
static belt_prediction_t prediction;

/** The line at rest at the set-point as a finished march would see it, without loss and rework on
 * the way; tests change one thing each. */
static void rest_at_setpoint(void) {
    const rest_t rest = line_at_rest(&config);
    belt_line_init(&model.line, &config);
    belt_nominal_law_init(&law, &config);
    belt_level_history_init(&model.history, &config);
    belt_level_history_begin(&model.history, config.level_setpoint);
    memset(&model.present, 0, sizeof model.present);
    model.present.level = config.level_setpoint;
    model.present.congestion = belt_level_history_congestion(&model.history);
    memset(&prediction, 0, sizeof prediction);
    prediction.inlet.level = config.level_setpoint;
    prediction.inlet.arrival = BELT_REAL(rest.dead_time);
    prediction.inlet.congestion = BELT_REAL(rest.congestion);
    prediction.present_tail = config.level_setpoint;
    prediction.inlet.tail = config.level_setpoint;
    prediction.inlet_survival = BELT_REAL(1);
}

void setUp(void) {
    config = paper_case();
    rest_at_setpoint();
}

void tearDown(void) {
}

static void arrive_at_slowness(double slowness) {
    prediction.inlet.congestion = BELT_REAL((slowness / (double)config.processing_time - 1.0) *
                                            (double)config.congestion_scale);
}

static double solve(void) {
    return (double)belt_command_solve(&prediction, &model, &law);
}

/** The law in double, by the firmware's own function: it has its own tests. */
static double nominal(double level) {
    return (double)belt_nominal_law_flux(&law, BELT_REAL(level));
}

/* A solve takes some twenty roundings of numbers of the size of the result. Where the law is at work
 * a rounding of the level counts its slope S times as much. */
#define ROUNDING (20 * EPSILON)
static double steep(void) {
    return ROUNDING * (double)belt_config_slope(&config);
}

#define HALF_HOLD 0.00125

/* --- limits --- */

static void test_flux_within_the_limits_stays_itself(void) {
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(0.5), BELT_REAL(1)) == BELT_REAL(0.5));
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(1), BELT_REAL(1)) == BELT_REAL(1));
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL_MAX, BELT_NO_FLUX_LIMIT) == BELT_REAL_MAX);
    TEST_ASSERT_TRUE(belt_command_limit(real_from_bits(1u), BELT_REAL(1)) == real_from_bits(1u));
}

static void test_flux_below_zero_feeds_nothing(void) {
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(-0.5), BELT_REAL(1)) == BELT_REAL(0));
    TEST_ASSERT_TRUE(belt_command_limit(-real_from_bits(1u), BELT_REAL(1)) == BELT_REAL(0));
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(-INFINITY), BELT_REAL(1)) == BELT_REAL(0));
    TEST_ASSERT_TRUE(real_bits(belt_command_limit(BELT_REAL(-0.0), BELT_REAL(1))) == 0u);
}

static void test_flux_above_the_limit_is_the_limit(void) {
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(1.5), BELT_REAL(1)) == BELT_REAL(1));
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL_MAX, BELT_REAL(1)) == BELT_REAL(1));
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(INFINITY), BELT_REAL(1)) == BELT_REAL(1));
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(INFINITY), BELT_NO_FLUX_LIMIT) == BELT_REAL_MAX);
}

static void test_flux_that_is_no_number_feeds_nothing(void) {
    TEST_ASSERT_TRUE(belt_command_limit(BELT_REAL(NAN), BELT_REAL(1)) == BELT_REAL(0));
    TEST_ASSERT_TRUE(belt_command_limit(-BELT_REAL(NAN), BELT_NO_FLUX_LIMIT) == BELT_REAL(0));
}

/* --- one thing at a time --- */

static void test_without_loss_rework_and_change_the_command_is_what_the_law_wants(void) {
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.6, solve());
}

static void test_loss_is_made_up_for(void) {
    config.loss_rate[0] = BELT_REAL(0);
    rest_at_setpoint();
    prediction.inlet_survival = BELT_REAL(0.5);
    TEST_ASSERT_DOUBLE_WITHIN(2 * steep(), 1.2, solve());
}

static void test_rework_need_not_be_fed(void) {
    /* slowness*(flux in place of what the rework brings): 0.6 - 0.05/0.265 parts/s. */
    prediction.inlet_rework = BELT_REAL(0.05);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.6 - 0.05 / 0.265, solve());
}

static void test_more_rework_than_is_wanted_asks_for_a_flux_below_zero(void) {
    prediction.inlet_rework = BELT_REAL(0.2);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.6 - 0.2 / 0.265, solve());
}

static void test_a_slower_arrival_needs_a_denser_feed(void) {
    /* The density that makes up the flux at arrival, fed at the speed of now. Gap and half hold
     * differ by 1/0.265*0.53, which counts for loss; so none here. */
    config.loss_rate[0] = BELT_REAL(0);
    rest_at_setpoint();
    arrive_at_slowness(0.53);
    TEST_ASSERT_DOUBLE_WITHIN(2 * steep(), 0.6 * 0.53 / 0.265, solve());
}

/* --- aimed at the middle of the hold --- */

static void test_level_is_that_of_half_a_hold_later(void) {
    /* Off the set-point the level moves on by what the law itself lets arrive, less the service,
     * for half a period. */
    prediction.inlet.level = BELT_REAL(0.25);
    const double later = 0.25 + HALF_HOLD * (0.5 * nominal(0.25) - 0.25);
    prediction.inlet.tail = BELT_REAL(0.25);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), nominal(later), solve());
}

static void test_half_a_hold_is_longer_at_the_outlet_of_a_slower_line(void) {
    config.loss_rate[0] = BELT_REAL(0);
    rest_at_setpoint();
    prediction.inlet.level = BELT_REAL(0.25);
    prediction.inlet.tail = BELT_REAL(0.25);
    arrive_at_slowness(0.53);
    const double later = 0.25 + 2.0 * HALF_HOLD * (0.5 * nominal(0.25) - 0.25);
    TEST_ASSERT_DOUBLE_WITHIN(2 * steep(), 2.0 * nominal(later), solve());
}

static void test_feeding_speed_is_that_of_the_middle_of_the_hold(void) {
    /* Now 0.3 enters the window and 0.1 leaves it: slower by P*0.2 each second. */
    prediction.present_tail = BELT_REAL(0.1);
    const double slower = 0.265 + 0.25 * HALF_HOLD * (0.3 - 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.6 * 0.265 / slower, solve());
}

static void test_arriving_speed_is_that_of_half_a_hold_later(void) {
    prediction.inlet.tail = BELT_REAL(0.1);
    const double slower = 0.265 + 0.25 * HALF_HOLD * (0.3 - 0.1);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.6 * slower / 0.265, solve());
}

static void test_loss_counts_the_longer_way_of_what_is_fed_later(void) {
    /* Twice as slow at arrival: what is fed half a hold later arrives a whole hold later. */
    arrive_at_slowness(0.53);
    const double survival = 1.0 - 1.0 * (2.0 * HALF_HOLD - HALF_HOLD);
    TEST_ASSERT_DOUBLE_WITHIN(2 * steep(), 2.0 * 0.6 / survival, solve());
}

static void test_rework_is_that_of_half_a_hold_further_in(void) {
    prediction.inlet_rework = BELT_REAL(0.05);
    prediction.inlet_rework_slope = BELT_REAL(0.5);
    const double spacings = HALF_HOLD / (0.1 * 0.265);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.6 - (0.05 + 0.5 * spacings) / 0.265, solve());
}

/* --- with a disturbance --- */

/** A flow into the buffer that the model does not know. */
static void disturb(double flow) {
    model.present.disturbance = BELT_REAL(flow);
    model.present.disturbance_flux = BELT_REAL(flow / 0.5);
}

static void test_disturbance_need_not_be_fed(void) {
    /* At rest 0.1 of the 0.3 served comes of itself: 0.6 - 0.1/0.5. */
    disturb(0.1);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.4, solve());
}

static void test_leak_is_fed_besides(void) {
    disturb(-0.1);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), 0.8, solve());
}

static void test_more_disturbance_than_is_wanted_leaves_nothing_to_feed(void) {
    /* 0.35 come of themselves where 0.3 are served; the level rises for half a hold, no more is
     * wanted than nothing. */
    disturb(0.35);
    TEST_ASSERT_TRUE(solve() == 0.0);
    prediction.inlet_rework = BELT_REAL(0.05);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), -0.05 / 0.265, solve());
}

static void test_level_half_a_hold_later_is_that_of_law_and_disturbance(void) {
    /* alpha*(law - disturbance/alpha) + disturbance: as if there were none, but for what is fed. */
    prediction.inlet.level = BELT_REAL(0.25);
    prediction.inlet.tail = BELT_REAL(0.25);
    const double later = 0.25 + HALF_HOLD * (0.5 * nominal(0.25) - 0.25);
    disturb(0.125);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), nominal(later) - 0.25, solve());
}

static void test_level_half_a_hold_later_takes_each_of_the_two_for_itself(void) {
    /* Where less than nothing would be wanted they are not each other's opposite: so one alone. */
    prediction.inlet.level = BELT_REAL(0.25);
    prediction.inlet.tail = BELT_REAL(0.25);
    model.present.disturbance = BELT_REAL(0.125);
    const double filled = 0.25 + HALF_HOLD * (0.5 * nominal(0.25) + 0.125 - 0.25);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), nominal(filled), solve());
    model.present.disturbance = BELT_REAL(0);
    model.present.disturbance_flux = BELT_REAL(0.25);
    const double unfed = 0.25 + HALF_HOLD * (0.5 * (nominal(0.25) - 0.25) - 0.25);
    TEST_ASSERT_DOUBLE_WITHIN(steep(), nominal(unfed) - 0.25, solve());
}

static void test_law_less_the_disturbance_is_wanted_and_never_less_than_nothing(void) {
    model.present.disturbance_flux = BELT_REAL(0.25);
    const belt_real_t at_setpoint =
        belt_command_wanted(&law, &model.present, config.level_setpoint);
    TEST_ASSERT_TRUE(at_setpoint == law.setpoint_flux - BELT_REAL(0.25));
    model.present.disturbance_flux = law.setpoint_flux;
    TEST_ASSERT_TRUE(belt_command_wanted(&law, &model.present, config.level_setpoint) ==
                     BELT_REAL(0));
    model.present.disturbance_flux = BELT_REAL(1);
    TEST_ASSERT_TRUE(belt_command_wanted(&law, &model.present, config.level_setpoint) ==
                     BELT_REAL(0));
    model.present.disturbance_flux = BELT_REAL(NAN);
    TEST_ASSERT_TRUE(belt_command_wanted(&law, &model.present, config.level_setpoint) ==
                     BELT_REAL(0));
}

/* --- all together --- */

static void test_stationary_belt_is_fed_the_flux_that_holds_it(void) {
    /* Survival and rework of the stationary belt in closed form; density at the inlet then is
     * (outlet density - rework)/survival. */
    const rest_t rest = line_at_rest(&config);
    const double survival = exp(-rest.dead_time);
    prediction.inlet_survival = BELT_REAL(survival);
    prediction.inlet_rework =
        BELT_REAL(rest.outlet_density - survival * rest.inlet_flux * rest.slowness);
    TEST_ASSERT_DOUBLE_WITHIN(2 * steep(), rest.inlet_flux, solve());
    /* The reference number of the paper's case, to its five decimals. */
    TEST_ASSERT_DOUBLE_WITHIN(5e-6 + 2 * steep(), 0.97374, solve());
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_flux_within_the_limits_stays_itself);
    RUN_TEST(test_flux_below_zero_feeds_nothing);
    RUN_TEST(test_flux_above_the_limit_is_the_limit);
    RUN_TEST(test_flux_that_is_no_number_feeds_nothing);
    RUN_TEST(test_without_loss_rework_and_change_the_command_is_what_the_law_wants);
    RUN_TEST(test_loss_is_made_up_for);
    RUN_TEST(test_rework_need_not_be_fed);
    RUN_TEST(test_more_rework_than_is_wanted_asks_for_a_flux_below_zero);
    RUN_TEST(test_a_slower_arrival_needs_a_denser_feed);
    RUN_TEST(test_level_is_that_of_half_a_hold_later);
    RUN_TEST(test_half_a_hold_is_longer_at_the_outlet_of_a_slower_line);
    RUN_TEST(test_feeding_speed_is_that_of_the_middle_of_the_hold);
    RUN_TEST(test_arriving_speed_is_that_of_half_a_hold_later);
    RUN_TEST(test_loss_counts_the_longer_way_of_what_is_fed_later);
    RUN_TEST(test_rework_is_that_of_half_a_hold_further_in);
    RUN_TEST(test_disturbance_need_not_be_fed);
    RUN_TEST(test_leak_is_fed_besides);
    RUN_TEST(test_more_disturbance_than_is_wanted_leaves_nothing_to_feed);
    RUN_TEST(test_level_half_a_hold_later_is_that_of_law_and_disturbance);
    RUN_TEST(test_level_half_a_hold_later_takes_each_of_the_two_for_itself);
    RUN_TEST(test_law_less_the_disturbance_is_wanted_and_never_less_than_nothing);
    RUN_TEST(test_stationary_belt_is_fed_the_flux_that_holds_it);
    return UNITY_END();
}
