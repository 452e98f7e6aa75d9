/* SPDX-License-Identifier: MIT */
#include "belt/supervisor.h"

#include "reals.h"
#include "unity.h"

/* Numbers are sums of powers of two: every command is exact. */
#define LAST BELT_REAL(0.5)
#define BUMP BELT_REAL(0.25)
#define LAW_FLUX BELT_REAL(1)
#define MANUAL_FLUX BELT_REAL(0.75)
#define SUBSTITUTE_FLUX BELT_REAL(0.125)

static belt_supervisor_t supervisor;
static belt_command_t command;
static belt_limits_t limits;

void setUp(void) {
    supervisor = (belt_supervisor_t){BELT_MODE_AUTOMATIC, MANUAL_FLUX, BUMP};
    command = (belt_command_t){LAST, BELT_MODE_AUTOMATIC, 0xA5u};
    limits = (belt_limits_t){.inlet_flux_max = BELT_REAL(2),
                             .flux_step_max = BELT_NO_FLUX_LIMIT,
                             .substitute_flux = SUBSTITUTE_FLUX,
                             .transfer_kept = BELT_REAL(0.5),
                             .bump_min = BELT_REAL(0.0009765625)};
}

void tearDown(void) {
}

static void decide(belt_event_t event, belt_real_t law_flux) {
    belt_supervisor_decide(&supervisor, &command, &limits, event, law_flux);
}

/* --- the table --- */

typedef struct {
    belt_mode_t from;
    belt_event_t event;
    belt_mode_t to;
    belt_transfer_kind_t transfer;
} row_t;

#define ROW(from, event, to, transfer)                                                             \
    {BELT_MODE_##from, BELT_EVENT_##event, BELT_MODE_##to, BELT_TRANSFER_##transfer},
static const row_t table[] = {BELT_TRANSITIONS(ROW)};
#define ROWS (sizeof table / sizeof table[0])

/* The same written down again, from what the modes mean. */
#define NONE BELT_TRANSFER_NONE
#define AT_ONCE BELT_TRANSFER_AT_ONCE
#define BUMPLESS BELT_TRANSFER_BUMPLESS
static const struct {
    belt_mode_t to;
    belt_transfer_kind_t
        transfer[BELT_MODE_COUNT]; /* from off, manual, automatic, hold, substitute */
} meant[BELT_EVENT_COUNT] = {
    [BELT_EVENT_OFF] = {BELT_MODE_OFF, {NONE, AT_ONCE, AT_ONCE, AT_ONCE, AT_ONCE}},
    [BELT_EVENT_MANUAL] = {BELT_MODE_MANUAL, {AT_ONCE, NONE, BUMPLESS, BUMPLESS, BUMPLESS}},
    [BELT_EVENT_TRUSTED] = {BELT_MODE_AUTOMATIC, {AT_ONCE, BUMPLESS, NONE, BUMPLESS, BUMPLESS}},
    [BELT_EVENT_DOUBTED] = {BELT_MODE_HOLD, {AT_ONCE, BUMPLESS, BUMPLESS, NONE, BUMPLESS}},
    [BELT_EVENT_LOST] = {BELT_MODE_SUBSTITUTE, {AT_ONCE, BUMPLESS, BUMPLESS, BUMPLESS, NONE}},
};

static void test_table_has_every_mode_and_event_once(void) {
    unsigned seen[BELT_MODE_COUNT][BELT_EVENT_COUNT] = {{0}};
    TEST_ASSERT_EQUAL_size_t(25u, ROWS);
    for (size_t i = 0; i < ROWS; ++i) {
        TEST_ASSERT_EQUAL_UINT(0u, seen[table[i].from][table[i].event]);
        seen[table[i].from][table[i].event] = 1u;
    }
}

static void test_table_says_what_the_modes_mean(void) {
    for (size_t i = 0; i < ROWS; ++i) {
        TEST_ASSERT_EQUAL(meant[table[i].event].to, table[i].to);
        TEST_ASSERT_EQUAL(meant[table[i].event].transfer[table[i].from], table[i].transfer);
    }
}

static void test_off_wins_from_every_mode_and_manual_works_whatever_the_level(void) {
    for (int mode = 0; mode < BELT_MODE_COUNT; ++mode) {
        command.mode = (belt_mode_t)mode;
        decide(BELT_EVENT_OFF, LAW_FLUX);
        TEST_ASSERT_EQUAL(BELT_MODE_OFF, command.mode);
        TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0) || mode == (int)BELT_MODE_OFF);
        command.mode = (belt_mode_t)mode;
        decide(BELT_EVENT_MANUAL, LAW_FLUX);
        TEST_ASSERT_EQUAL(BELT_MODE_MANUAL, command.mode);
    }
}

/** The flux of each mode of its own. */
static belt_real_t own(belt_mode_t mode) {
    const belt_real_t fluxes[BELT_MODE_COUNT] = {[BELT_MODE_OFF] = BELT_REAL(0),
                                                 [BELT_MODE_MANUAL] = MANUAL_FLUX,
                                                 [BELT_MODE_AUTOMATIC] = LAW_FLUX,
                                                 [BELT_MODE_HOLD] = LAW_FLUX,
                                                 [BELT_MODE_SUBSTITUTE] = SUBSTITUTE_FLUX};
    return fluxes[mode];
}

