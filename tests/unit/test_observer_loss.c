/* SPDX-License-Identifier: MIT */
/* What is lost on the way. */
#include "observer_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- loss --- */

static void test_uniform_loss_is_exponential(void) {
    config.loss_rate[0] = BELT_REAL(1.5);
    const double travels[] = {1.0, 0.5, 0.3, 0.1};
    for (size_t i = 0; i < sizeof travels / sizeof travels[0]; ++i) {
        begin();
        const double truth = 0.8 * exp(-1.5 * 0.025 * 20.0);
        const double ways = 20.0 / travels[i] + 3.0;
        /* Four roundings a way, and 1/travel of those of the mean that leaves. */
        TEST_ASSERT_DOUBLE_WITHIN(series_error(1.5 * 0.025, ways) + 4 * EPSILON * ways, truth,
                                  leaving_after_filling(0.025, travels[i], 0.8));
    }
}

static void test_loss_does_not_depend_on_where_in_a_cell_the_outlet_is(void) {
    config.loss_rate[0] = BELT_REAL(1.5);
    begin();
    const double settled = leaving_after_filling(0.025, 0.1, 0.8);
    for (int i = 0; i < 37; ++i) {
        advance(0.37, 0.8);
        /* 200 ways of four roundings, and the series over the last spacing. */
        TEST_ASSERT_DOUBLE_WITHIN(series_error(1.5 * 0.025, 2.0) + 800 * EPSILON * 0.8, settled,
                                  left());
    }
}

static void test_cells_hold_the_density_of_their_centre(void) {
    config.loss_rate[0] = BELT_REAL(1.5);
    begin();
    (void)leaving_after_filling(0.025, 0.1, 0.8);
    for (int i = 0; i < 13; ++i) {
        advance(0.1, 0.8);
        for (uint32_t k = 1; k <= last_cell(); ++k) {
            const double truth = 0.8 * exp(-1.5 * 0.025 * (20.0 - centre(k)));
            TEST_ASSERT_DOUBLE_WITHIN(series_error(1.5 * 0.025, 20.0) + 800 * EPSILON, truth,
                                      cell(k));
        }
    }
}

static void test_loss_profile_is_the_exponential_of_its_integral(void) {
    /* C from 2 at the outlet to 0 at the inlet; on the whole way 1. */
    config.loss_count = 2;
    config.loss_rate[0] = BELT_REAL(2);
    config.loss_rate[1] = BELT_REAL(0);
    begin();
    (void)leaving_after_filling(0.025, 0.1, 0.8);
    for (uint32_t k = 1; k <= last_cell(); ++k) {
        const double to_inlet = (20.0 - centre(k)) / 20.0;
        const double truth = 0.8 * exp(-0.5 * to_inlet * to_inlet);
        /* The mean loss of a spacing stands for all of it: between nodes the exponent is off by up
         * to an eighth of the change, 2/20, of it, over one spacing's 0.025 s. */
        TEST_ASSERT_DOUBLE_WITHIN(0.8 * 0.125 * 0.1 * 0.025 + 800 * EPSILON, truth, cell(k));
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.8 * 0.125 * 0.1 * 0.025 + 800 * EPSILON, 0.8 * exp(-0.5), left());
}

static void test_profile_of_equal_values_is_the_uniform_loss_bit_for_bit(void) {
    static belt_observer_t uniform;
    uint64_t random = 3u;
    belt_real_t fed[400];
    for (size_t i = 0; i < 400; ++i) {
        fed[i] = random_share(&random);
    }
    config.rework_rate = BELT_REAL(0.1);
    for (int count = 1; count <= 3; count += 2) {
        config.loss_count = (uint16_t)count;
        for (int i = 0; i < count; ++i) {
            config.loss_rate[i] = BELT_REAL(0.9);
        }
        begin();
        for (size_t i = 0; i < 400; ++i) {
            advance(0.3, (double)fed[i]);
        }
        if (count == 1) {
            uniform = observer;
        }
    }
    for (size_t i = 0; i < line.cell_slots; ++i) {
        TEST_ASSERT_TRUE(uniform.density[i] == observer.density[i]);
    }
}

static void test_profile_of_nearly_equal_values_is_close_to_the_uniform_loss(void) {
    static belt_observer_t uniform;
    config.rework_rate = BELT_REAL(0.1);
    for (int count = 1; count <= 2; ++count) {
        config.loss_count = (uint16_t)count;
        config.loss_rate[0] = BELT_REAL(0.9);
        config.loss_rate[1] = real_next(config.loss_rate[0], BELT_REAL(1));
        begin();
        for (int i = 0; i < 400; ++i) {
            advance(0.3, 0.5 + 0.4 * sin(0.05 * i));
        }
        if (count == 1) {
            uniform = observer;
        }
    }
    TEST_ASSERT_FALSE(line.loss_is_uniform);
    for (size_t i = 0; i < line.cell_slots; ++i) {
        /* Two pieces a period instead of one: 0.9*0.025*0.3 of loss to the fourth power and 67
         * periods of four roundings. */
        TEST_ASSERT_DOUBLE_WITHIN(270 * EPSILON, (double)uniform.density[i],
                                  (double)observer.density[i]);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_uniform_loss_is_exponential);
    RUN_TEST(test_loss_does_not_depend_on_where_in_a_cell_the_outlet_is);
    RUN_TEST(test_cells_hold_the_density_of_their_centre);
    RUN_TEST(test_loss_profile_is_the_exponential_of_its_integral);
    RUN_TEST(test_profile_of_equal_values_is_the_uniform_loss_bit_for_bit);
    RUN_TEST(test_profile_of_nearly_equal_values_is_close_to_the_uniform_loss);
    return UNITY_END();
}
