/* SPDX-License-Identifier: MIT */
/* How the command goes over and what bounds it, whatever the mode. */
#include "belt/supervisor.h"

#include <math.h>

#include "reals.h"
#include "unity.h"

#define FLUX_MAX BELT_REAL(2)

static belt_supervisor_t supervisor;
static belt_command_t command;
static belt_limits_t limits;

void setUp(void) {
    supervisor = (belt_supervisor_t){BELT_MODE_AUTOMATIC, BELT_REAL(0.75), BELT_REAL(0)};
    command = (belt_command_t){BELT_REAL(0.5), BELT_MODE_AUTOMATIC, 0u};
    limits = (belt_limits_t){.inlet_flux_max = FLUX_MAX,
                             .flux_step_max = BELT_NO_FLUX_LIMIT,
                             .substitute_flux = BELT_REAL(0.125),
                             .transfer_kept = BELT_REAL(0.5),
                             .bump_min = BELT_REAL(0.0009765625)};
}

void tearDown(void) {
}

static double decide(belt_event_t event, double law_flux) {
    belt_supervisor_decide(&supervisor, &command, &limits, event, BELT_REAL(law_flux));
    return (double)command.inlet_flux;
}

/* --- the bump --- */

static void test_bump_halves_from_period_to_period(void) {
    /* From the law's 0.5 to a manual flux of 0.75: a quarter below it, then an eighth ... */
    TEST_ASSERT_EQUAL_DOUBLE(0.5, decide(BELT_EVENT_MANUAL, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.75 - 0.125, decide(BELT_EVENT_MANUAL, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.75 - 0.0625, decide(BELT_EVENT_MANUAL, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.75 - 0.03125, decide(BELT_EVENT_MANUAL, 0.5));
}

static void test_own_flux_of_the_mode_is_followed_while_the_bump_fades(void) {
    (void)decide(BELT_EVENT_MANUAL, 0.5);
    supervisor.manual_flux = BELT_REAL(1);
    TEST_ASSERT_EQUAL_DOUBLE(1.0 - 0.125, decide(BELT_EVENT_MANUAL, 0.5));
}

static void test_bump_that_nobody_sees_ends(void) {
    const belt_real_t least = limits.bump_min;
    const struct {
        belt_real_t bump;
        belt_real_t left;
    } cases[] = {
        {least, BELT_REAL(0)},
        {-least, BELT_REAL(0)},
        {real_next(least, BELT_REAL(1)), BELT_HALF * real_next(least, BELT_REAL(1))},
        {real_next(-least, BELT_REAL(-1)), BELT_HALF * real_next(-least, BELT_REAL(-1))},
        {BELT_REAL(0), BELT_REAL(0)},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        supervisor.bump = cases[i].bump;
        (void)decide(BELT_EVENT_TRUSTED, 0.5);
        TEST_ASSERT_TRUE(supervisor.bump == cases[i].left);
    }
}

static void test_command_is_the_modes_own_in_the_end(void) {
    (void)decide(BELT_EVENT_LOST, 0.5);
    for (int i = 0; i < 9; ++i) { /* 0.375 halved nine times is below 2^-10 */
        TEST_ASSERT_TRUE(decide(BELT_EVENT_LOST, 0.5) > 0.125);
    }
    TEST_ASSERT_EQUAL_DOUBLE(0.125, decide(BELT_EVENT_LOST, 0.5));
}

static void test_bump_that_is_no_number_is_forgotten(void) {
    supervisor.bump = BELT_REAL(NAN);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, decide(BELT_EVENT_TRUSTED, 1.0));
    TEST_ASSERT_TRUE(supervisor.bump == BELT_REAL(0));
}

static void test_change_back_while_a_bump_fades_does_not_jump_either(void) {
    (void)decide(BELT_EVENT_MANUAL, 0.5);
    TEST_ASSERT_EQUAL_DOUBLE(0.625, decide(BELT_EVENT_MANUAL, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.625, decide(BELT_EVENT_TRUSTED, 1.5));
    TEST_ASSERT_EQUAL_DOUBLE(1.5 - 0.4375, decide(BELT_EVENT_TRUSTED, 1.5));
}

static void test_off_forgets_the_bump(void) {
    (void)decide(BELT_EVENT_MANUAL, 0.5);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, decide(BELT_EVENT_OFF, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, decide(BELT_EVENT_OFF, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.75, decide(BELT_EVENT_MANUAL, 0.5));
}

static void test_bump_is_that_of_the_limited_flux(void) {
    /* The law asks for 5 of which 2 can be had; what can not be had is nothing to fade out. */
    TEST_ASSERT_EQUAL_DOUBLE(0.5, decide(BELT_EVENT_DOUBTED, 5.0));
    TEST_ASSERT_EQUAL_DOUBLE(-1.5, (double)supervisor.bump);
    TEST_ASSERT_EQUAL_DOUBLE(1.25, decide(BELT_EVENT_DOUBTED, 5.0));
}

/* --- limits --- */

static void test_law_beyond_the_limits_is_limited(void) {
    TEST_ASSERT_EQUAL_DOUBLE(2.0, decide(BELT_EVENT_TRUSTED, 5.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, decide(BELT_EVENT_TRUSTED, -5.0));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, decide(BELT_EVENT_TRUSTED, (double)INFINITY));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, decide(BELT_EVENT_TRUSTED, (double)NAN));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, decide(BELT_EVENT_TRUSTED, (double)-INFINITY));
}

static void test_bump_does_not_lift_the_command_above_its_limit(void) {
    supervisor.bump = BELT_REAL(1.5); /* half of it is left */
    TEST_ASSERT_EQUAL_DOUBLE(2.0, decide(BELT_EVENT_TRUSTED, 1.75));
    supervisor.bump = BELT_REAL(-1.5);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, decide(BELT_EVENT_TRUSTED, 0.25));
}

static void test_actuator_without_a_limit_may_be_asked_for_anything(void) {
    limits.inlet_flux_max = BELT_NO_FLUX_LIMIT;
    belt_supervisor_decide(&supervisor, &command, &limits, BELT_EVENT_TRUSTED, BELT_REAL_MAX);
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL_MAX);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, decide(BELT_EVENT_TRUSTED, 0.5));
}

