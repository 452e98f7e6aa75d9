/* SPDX-License-Identifier: MIT */
/* What each fault makes of a signal that counts its periods: 0, 1, 2, ... with a period of 1 s. */
#include "channel.h"

#include <math.h>
#include <string.h>

#include "unity.h"

#define PERIODS 12

static channel_t channel;
static double delivered[PERIODS];
static bool is_present[PERIODS];
static bool is_garbage[PERIODS];
static uint32_t sample_count[PERIODS];

void setUp(void) {
    memset(&channel, 0, sizeof channel);
}

void tearDown(void) {
    channel_destroy(&channel);
}

static void create(const fault_t *faults, size_t count, size_t width) {
    const channel_setup_t setup = {faults, count, FAULT_ON_BUFFER_LEVEL, 1, 1.0};
    channel_destroy(&channel);
    TEST_ASSERT_TRUE(channel_create(&channel, &setup, width));
}

static void pass_all(void) {
    for (size_t index = 0; index < PERIODS; index++) {
        double value = (double)index;
        signal_t signal = {&value, true, false, (uint32_t)index};
        channel_pass(&channel, index, &signal);
        delivered[index] = value;
        is_present[index] = signal.is_present;
        is_garbage[index] = signal.is_garbage;
        sample_count[index] = signal.sample_count;
    }
}

/* A fault at work in the periods 4 ... 7. */
static void pass_under(fault_word_t word, double value) {
    const fault_t fault = {FAULT_ON_BUFFER_LEVEL, word, value, 4.0, 4.0};
    create(&fault, 1, 1);
    pass_all();
}

static void assert_delivered(const double expected[PERIODS]) {
    for (size_t index = 0; index < PERIODS; index++) {
        TEST_ASSERT_DOUBLE_WITHIN(1e-15, expected[index], delivered[index]);
    }
}

