/* SPDX-License-Identifier: MIT */
#include "belt/types.h"

#include <string.h>

#include "unity.h"

void setUp(void) {
}

void tearDown(void) {
}

#define LAST_STATUS BELT_INPUT_REJECTED

static void test_every_status_has_a_name_of_its_own(void) {
    for (int one = (int)BELT_OK; one <= (int)LAST_STATUS; ++one) {
        for (int other = (int)BELT_OK; other < one; ++other) {
            TEST_ASSERT_TRUE(strcmp(belt_status_name((belt_status_t)one),
                                    belt_status_name((belt_status_t)other)) != 0);
        }
    }
}

static void test_no_status_is_called_unknown(void) {
    const char *unknown = belt_status_name((belt_status_t)((int)LAST_STATUS + 1));
    for (int code = (int)BELT_OK; code <= (int)LAST_STATUS; ++code) {
        TEST_ASSERT_TRUE(strcmp(belt_status_name((belt_status_t)code), unknown) != 0);
    }
}

static void test_number_that_is_no_status_has_a_name_too(void) {
    TEST_ASSERT_EQUAL_STRING("BELT_UNKNOWN_STATUS",
                             belt_status_name((belt_status_t)((int)LAST_STATUS + 1)));
    TEST_ASSERT_EQUAL_STRING("BELT_UNKNOWN_STATUS", belt_status_name((belt_status_t)1000000));
}

#define ASSERT_NAMED_AS_WRITTEN(code) TEST_ASSERT_EQUAL_STRING(#code, belt_status_name(code))

static void test_names_are_those_of_the_header(void) {
    ASSERT_NAMED_AS_WRITTEN(BELT_OK);
    ASSERT_NAMED_AS_WRITTEN(BELT_BELT_LENGTH);
    ASSERT_NAMED_AS_WRITTEN(BELT_PROCESSING_TIME);
    ASSERT_NAMED_AS_WRITTEN(BELT_SPEED_WINDOW);
    ASSERT_NAMED_AS_WRITTEN(BELT_CONGESTION_SCALE);
    ASSERT_NAMED_AS_WRITTEN(BELT_CONNECTIVITY);
    ASSERT_NAMED_AS_WRITTEN(BELT_SERVICE_RATE_MAX);
    ASSERT_NAMED_AS_WRITTEN(BELT_SERVICE_TIME);
    ASSERT_NAMED_AS_WRITTEN(BELT_LEVEL_CAPACITY);
    ASSERT_NAMED_AS_WRITTEN(BELT_REWORK_RATE);
    ASSERT_NAMED_AS_WRITTEN(BELT_LOSS_COUNT);
    ASSERT_NAMED_AS_WRITTEN(BELT_LOSS_RATE);
    ASSERT_NAMED_AS_WRITTEN(BELT_NODE_COUNT);
    ASSERT_NAMED_AS_WRITTEN(BELT_PERIOD);
    ASSERT_NAMED_AS_WRITTEN(BELT_PERIOD_PER_NODE);
    ASSERT_NAMED_AS_WRITTEN(BELT_WINDOW_SHORT);
    ASSERT_NAMED_AS_WRITTEN(BELT_WINDOW_LONG);
    ASSERT_NAMED_AS_WRITTEN(BELT_DEAD_TIME);
    ASSERT_NAMED_AS_WRITTEN(BELT_LOSS_EXPONENT);
    ASSERT_NAMED_AS_WRITTEN(BELT_LOSS_PER_NODE);
    ASSERT_NAMED_AS_WRITTEN(BELT_REWORK_PER_NODE);
    ASSERT_NAMED_AS_WRITTEN(BELT_REWORK_GAIN);
    ASSERT_NAMED_AS_WRITTEN(BELT_SERVICE_PER_NODE);
    ASSERT_NAMED_AS_WRITTEN(BELT_CONGESTION_PER_NODE);
    ASSERT_NAMED_AS_WRITTEN(BELT_NOMINAL_FLUX_MAX);
    ASSERT_NAMED_AS_WRITTEN(BELT_LEVEL_SETPOINT);
    ASSERT_NAMED_AS_WRITTEN(BELT_SLOPE_KIND);
    ASSERT_NAMED_AS_WRITTEN(BELT_SETPOINT_SLOPE);
    ASSERT_NAMED_AS_WRITTEN(BELT_PERIOD_PER_SLOPE);
    ASSERT_NAMED_AS_WRITTEN(BELT_INLET_FLUX_MAX);
    ASSERT_NAMED_AS_WRITTEN(BELT_PREDICTION_KIND);
    ASSERT_NAMED_AS_WRITTEN(BELT_MISUSE);
    ASSERT_NAMED_AS_WRITTEN(BELT_NO_LEVEL);
    ASSERT_NAMED_AS_WRITTEN(BELT_INPUT_REJECTED);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_every_status_has_a_name_of_its_own);
    RUN_TEST(test_no_status_is_called_unknown);
    RUN_TEST(test_number_that_is_no_status_has_a_name_too);
    RUN_TEST(test_names_are_those_of_the_header);
    return UNITY_END();
}