/* --- the rate limit --- */

static void test_rate_limit_holds_up_and_down(void) {
    limits.flux_step_max = BELT_REAL(0.125);
    TEST_ASSERT_EQUAL_DOUBLE(0.625, decide(BELT_EVENT_TRUSTED, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.75, decide(BELT_EVENT_TRUSTED, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.625, decide(BELT_EVENT_TRUSTED, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, decide(BELT_EVENT_TRUSTED, 0.0));
}

static void test_step_of_the_rate_limit_itself_is_made(void) {
    limits.flux_step_max = BELT_REAL(0.125);
    TEST_ASSERT_EQUAL_DOUBLE(0.625, decide(BELT_EVENT_TRUSTED, 0.625));
    TEST_ASSERT_EQUAL_DOUBLE(0.5, decide(BELT_EVENT_TRUSTED, 0.5));
    TEST_ASSERT_EQUAL_DOUBLE(0.5625, decide(BELT_EVENT_TRUSTED, 0.5625));
}

static void test_rate_limit_holds_in_every_mode(void) {
    for (int mode = 0; mode < BELT_MODE_COUNT; ++mode) {
        for (int event = 0; event < BELT_EVENT_COUNT; ++event) {
            setUp();
            limits.flux_step_max = BELT_REAL(0.0625);
            supervisor.bump = BELT_REAL(0.25);
            command.mode = (belt_mode_t)mode;
            const double flux = decide((belt_event_t)event, 1.5);
            TEST_ASSERT_TRUE((flux >= 0.4375) && (flux <= 0.5625));
        }
    }
}

static void test_line_is_closed_at_the_rate_limit_too(void) {
    limits.flux_step_max = BELT_REAL(0.1875);
    TEST_ASSERT_EQUAL_DOUBLE(0.3125, decide(BELT_EVENT_OFF, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.125, decide(BELT_EVENT_OFF, 1.0));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, decide(BELT_EVENT_OFF, 1.0));
    TEST_ASSERT_EQUAL(BELT_MODE_OFF, command.mode);
}

/* --- walks --- */

static void test_no_walk_leaves_the_limits_or_jumps(void) {
    uint64_t random = 20261122u;
    belt_mode_t last_mode = command.mode;
    limits.flux_step_max = BELT_REAL(0.5);
    for (int i = 0; i < 100000; ++i) {
        const belt_event_t event = (belt_event_t)(random_bits(&random) % BELT_EVENT_COUNT);
        const double last = (double)command.inlet_flux;
        supervisor.manual_flux = FLUX_MAX * random_share(&random);
        const double flux = decide(event, 4.0 * (double)random_share(&random) - 1.0);
        TEST_ASSERT_TRUE((flux >= 0.0) && (flux <= 2.0));
        TEST_ASSERT_TRUE(fabs(flux - last) <= 0.5 + EPSILON); /* a rounding of a sum up to 2 */
        const bool touches_off = (command.mode == BELT_MODE_OFF) || (last_mode == BELT_MODE_OFF);
        if ((command.mode != last_mode) && !touches_off) {
            /* Less and again plus the mode's own flux: two roundings of a number up to 2. */
            TEST_ASSERT_DOUBLE_WITHIN(2 * EPSILON, last, flux);
        }
        last_mode = command.mode;
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_bump_halves_from_period_to_period);
    RUN_TEST(test_own_flux_of_the_mode_is_followed_while_the_bump_fades);
    RUN_TEST(test_bump_that_nobody_sees_ends);
    RUN_TEST(test_command_is_the_modes_own_in_the_end);
    RUN_TEST(test_bump_that_is_no_number_is_forgotten);
    RUN_TEST(test_change_back_while_a_bump_fades_does_not_jump_either);
    RUN_TEST(test_off_forgets_the_bump);
    RUN_TEST(test_bump_is_that_of_the_limited_flux);
    RUN_TEST(test_law_beyond_the_limits_is_limited);
    RUN_TEST(test_bump_does_not_lift_the_command_above_its_limit);
    RUN_TEST(test_actuator_without_a_limit_may_be_asked_for_anything);
    RUN_TEST(test_rate_limit_holds_up_and_down);
    RUN_TEST(test_step_of_the_rate_limit_itself_is_made);
    RUN_TEST(test_rate_limit_holds_in_every_mode);
    RUN_TEST(test_line_is_closed_at_the_rate_limit_too);
    RUN_TEST(test_no_walk_leaves_the_limits_or_jumps);
    return UNITY_END();
}