static void test_every_row_makes_its_mode_and_its_command(void) {
    for (size_t i = 0; i < ROWS; ++i) {
        const row_t row = table[i];
        setUp();
        command.mode = row.from;
        decide(row.event, LAW_FLUX);
        TEST_ASSERT_EQUAL(row.to, command.mode);
        const belt_real_t flux = own(row.to);
        const belt_real_t bumps[] = {[BELT_TRANSFER_NONE] = BELT_HALF * BUMP,
                                     [BELT_TRANSFER_AT_ONCE] = BELT_REAL(0),
                                     [BELT_TRANSFER_BUMPLESS] = LAST - flux};
        TEST_ASSERT_TRUE(supervisor.bump == bumps[row.transfer]);
        TEST_ASSERT_TRUE(command.inlet_flux == flux + bumps[row.transfer]);
    }
}

static void test_bumpless_change_leaves_the_command_and_one_that_touches_off_does_not(void) {
    for (size_t i = 0; i < ROWS; ++i) {
        const row_t row = table[i];
        setUp();
        command.mode = row.from;
        decide(row.event, LAW_FLUX);
        if (row.from != row.to) {
            const bool touches_off = (row.from == BELT_MODE_OFF) || (row.to == BELT_MODE_OFF);
            TEST_ASSERT_TRUE(command.inlet_flux == (touches_off ? own(row.to) : LAST));
        }
    }
}

static void test_deciding_leaves_errors_and_request_alone(void) {
    for (size_t i = 0; i < ROWS; ++i) {
        setUp();
        command.mode = table[i].from;
        decide(table[i].event, LAW_FLUX);
        TEST_ASSERT_EQUAL_HEX32(0xA5u, command.error_bits);
        TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, supervisor.requested);
        TEST_ASSERT_TRUE(supervisor.manual_flux == MANUAL_FLUX);
    }
}

/* --- what moves the modes --- */

static void test_automatic_is_asked_for_at_first(void) {
    memset(&supervisor, 0, sizeof supervisor);
    supervisor.bump = BUMP;
    supervisor.manual_flux = MANUAL_FLUX;
    belt_supervisor_init(&supervisor);
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, supervisor.requested);
    TEST_ASSERT_TRUE(supervisor.manual_flux == BELT_REAL(0));
    TEST_ASSERT_TRUE(supervisor.bump == BELT_REAL(0));
}

static belt_event_t event_of(belt_mode_t requested, int health) {
    supervisor.requested = requested;
    return belt_supervisor_event(&supervisor, (belt_level_health_t)health);
}

static void test_automatic_hangs_on_the_level(void) {
    TEST_ASSERT_EQUAL(BELT_EVENT_TRUSTED, event_of(BELT_MODE_AUTOMATIC, BELT_LEVEL_TRUSTED));
    TEST_ASSERT_EQUAL(BELT_EVENT_DOUBTED, event_of(BELT_MODE_AUTOMATIC, BELT_LEVEL_DOUBTED));
    TEST_ASSERT_EQUAL(BELT_EVENT_LOST, event_of(BELT_MODE_AUTOMATIC, BELT_LEVEL_LOST));
}

static void test_off_and_manual_do_not(void) {
    for (int health = (int)BELT_LEVEL_TRUSTED; health <= (int)BELT_LEVEL_LOST; ++health) {
        TEST_ASSERT_EQUAL(BELT_EVENT_OFF, event_of(BELT_MODE_OFF, health));
        TEST_ASSERT_EQUAL(BELT_EVENT_MANUAL, event_of(BELT_MODE_MANUAL, health));
    }
}

static void test_request_that_nobody_can_make_is_off(void) {
    TEST_ASSERT_EQUAL(BELT_EVENT_OFF, event_of(BELT_MODE_HOLD, BELT_LEVEL_TRUSTED));
    TEST_ASSERT_EQUAL(BELT_EVENT_OFF, event_of(BELT_MODE_SUBSTITUTE, BELT_LEVEL_TRUSTED));
}

static void test_health_that_does_not_exist_is_lost(void) {
    TEST_ASSERT_EQUAL(BELT_EVENT_LOST, event_of(BELT_MODE_AUTOMATIC, 77));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_table_has_every_mode_and_event_once);
    RUN_TEST(test_table_says_what_the_modes_mean);
    RUN_TEST(test_off_wins_from_every_mode_and_manual_works_whatever_the_level);
    RUN_TEST(test_every_row_makes_its_mode_and_its_command);
    RUN_TEST(test_bumpless_change_leaves_the_command_and_one_that_touches_off_does_not);
    RUN_TEST(test_deciding_leaves_errors_and_request_alone);
    RUN_TEST(test_automatic_is_asked_for_at_first);
    RUN_TEST(test_automatic_hangs_on_the_level);
    RUN_TEST(test_off_and_manual_do_not);
    RUN_TEST(test_request_that_nobody_can_make_is_off);
    RUN_TEST(test_health_that_does_not_exist_is_lost);
    return UNITY_END();
}