static void test_signal_without_fault_arrives_as_it_is(void) {
    create(NULL, 0, 1);
    pass_all();
    assert_delivered((const double[PERIODS]){0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
}

static void test_fault_of_another_signal_does_nothing(void) {
    const fault_t fault = {FAULT_ON_VALVE, FAULT_OFF, 0.0, 4.0, 4.0};
    create(&fault, 1, 1);
    TEST_ASSERT_EQUAL_UINT(0, channel.station_count);
}

static void test_off_signal_is_absent_from_its_start_up_to_its_end(void) {
    pass_under(FAULT_OFF, 0.0);
    for (size_t index = 0; index < PERIODS; index++) {
        TEST_ASSERT_EQUAL(index < 4 || index >= 8, is_present[index]);
    }
}

static void test_stuck_signal_keeps_value_and_sample_count(void) {
    pass_under(FAULT_STUCK, 0.0);
    assert_delivered((const double[PERIODS]){0, 1, 2, 3, 3, 3, 3, 3, 8, 9, 10, 11});
    TEST_ASSERT_EQUAL_UINT32(3, sample_count[7]);
    TEST_ASSERT_EQUAL_UINT32(8, sample_count[8]);
}

static void test_signal_stuck_from_the_start_keeps_its_first_value(void) {
    const fault_t fault = {FAULT_ON_BUFFER_LEVEL, FAULT_STUCK, 0.0, 0.0, 3.0};
    create(&fault, 1, 1);
    pass_all();
    assert_delivered((const double[PERIODS]){0, 0, 0, 3, 4, 5, 6, 7, 8, 9, 10, 11});
}

static void test_wrong_signal_is_scaled(void) {
    pass_under(FAULT_WRONG, -0.5);
    assert_delivered((const double[PERIODS]){0, 1, 2, 3, -2, -2.5, -3, -3.5, 8, 9, 10, 11});
}

/* A time constant of one period: the implicit step goes half the way. */
static void test_slow_signal_lags_behind_from_the_last_value(void) {
    pass_under(FAULT_SLOW, 1.0);
    assert_delivered((const double[PERIODS]){0, 1, 2, 3, 3.5, 4.25, 5.125, 6.0625, 8, 9, 10, 11});
}

/* It stands until the delay has passed, and nothing comes twice in the wrong order. */
static void test_delayed_signal_stands_and_then_comes_late(void) {
    pass_under(FAULT_DELAYED, 2.0);
    assert_delivered((const double[PERIODS]){0, 1, 2, 3, 3, 3, 4, 5, 8, 9, 10, 11});
    TEST_ASSERT_EQUAL_UINT32(3, sample_count[5]);
    TEST_ASSERT_EQUAL_UINT32(4, sample_count[6]);
}

static void test_part_of_a_period_of_delay_is_a_period(void) {
    pass_under(FAULT_DELAYED, 0.25);
    assert_delivered((const double[PERIODS]){0, 1, 2, 3, 3, 4, 5, 6, 8, 9, 10, 11});
}

static void test_garbage_is_other_bits_in_every_number(void) {
    const fault_t fault = {FAULT_ON_BUFFER_LEVEL, FAULT_GARBAGE, 0.0, 1.0, 1.0};
    double values[3] = {1.0, 1.0, 1.0};
    signal_t signal = {values, true, false, 1};
    create(&fault, 1, 3);
    channel_pass(&channel, 1, &signal);
    TEST_ASSERT_TRUE(signal.is_garbage);
    /* stream 1 of seed 1, see test_chance.c */
    const uint64_t first = UINT64_C(0x22E65890AAED82DC);
    const uint64_t second = UINT64_C(0x89B053BE299BD377);
    TEST_ASSERT_EQUAL_MEMORY(&first, &values[0], sizeof first);
    TEST_ASSERT_EQUAL_MEMORY(&second, &values[1], sizeof second);
}

static void test_garbage_lasts_as_long_as_its_fault(void) {
    pass_under(FAULT_GARBAGE, 0.0);
    for (size_t index = 0; index < PERIODS; index++) {
        TEST_ASSERT_EQUAL(index >= 4 && index < 8, is_garbage[index]);
    }
}

static void test_intermittent_signal_loses_its_share(void) {
    enum { MANY = 10000 };
    const fault_t fault = {FAULT_ON_BUFFER_LEVEL, FAULT_INTERMITTENT, 0.3, 0.0, MANY};
    int lost = 0;
    create(&fault, 1, 1);
    for (size_t index = 0; index < MANY; index++) {
        double value = 1.0;
        signal_t signal = {&value, true, false, 0};
        channel_pass(&channel, index, &signal);
        lost += signal.is_present ? 0 : 1;
    }
    /* four standard deviations: 4*sqrt(0.3*0.7/10000) */
    TEST_ASSERT_DOUBLE_WITHIN(0.0184, 0.3, (double)lost / MANY);
}

static void test_signal_that_always_gets_lost_never_arrives(void) {
    pass_under(FAULT_INTERMITTENT, 1.0);
    for (size_t index = 4; index < 8; index++) {
        TEST_ASSERT_FALSE(is_present[index]);
    }
}

static void test_faults_of_one_signal_follow_each_other_in_order(void) {
    const fault_t faults[] = {
        {FAULT_ON_BUFFER_LEVEL, FAULT_WRONG, 2.0, 0.0, 100.0},
        {FAULT_ON_BUFFER_LEVEL, FAULT_STUCK, 0.0, 4.0, 4.0},
    };
    create(faults, 2, 1);
    pass_all();
    assert_delivered((const double[PERIODS]){0, 2, 4, 6, 6, 6, 6, 6, 16, 18, 20, 22});
}

static void test_settled_channel_remembers_nothing_else(void) {
    const fault_t faults[] = {{FAULT_ON_BUFFER_LEVEL, FAULT_DELAYED, 2.0, 0.0, 100.0}};
    double zero = 0.0;
    const signal_t closed = {&zero, true, false, 0};
    create(faults, 1, 1);
    pass_all();
    channel_settle(&channel, &closed);
    pass_all();
    assert_delivered((const double[PERIODS]){0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_signal_without_fault_arrives_as_it_is);
    RUN_TEST(test_fault_of_another_signal_does_nothing);
    RUN_TEST(test_off_signal_is_absent_from_its_start_up_to_its_end);
    RUN_TEST(test_stuck_signal_keeps_value_and_sample_count);
    RUN_TEST(test_signal_stuck_from_the_start_keeps_its_first_value);
    RUN_TEST(test_wrong_signal_is_scaled);
    RUN_TEST(test_slow_signal_lags_behind_from_the_last_value);
    RUN_TEST(test_delayed_signal_stands_and_then_comes_late);
    RUN_TEST(test_part_of_a_period_of_delay_is_a_period);
    RUN_TEST(test_garbage_is_other_bits_in_every_number);
    RUN_TEST(test_garbage_lasts_as_long_as_its_fault);
    RUN_TEST(test_intermittent_signal_loses_its_share);
    RUN_TEST(test_signal_that_always_gets_lost_never_arrives);
    RUN_TEST(test_faults_of_one_signal_follow_each_other_in_order);
    RUN_TEST(test_settled_channel_remembers_nothing_else);
    return UNITY_END();
}
