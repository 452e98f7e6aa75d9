/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/** The command of a switch beside the last one. */
static void assert_bumpless(belt_mode_t expected, double last, double law_step) {
    TEST_ASSERT_EQUAL(expected, command.mode);
    /* last - own + own: three roundings of fluxes of about 2. */
    TEST_ASSERT_DOUBLE_WITHIN(law_step + 8 * EPSILON, last, flux());
}

/* --- from mode to mode --- */

/** Brings the controller into a mode, a moving level under it. */
static void enter(belt_mode_t mode) {
    config.substitute_flux = BELT_REAL(0.6);
    start();
    for (int i = 0; i < 100; ++i) {
        (void)step_level(0.15 + 0.001 * i);
    }
    switch (mode) {
        case BELT_MODE_OFF: ask(BELT_MODE_OFF); break;
        case BELT_MODE_MANUAL: ask(BELT_MODE_MANUAL); break;
        case BELT_MODE_AUTOMATIC: break;
        case BELT_MODE_HOLD: steps_blind(30u); break;
        case BELT_MODE_SUBSTITUTE: steps_blind(300u); break;
    }
    if ((mode == BELT_MODE_OFF) || (mode == BELT_MODE_MANUAL)) {
        steps_level(0.25, 30u);
    }
    TEST_ASSERT_EQUAL(mode, command.mode);
}

static const belt_mode_t all_modes[] = {BELT_MODE_OFF, BELT_MODE_MANUAL, BELT_MODE_AUTOMATIC,
                                        BELT_MODE_HOLD, BELT_MODE_SUBSTITUTE};

static void test_manual_after_any_mode_begins_with_the_last_command(void) {
    for (size_t i = 0; i < 5u; ++i) {
        enter(all_modes[i]);
        const double last = flux();
        ask(BELT_MODE_MANUAL);
        (void)step_level(0.25);
        assert_bumpless(BELT_MODE_MANUAL, last, 0.0);
    }
}

static void test_off_after_any_mode_feeds_nothing(void) {
    for (size_t i = 0; i < 5u; ++i) {
        enter(all_modes[i]);
        ask(BELT_MODE_OFF);
        (void)step_level(0.25);
        assert_nothing_is_fed();
    }
}

static void test_automatic_after_manual_starts_from_its_flux_and_goes_over_to_the_law(void) {
    static belt_controller_t law; /* the same line, its belt fed alike, always in automatic */
    belt_command_t of_law;
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX;
    (void)begin_at_rest();
    ask(BELT_MODE_MANUAL);
    measurement.applied_flux = command.inlet_flux;
    (void)step_level(0.3);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.25)));
    law = controller;
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_mode(&law, BELT_MODE_AUTOMATIC));
    for (int i = 0; i < 400; ++i) {
        if (i == 100) {
            TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.25));
            ask(BELT_MODE_AUTOMATIC);
        }
        measurement.applied_flux = command.inlet_flux;
        measurement.level = BELT_REAL(0.3);
        (void)belt_step(&law, &measurement, &of_law);
        const double last = flux();
        (void)step();
        if (i == 100) {
            assert_bumpless(BELT_MODE_AUTOMATIC, last, 0.0);
            TEST_ASSERT_TRUE(fabs((double)of_law.inlet_flux - last) > 0.5);
        }
    }
    /* 300 periods of 50 that a bump takes: exp(-6) of a bump below 3. */
    TEST_ASSERT_DOUBLE_WITHIN(3 * exp(-6.0), (double)of_law.inlet_flux, flux());
}

static void test_a_bump_ends_exactly(void) {
    (void)begin_at_rest();
    ask(BELT_MODE_MANUAL);
    steps_level(0.3, 2u);
    ask(BELT_MODE_AUTOMATIC);
    steps_level(0.25, 1u);
    TEST_ASSERT_TRUE(fabs((double)controller.supervisor.bump) > 0.1);
    /* ln(1e6) of 50 periods each. */
    steps_level(0.25, 800u);
    TEST_ASSERT_TRUE(controller.supervisor.bump == BELT_REAL(0));
}

