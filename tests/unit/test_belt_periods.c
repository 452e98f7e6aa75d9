/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/* --- late periods are made up for --- */

/** Elapsed periods of the next step. */
static void elapse(uint32_t periods) {
    measurement.present |= BELT_HAS_ELAPSED_TICKS;
    measurement.elapsed_ticks = periods;
}

/** A level that rises and falls on straight lines of 60 periods, 30 or fewer of them in a step. */
static double course(uint32_t period) {
    const uint32_t phase = period % 120u;
    return 0.2 + 0.002 * (double)((phase < 60u) ? phase : 120u - phase);
}

/** Flux that holds for 60 periods at a time. */
static double fed(uint32_t period) {
    return ((period / 60u) % 2u == 0u) ? 0.5 : 0.8;
}

/** Drives `late` with every `stride`-th of the periods that `on_time` sees all of. */
static void drive(belt_controller_t *on_time, belt_controller_t *late, uint32_t stride,
                  uint32_t count) {
    belt_command_t answer;
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX | BELT_HAS_ELAPSED_TICKS;
    for (uint32_t period = 0; period <= count; ++period) {
        measurement.level = BELT_REAL(course(period));
        measurement.applied_flux = BELT_REAL((period == 0u) ? 0.0 : fed(period - 1u));
        measurement.elapsed_ticks = 1u;
        (void)belt_step(on_time, &measurement, &answer);
        if (period % stride == 0u) {
            measurement.elapsed_ticks = (period == 0u) ? 1u : stride;
            (void)belt_step(late, &measurement, &answer);
        }
    }
}

/** After 40 steps of `stride` periods: what the late one knows is what the other knows. */
static void assert_late_is_as_good(uint32_t stride) {
    static belt_controller_t late;
    start();
    late = controller;
    drive(&controller, &late, stride, 40u * stride);
    /* Levels on straight lines: nothing but a quantum of rounding each is lost. */
    for (uint32_t age = 0; age <= 80u; ++age) {
        TEST_ASSERT_DOUBLE_WITHIN(
            8 * EPSILON, (double)belt_level_history_at(&controller.model.history, (belt_real_t)age),
            (double)belt_level_history_at(&late.model.history, (belt_real_t)age));
    }
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, (double)controller.model.present.congestion,
                              (double)late.model.present.congestion);
    /* The speed is that in the middle of a stretch instead of each period's: measured 3e-4 of a
     * spacing, 4e-4 of a density and 2e-6 of a level; one period forgotten would be 0.1 spacing. */
    TEST_ASSERT_DOUBLE_WITHIN(
        1e-3, (double)controller.model.observer.gone + (double)controller.model.observer.outlet,
        (double)late.model.observer.gone + (double)late.model.observer.outlet);
    for (uint32_t place = 0; place <= 20u; ++place) {
        const belt_real_t at = (belt_real_t)place;
        TEST_ASSERT_DOUBLE_WITHIN(
            1e-3,
            (double)belt_observer_density_at(&controller.model.observer, &controller.model.line,
                                             at),
            (double)belt_observer_density_at(&late.model.observer, &late.model.line, at));
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, (double)controller.prediction.inlet.level,
                              (double)late.prediction.inlet.level);
}

static void test_late_steps_know_what_steps_on_time_know(void) {
    const uint32_t strides[] = {2u, 5u, 10u, 20u, 30u, 60u};
    for (size_t i = 0; i < sizeof strides / sizeof strides[0]; ++i) {
        assert_late_is_as_good(strides[i]);
    }
}

static void test_late_step_is_said_and_made_up_for_up_to_the_cap(void) {
    (void)step_level(0.25);
    const uint32_t late[] = {2u, 10u, 11u, BELT_CATCH_UP_PERIODS};
    for (size_t i = 0; i < sizeof late / sizeof late[0]; ++i) {
        elapse(late[i]);
        TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_level(0.25));
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIODS_LATE, command.error_bits);
        TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
        TEST_ASSERT_EQUAL_UINT32(late[i], controller.trusted.periods);
    }
    elapse(1u);
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25));
}

static void test_beyond_the_cap_the_level_is_doubted(void) {
    const uint32_t lost[] = {BELT_CATCH_UP_PERIODS + 1u, 100000u, UINT32_MAX};
    for (size_t i = 0; i < sizeof lost / sizeof lost[0]; ++i) {
        start();
        elapse(1u);
        (void)step_level(0.25);
        elapse(lost[i]);
        TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_level(0.25));
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIODS_LOST, command.error_bits);
        TEST_ASSERT_EQUAL(BELT_MODE_HOLD, command.mode);
        TEST_ASSERT_EQUAL_UINT32(BELT_CATCH_UP_PERIODS, controller.trusted.periods);
        elapse(1u);
        steps_level(0.25, 10u);
        TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
    }
}

/* --- a repeated period --- */

/** All that the belt knows, but for what every step writes. */
static bool stands_still(const belt_controller_t *before) {
    return (memcmp(&before->model.history, &controller.model.history,
                   sizeof controller.model.history) == 0) &&
           (memcmp(&before->model.observer, &controller.model.observer,
                   sizeof controller.model.observer) == 0) &&
           (memcmp(&before->model.estimator, &controller.model.estimator,
                   sizeof controller.model.estimator) == 0) &&
           (memcmp(&before->model.present, &controller.model.present,
                   sizeof controller.model.present) == 0) &&
           (memcmp(&before->supervisor, &controller.supervisor, sizeof controller.supervisor) ==
            0) &&
           (before->command.inlet_flux == controller.command.inlet_flux) &&
           (before->command.mode == controller.command.mode);
}

