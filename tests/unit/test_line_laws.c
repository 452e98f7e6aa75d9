/* SPDX-License-Identifier: MIT */
/* The laws that the library has of its own: the paper's. tests/laws holds any laws to their contract. */
#include "belt/line_laws.h"

#include "unity.h"

void setUp(void) {
}

void tearDown(void) {
}

static void test_slowness_grows_evenly_with_the_congestion(void) {
    TEST_ASSERT_TRUE(belt_law_slowness(BELT_REAL(0), BELT_REAL(0.25), BELT_REAL(0.5)) ==
                     BELT_REAL(0.25));
    TEST_ASSERT_TRUE(belt_law_slowness(BELT_REAL(0.5), BELT_REAL(0.25), BELT_REAL(0.5)) ==
                     BELT_REAL(0.5));
}

static void test_service_grows_with_the_level_up_to_its_rate(void) {
    TEST_ASSERT_TRUE(belt_law_service(BELT_REAL(0), BELT_REAL(2), BELT_REAL(0.75)) == BELT_REAL(0));
    TEST_ASSERT_TRUE(belt_law_service(BELT_REAL(0.25), BELT_REAL(2), BELT_REAL(0.75)) ==
                     BELT_REAL(0.5));
    TEST_ASSERT_TRUE(belt_law_service(BELT_REAL(0.5), BELT_REAL(2), BELT_REAL(0.75)) ==
                     BELT_REAL(0.75));
}

static void test_rework_falls_from_the_outlet_to_nothing_at_the_inlet(void) {
    TEST_ASSERT_TRUE(belt_law_rework(BELT_REAL(0), BELT_REAL(2), BELT_REAL(0.125)) ==
                     BELT_REAL(0.25));
    TEST_ASSERT_TRUE(belt_law_rework(BELT_REAL(1.5), BELT_REAL(2), BELT_REAL(0.125)) ==
                     BELT_REAL(0.0625));
    TEST_ASSERT_TRUE(belt_law_rework(BELT_REAL(2), BELT_REAL(2), BELT_REAL(0.125)) == BELT_REAL(0));
}

static void test_all_that_leaves_takes_part_in_the_rework(void) {
    TEST_ASSERT_TRUE(belt_law_returned(BELT_REAL(0)) == BELT_REAL(0));
    TEST_ASSERT_TRUE(belt_law_returned(BELT_REAL(0.375)) == BELT_REAL(0.375));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_slowness_grows_evenly_with_the_congestion);
    RUN_TEST(test_service_grows_with_the_level_up_to_its_rate);
    RUN_TEST(test_rework_falls_from_the_outlet_to_nothing_at_the_inlet);
    RUN_TEST(test_all_that_leaves_takes_part_in_the_rework);
    return UNITY_END();
}