static void test_hold_substitute_and_automatic_again_go_over_without_a_jump(void) {
    config.substitute_flux = BELT_REAL(0.6);
    start();
    steps_level(0.28, 100u);
    double last = flux();
    (void)step_blind();
    assert_bumpless(BELT_MODE_HOLD, last, 0.0);
    for (int i = 1; i < 100; ++i) { /* half the dead time of 200 periods */
        (void)step_blind();
        TEST_ASSERT_EQUAL(BELT_MODE_HOLD, command.mode);
    }
    last = flux();
    (void)step_blind();
    assert_bumpless(BELT_MODE_SUBSTITUTE, last, 0.0);
    steps_blind(800u);
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.6));
    for (int i = 1; i < 10; ++i) {
        TEST_ASSERT_EQUAL(BELT_OK, step_level(0.28));
        TEST_ASSERT_EQUAL(BELT_MODE_SUBSTITUTE, command.mode);
    }
    last = flux();
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.28));
    assert_bumpless(BELT_MODE_AUTOMATIC, last, 0.0);
}

static void test_one_good_sample_does_not_end_a_hold_and_one_bad_begins_it_anew(void) {
    steps_level(0.25, 10u);
    (void)step_blind();
    steps_level(0.25, 9u);
    TEST_ASSERT_EQUAL(BELT_MODE_HOLD, command.mode);
    (void)step_blind();
    steps_level(0.25, 9u);
    TEST_ASSERT_EQUAL(BELT_MODE_HOLD, command.mode);
    steps_level(0.25, 1u);
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
}

/* --- the rate limit --- */

static void test_rate_limit_holds_at_every_step_of_any_walk_through_the_modes(void) {
    uint64_t random = 0x1234567u;
    config.flux_rate_max = BELT_REAL(20); /* 0.05 parts/s a step */
    config.inlet_flux_max = BELT_REAL(2.5);
    config.substitute_flux = BELT_REAL(2);
    config.estimator = BELT_ESTIMATOR_ON;
    start();
    double last = 0.0;
    for (int i = 0; i < 50000; ++i) {
        const uint64_t bits = random_bits(&random);
        if ((bits & 63u) == 0u) {
            ask((belt_mode_t)((bits >> 8) % 3u));
            (void)belt_set_manual_flux(&controller, BELT_REAL(2.5) * random_share(&random));
        }
        const bool is_blind = ((bits >> 20) & 0x1FFu) < 256u && ((i / 400) % 3 == 2);
        (void)(is_blind ? step_blind() : step_level(0.3 + 0.2 * sin(0.003 * i)));
        /* Two roundings of a flux of up to 2.5. */
        TEST_ASSERT_DOUBLE_WITHIN(0.05 + 4 * EPSILON, last, flux());
        TEST_ASSERT_TRUE(flux() <= 2.5);
        last = flux();
    }
}

static void test_manual_flux_that_moves_before_the_bump_has_gone_is_what_is_fed(void) {
    steps_level(0.25, 50u);
    ask(BELT_MODE_MANUAL);
    (void)step_level(0.25);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(2.0)));
    (void)step_level(0.25);
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(2.0));
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.5)));
    (void)step_level(0.25);
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.5));
}

static void test_manual_asked_for_again_keeps_its_flux(void) {
    steps_level(0.25, 50u);
    config.flux_rate_max = BELT_REAL(4); /* 0.01 parts/s a step: the command is still on its way */
    start();
    steps_level(0.25, 5u);
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.75)));
    (void)step_level(0.25);
    TEST_ASSERT_TRUE(command.inlet_flux < BELT_REAL(0.75));
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_TRUE(controller.supervisor.manual_flux == BELT_REAL(0.75));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_manual_after_any_mode_begins_with_the_last_command);
    RUN_TEST(test_off_after_any_mode_feeds_nothing);
    RUN_TEST(test_automatic_after_manual_starts_from_its_flux_and_goes_over_to_the_law);
    RUN_TEST(test_a_bump_ends_exactly);
    RUN_TEST(test_hold_substitute_and_automatic_again_go_over_without_a_jump);
    RUN_TEST(test_one_good_sample_does_not_end_a_hold_and_one_bad_begins_it_anew);
    RUN_TEST(test_rate_limit_holds_at_every_step_of_any_walk_through_the_modes);
    RUN_TEST(test_manual_flux_that_moves_before_the_bump_has_gone_is_what_is_fed);
    RUN_TEST(test_manual_asked_for_again_keeps_its_flux);
    return UNITY_END();
}