static void test_repeated_period_moves_nothing(void) {
    static belt_controller_t before;
    config.estimator = BELT_ESTIMATOR_ON;
    start();
    for (uint32_t i = 0; i < 100u; ++i) {
        elapse(1u);
        TEST_ASSERT_EQUAL(BELT_OK, step_level(0.2 + 0.001 * i));
        before = controller;
        elapse(0u);
        TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_level(0.21 + 0.001 * i));
        TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIOD_REPEATED, command.error_bits);
        TEST_ASSERT_TRUE(stands_still(&before));
    }
}

static void test_repeated_period_moves_nothing_before_the_first_level_either(void) {
    config.flux_rate_max = BELT_REAL(40); /* 0.1 parts/s a step */
    start();
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.8)));
    elapse(1u);
    (void)step_blind();
    const belt_real_t before = command.inlet_flux;
    elapse(0u);
    (void)step_blind();
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIOD_REPEATED | BELT_ERROR_LEVEL_MISSING,
                            command.error_bits);
    TEST_ASSERT_TRUE(command.inlet_flux == before);
}

static void test_step_called_twice_with_the_same_sample_does_not_doubt_the_level(void) {
    measurement.present |= BELT_HAS_SAMPLE_COUNT;
    elapse(1u);
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25));
    elapse(0u);
    TEST_ASSERT_EQUAL(BELT_PERIODS_MISSED, step_level(0.25));
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_PERIOD_REPEATED, command.error_bits);
    elapse(1u);
    measurement.sample_count = 1u;
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25));
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
}

static void test_hold_counts_periods_and_not_steps(void) {
    /* hold_periods is half the empty line's dead time: 100 periods, 10 steps of 10. */
    elapse(1u);
    steps_level(0.25, 20u);
    elapse(10u);
    steps_blind(10u);
    TEST_ASSERT_EQUAL(BELT_MODE_HOLD, command.mode);
    (void)step_blind();
    TEST_ASSERT_EQUAL(BELT_MODE_SUBSTITUTE, command.mode);
}

/* --- a long rest --- */

/* At rest on an empty buffer this line moves an eighth of a spacing a period, exactly. */
#define PERIODS_A_SPACING 8

static void make_dyadic(void) {
    config.node_count = 16;
    config.period = BELT_REAL(0.00390625);
    config.speed_window = BELT_REAL(0.125);
    config.level_step_max = BELT_REAL(1);
    start();
}

static void test_a_long_rest_leaves_no_trace(void) {
    static belt_controller_t rested;
    belt_command_t of_rested;
    make_dyadic();
    for (int i = 0; i < 2000 * PERIODS_A_SPACING; ++i) {
        TEST_ASSERT_EQUAL(BELT_OK, step_level(0.0));
    }
    rested = controller;
    for (int i = 0; i < 16000 * PERIODS_A_SPACING; ++i) {
        measurement.level = BELT_REAL(0);
        TEST_ASSERT_EQUAL(BELT_OK, belt_step(&rested, &measurement, &of_rested));
    }
    /* From here on both see the same, and the same comes out: rest is a cycle of the last bits of the
     * densities, three roundings wide, and the law's slope over the survival makes 50 of one. Over
     * 16,000 spacings a drift by a rounding each would be 100 times the limit. */
    for (int i = 0; i < 500; ++i) {
        measurement.level = BELT_REAL(0.5 + 0.5 * sin(0.02 * i));
        TEST_ASSERT_EQUAL(BELT_OK, belt_step(&rested, &measurement, &of_rested));
        TEST_ASSERT_EQUAL(BELT_OK, belt_step(&controller, &measurement, &command));
        TEST_ASSERT_DOUBLE_WITHIN(150 * EPSILON, (double)command.inlet_flux,
                                  (double)of_rested.inlet_flux);
        TEST_ASSERT_TRUE(of_rested.inlet_flux >= BELT_REAL(0));
    }
}

static void test_late_step_corrects_the_estimate_once_however_many_stretches_it_takes(void) {
    static belt_controller_t before;
    config.estimator = BELT_ESTIMATOR_ON;
    start();
    elapse(1u);
    (void)begin_at_rest();
    steps_level(0.3, 50u);
    before = controller;
    elapse(35u); /* four stretches of a node spacing, 10 periods each */
    (void)step_blind();
    const double expected = (double)controller.model.estimator.level;
    controller = before;
    (void)step_level(0.4);
    const belt_estimator_gains_t *gains = &controller.model.estimator_gains;
    const double old = (double)before.model.estimator.difference;
    const double difference = old + (double)gains->filter * (0.4 - expected - old);
    const double gained = (double)gains->disturbance * difference;
    /* Six roundings of numbers below 0.4, of which the disturbance takes its gain's share. */
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON, gained,
                              (double)controller.model.estimator.disturbance -
                                  (double)before.model.estimator.disturbance);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_late_steps_know_what_steps_on_time_know);
    RUN_TEST(test_late_step_is_said_and_made_up_for_up_to_the_cap);
    RUN_TEST(test_beyond_the_cap_the_level_is_doubted);
    RUN_TEST(test_repeated_period_moves_nothing);
    RUN_TEST(test_repeated_period_moves_nothing_before_the_first_level_either);
    RUN_TEST(test_step_called_twice_with_the_same_sample_does_not_doubt_the_level);
    RUN_TEST(test_hold_counts_periods_and_not_steps);
    RUN_TEST(test_a_long_rest_leaves_no_trace);
    RUN_TEST(test_late_step_corrects_the_estimate_once_however_many_stretches_it_takes);
    return UNITY_END();
}
