/* SPDX-License-Identifier: MIT */
/* Whatever a controller accepts, line and belt, the march ends with times that make sense. */
#include "belt/belt.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

#include <string.h>

/* Lines that are tried, and steps of each. */
#define LINES 400
#define STEPS 6u
#define NODES_MAX 40u
#define PROFILE_MAX 8u

#define DENSITY_BITS (BELT_ERROR_DENSITY_INVALID | BELT_ERROR_DENSITY_RANGE)

static belt_config_t config;
static belt_controller_t controller;
static belt_measurement_t measurement;
static belt_command_t command;
static belt_real_t density[NODES_MAX + 1u];
static uint64_t seed;

void setUp(void) {
    TEST_ASSERT_TRUE_MESSAGE(BELT_NODE_CAPACITY >= NODES_MAX, "build with a preset");
    TEST_ASSERT_TRUE_MESSAGE(BELT_LOSS_CAPACITY >= PROFILE_MAX, "build with a preset");
    seed = 20240607u;
}

void tearDown(void) {
}

static double share(void) {
    return (double)random_share(&seed);
}

/** Between two limits, every order of magnitude as likely. */
static double spread(double from, double to) {
    return from * pow(to / from, share());
}

static bool one_in(uint32_t count) {
    return random_bits(&seed) % count == 0u;
}

/* --- a line that may be accepted --- */

static void draw_belt(void) {
    config.belt_length = BELT_REAL(spread(1.0, 10.0));
    config.processing_time = BELT_REAL(spread(0.1, 1.0));
    const double transit = (double)config.belt_length * (double)config.processing_time;
    config.speed_window = BELT_REAL(spread(0.05, 2.0) * transit);
    config.congestion_scale = BELT_REAL(spread(0.2, 20.0) * (double)config.speed_window);
    config.node_count = (uint16_t)(4u + random_bits(&seed) % (NODES_MAX - 3u));
    config.period = BELT_REAL(transit / config.node_count * spread(0.05, 1.0));
    const double gain = one_in(2u) ? 0.0 : share();
    config.rework_rate = BELT_REAL(gain / transit / (double)config.belt_length);
}

static void draw_buffer_and_law(void) {
    const double transit = (double)config.belt_length * (double)config.processing_time;
    config.connectivity = BELT_REAL(spread(0.1, 1.0));
    config.service_time = BELT_REAL(spread(0.5, 20.0) * transit);
    config.level_capacity = BELT_REAL(spread(0.1, 10.0));
    const double fullest = (double)config.level_capacity / (double)config.service_time;
    const double served = spread(0.3, 1.0) * fullest;
    config.service_rate_max = BELT_REAL(served);
    config.nominal_flux_max = BELT_REAL(0.98 * served / (double)config.connectivity);
    config.level_setpoint =
        BELT_REAL(spread(0.05, 0.95) * 0.98 * served * (double)config.service_time);
    config.slope = BELT_REAL(spread(0.1, 5.0) / transit);
    config.prediction = one_in(8u) ? BELT_HOLD_CONGESTION : BELT_PREDICT_CONGESTION;
}

/** None, one rate, or a profile; what grows by itself too. Up to what the spacing at its slowest allows. */
static void draw_loss(uint16_t count) {
    const double most = 0.25 * config.node_count / (double)belt_config_dead_time_max(&config);
    config.loss_count = count;
    for (uint32_t i = 0; i < count; ++i) {
        const double rate = one_in(4u) ? 0.0 : share() * most;
        config.loss_rate[i] = BELT_REAL(one_in(6u) ? -0.2 * rate : rate);
    }
}

static bool draw_line(uint16_t loss_count) {
    memset(&config, 0, sizeof config);
    config.slope_kind = BELT_SLOPE_MARGIN;
    config.inlet_flux_max = BELT_NO_FLUX_LIMIT;
    draw_belt();
    draw_buffer_and_law();
    draw_loss(loss_count);
    return belt_init(&controller, &config) == BELT_OK;
}

/* --- its belt, and what the march makes of it --- */

static void draw_measurement(void) {
    const double bound = (double)controller.model.line.density_bound;
    for (uint32_t i = 0; i <= config.node_count; ++i) {
        const double most = one_in(3u) ? bound : spread(1e-6, 1.0) * bound;
        density[i] = BELT_REAL(one_in(3u) ? 0.0 : share() * most);
    }
    if (one_in(4u)) {
        density[random_bits(&seed) % (config.node_count + 1u)] =
            controller.model.line.density_bound;
    }
    memset(&measurement, 0, sizeof measurement);
    measurement.present = one_in(3u) ? BELT_HAS_LEVEL : (BELT_HAS_LEVEL | BELT_HAS_DENSITY);
    measurement.level = BELT_REAL(share() * (double)config.level_capacity);
    measurement.density = density;
    measurement.elapsed_ticks = 1u;
}

static void assert_times_make_sense(const belt_prediction_t *prediction) {
    TEST_ASSERT_TRUE(prediction->inlet.count > 0u);
    TEST_ASSERT_TRUE(prediction->arrival[0] == BELT_REAL(0));
    for (uint32_t i = 0; i < prediction->inlet.count; ++i) {
        TEST_ASSERT_TRUE(isfinite((double)prediction->pace[i]));
        TEST_ASSERT_TRUE(prediction->pace[i] > BELT_REAL(0));
        TEST_ASSERT_TRUE(isfinite((double)prediction->arrival[i + 1u]));
        TEST_ASSERT_TRUE(prediction->arrival[i + 1u] >= prediction->arrival[i]);
    }
    TEST_ASSERT_TRUE(prediction->inlet.pace > BELT_REAL(0));
    TEST_ASSERT_TRUE(isfinite((double)prediction->inlet.arrival));
}

static void try_line(void) {
    for (uint32_t i = 0; i < STEPS; ++i) {
        draw_measurement();
        (void)belt_step(&controller, &measurement, &command);
        TEST_ASSERT_EQUAL(0,
                          command.error_bits & DENSITY_BITS); /* or it would not be on the belt */
        assert_times_make_sense(&controller.prediction);
        TEST_ASSERT_TRUE(isfinite((double)command.inlet_flux));
        TEST_ASSERT_TRUE(command.inlet_flux >= BELT_REAL(0));
    }
}

/** Of the lines drawn many are refused; those accepted must be enough to speak of. */
static void try_lines(uint16_t loss_count) {
    unsigned accepted = 0;
    for (unsigned i = 0; i < LINES; ++i) {
        if (draw_line(loss_count)) {
            ++accepted;
            try_line();
        }
    }
    TEST_ASSERT_TRUE(accepted >= LINES / 10u);
}

static void test_times_make_sense_on_lines_with_one_loss_rate(void) {
    try_lines(1u);
}

static void test_times_make_sense_on_lines_with_a_loss_profile(void) {
    try_lines(2u);
    try_lines(3u);
    try_lines(PROFILE_MAX);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_times_make_sense_on_lines_with_one_loss_rate);
    RUN_TEST(test_times_make_sense_on_lines_with_a_loss_profile);
    return UNITY_END();
}
