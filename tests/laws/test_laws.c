/* SPDX-License-Identifier: MIT */
/* What belt/line_laws.h asks of the laws, for whichever the build has. */
#include "belt/line_model.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

/* Places, levels and densities at which a law is looked at. */
#define LOOKS 1000

static belt_config_t config;
static belt_line_t line;

void setUp(void) {
    config = paper_case();
    config.rework_rate = BELT_REAL(0.8);
    belt_line_init(&line, &config);
}

void tearDown(void) {
}

typedef belt_real_t law_t(belt_real_t of);

static belt_real_t slowness(belt_real_t congestion) {
    return belt_line_slowness(&line, congestion);
}

static belt_real_t service(belt_real_t level) {
    return belt_line_service(&line, level);
}

/** From its value at 0 on a law never falls and nowhere rises steeper than `slope`, up to `last`. */
static void assert_rises(law_t *law, double at_0, double slope, double last) {
    double before = (double)law(BELT_REAL(0));
    double from = 0.0;
    TEST_ASSERT_DOUBLE_WITHIN(0.0, at_0, before);
    for (int i = 1; i <= LOOKS; ++i) {
        const belt_real_t at = BELT_REAL(last * i / LOOKS);
        const double rise = (double)law(at) - before;
        /* Four roundings in a value of the law. */
        const double rounding = 4.0 * EPSILON * (before + slope * (double)at);
        TEST_ASSERT_TRUE(rise >= -rounding);
        TEST_ASSERT_TRUE(rise <= slope * ((double)at - from) + rounding);
        before += rise;
        from = (double)at;
    }
}

static void test_slowness_rises_from_the_empty_lines_and_no_steeper_than_its_slope(void) {
    const double fullest = (double)config.speed_window * (double)config.level_capacity;
    static const double scales[] = {0.05, 1.0, 1e6};
    for (int i = 0; i < 3; ++i) {
        config.congestion_scale = BELT_REAL(scales[i]);
        belt_line_init(&line, &config);
        assert_rises(slowness, (double)line.slowness_empty, (double)line.slowness_slope, fullest);
        assert_rises(slowness, (double)line.slowness_empty, (double)line.slowness_slope,
                     100.0 * scales[i]);
    }
}

static void test_service_rises_from_0_no_steeper_than_its_rate_and_not_above_its_greatest(void) {
    static const double rates[] = {0.01, 0.8, 1e6};
    for (int i = 0; i < 3; ++i) {
        config.service_rate_max = BELT_REAL(rates[i]);
        belt_line_init(&line, &config);
        assert_rises(service, 0.0, (double)line.service_rate, (double)config.level_capacity);
        assert_rises(service, 0.0, (double)line.service_rate, 1e4);
        for (double level = 1e-6; level <= 1e6; level *= 10.0) {
            const belt_real_t served = service(BELT_REAL(level));
            TEST_ASSERT_TRUE(served > BELT_REAL(0));
            TEST_ASSERT_TRUE((double)served <= rates[i] * (1.0 + 2.0 * EPSILON));
        }
    }
}

static void test_density_returned_rises_from_0_and_no_steeper_than_1(void) {
    assert_rises(belt_law_returned, 0.0, 1.0, 1.0);
    assert_rises(belt_law_returned, 0.0, 1.0, (double)line.density_bound);
}

static void test_rework_lies_between_0_and_its_greatest_and_its_mean_is_at_most_half_of_that(void) {
    const double length = (double)config.belt_length;
    const double greatest = (double)config.rework_rate * length;
    double sum = 0.0;
    for (int i = 0; i <= LOOKS; ++i) {
        const belt_real_t x = BELT_REAL(length * i / LOOKS);
        const double rework = (double)belt_law_rework(x, config.belt_length, config.rework_rate);
        TEST_ASSERT_TRUE(rework >= 0.0);
        TEST_ASSERT_TRUE(rework <= greatest * (1.0 + 4.0 * EPSILON));
        sum += rework * (((i == 0) || (i == LOOKS)) ? 0.5 : 1.0);
    }
    /* The trapezoid rule over so many places: its square, and the roundings. */
    TEST_ASSERT_TRUE(sum / LOOKS <= 0.5 * greatest * (1.0 + 1.0 / LOOKS / LOOKS + 4.0 * EPSILON));
}

static void test_no_rework_rate_is_no_rework(void) {
    for (int i = 0; i <= LOOKS; ++i) {
        const belt_real_t x = config.belt_length * BELT_REAL(i) / BELT_REAL(LOOKS);
        TEST_ASSERT_TRUE(belt_law_rework(x, config.belt_length, BELT_REAL(0)) == BELT_REAL(0));
    }
}

static void test_flux_of_every_setpoint_that_the_rules_allow_stays_below_the_greatest(void) {
    for (int i = 10; i < 600; ++i) {
        config.level_setpoint = BELT_REAL(0.001 * i);
        TEST_ASSERT_EQUAL(BELT_OK, belt_config_check(&config, NULL));
        const belt_real_t flux = belt_config_setpoint_flux(&config);
        TEST_ASSERT_TRUE(flux > BELT_REAL(0));
        TEST_ASSERT_TRUE(flux < config.nominal_flux_max);
    }
}

/** Between its nodes the library's rework is linear: off by an eighth of the spacing's square times the
 * curvature, which is at most 6*A/D; on the nodes the law itself. */
static void test_rework_of_the_model_is_the_laws_up_to_the_square_of_a_spacing(void) {
    for (uint16_t nodes = 5; nodes <= 160; nodes = (uint16_t)(2 * nodes)) {
        config.node_count = nodes;
        belt_line_init(&line, &config);
        const double greatest = (double)config.rework_rate * (double)config.belt_length;
        const double bend = 6.0 / 8.0 / nodes / nodes;
        for (int i = 0; i <= 8 * (int)nodes; ++i) {
            const belt_real_t place = BELT_REAL(0.125 * i);
            const double law = (double)belt_law_rework(place * line.spacing, config.belt_length,
                                                       config.rework_rate);
            const double limit = (i % 8 == 0) ? 0.0 : bend;
            TEST_ASSERT_DOUBLE_WITHIN(greatest * (limit + 8.0 * EPSILON), law,
                                      (double)belt_line_rework(&line, place));
            TEST_ASSERT_DOUBLE_WITHIN(
                greatest * (limit + 8.0 * EPSILON), law,
                (double)belt_line_rework_beyond_inlet(&line, BELT_REAL(nodes) - place));
        }
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_slowness_rises_from_the_empty_lines_and_no_steeper_than_its_slope);
    RUN_TEST(test_service_rises_from_0_no_steeper_than_its_rate_and_not_above_its_greatest);
    RUN_TEST(test_density_returned_rises_from_0_and_no_steeper_than_1);
    RUN_TEST(test_rework_lies_between_0_and_its_greatest_and_its_mean_is_at_most_half_of_that);
    RUN_TEST(test_no_rework_rate_is_no_rework);
    RUN_TEST(test_flux_of_every_setpoint_that_the_rules_allow_stays_below_the_greatest);
    RUN_TEST(test_rework_of_the_model_is_the_laws_up_to_the_square_of_a_spacing);
    return UNITY_END();
}
