/* SPDX-License-Identifier: MIT */
#include "belt/belt.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_controller_t controller;
static belt_measurement_t measurement;
static belt_command_t command;

void setUp(void) {
    config = paper_case();
    memset(&controller, 0, sizeof controller);
    memset(&command, 0xA5, sizeof command);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    measurement = (belt_measurement_t){.present = BELT_HAS_LEVEL};
}

void tearDown(void) {
}

static belt_status_t step_level(double level) {
    measurement.level = BELT_REAL(level);
    return belt_step(&controller, &measurement, &command);
}

static void assert_nothing_is_fed(void) {
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0));
    TEST_ASSERT_EQUAL(BELT_MODE_OFF, command.mode);
}

/* --- misuse --- */

static void test_null_pointers_are_misuse(void) {
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_init(NULL, &config));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_init(&controller, NULL));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_step(&controller, &measurement, NULL));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_setpoint(NULL, BELT_REAL(0.3)));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_step(NULL, &measurement, &command));
    assert_nothing_is_fed();
    memset(&command, 0xA5, sizeof command);
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_step(&controller, NULL, &command));
    assert_nothing_is_fed();
    TEST_ASSERT_EQUAL_HEX32(0u, command.error_bits);
}

static void test_step_before_init_feeds_nothing(void) {
    const int memories[] = {0x00, 0xFF, 0xA5};
    for (size_t i = 0; i < sizeof memories / sizeof memories[0]; ++i) {
        memset(&controller, memories[i], sizeof controller);
        memset(&command, 0xA5, sizeof command);
        TEST_ASSERT_EQUAL(BELT_MISUSE, step_level(0.1));
        assert_nothing_is_fed();
        TEST_ASSERT_EQUAL(BELT_MISUSE, belt_set_setpoint(&controller, BELT_REAL(0.3)));
    }
}

static void test_step_after_a_refused_init_is_misuse(void) {
    memset(&controller, 0, sizeof controller);
    config.period = BELT_REAL(-1);
    TEST_ASSERT_EQUAL(BELT_PERIOD, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_MISUSE, step_level(0.1));
}

static void test_refused_second_init_leaves_the_controller_running(void) {
    (void)step_level(0.1);
    config.period = BELT_REAL(-1);
    TEST_ASSERT_EQUAL(BELT_PERIOD, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.1));
}

static void test_second_init_starts_anew(void) {
    static belt_controller_t fresh;
    for (int i = 0; i < 50; ++i) {
        (void)step_level(0.01 * i);
    }
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&fresh, &config));
    TEST_ASSERT_TRUE(memcmp(&controller, &fresh, sizeof fresh) == 0);
}

/* --- the first levels --- */

static void test_without_any_level_nothing_is_fed(void) {
    measurement.present = 0u;
    TEST_ASSERT_EQUAL(BELT_NO_LEVEL, belt_step(&controller, &measurement, &command));
    assert_nothing_is_fed();
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_MISSING, command.error_bits);
    measurement.present = BELT_HAS_LEVEL;
    TEST_ASSERT_EQUAL(BELT_NO_LEVEL, step_level(NAN));
    assert_nothing_is_fed();
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_INVALID, command.error_bits);
}

static void test_first_level_fills_the_whole_window(void) {
    (void)step_level(NAN);
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25));
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
    /* 0.25 over 0.2 s: a quantum a level and six roundings. */
    TEST_ASSERT_DOUBLE_WITHIN(6 * EPSILON, 0.05, (double)controller.present.congestion);
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, 0.25,
                              (double)belt_level_history_at(&controller.history, BELT_REAL(80)));
    TEST_ASSERT_DOUBLE_WITHIN(4 * 8 * EPSILON, 4.0 / 1.05, (double)controller.transport_speed);
}

static void test_second_level_is_one_of_many(void) {
    (void)step_level(0.25);
    (void)step_level(0.75);
    /* Half a period of 0.5 more. */
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, 0.05 + 0.5 * 0.0025 * 0.5,
                              (double)controller.present.congestion);
}

static void test_lost_level_is_said_and_the_last_one_stands_in(void) {
    (void)step_level(0.25);
    measurement.present = 0u;
    TEST_ASSERT_EQUAL(BELT_INPUT_REJECTED, belt_step(&controller, &measurement, &command));
    TEST_ASSERT_EQUAL(BELT_MODE_AUTOMATIC, command.mode);
    TEST_ASSERT_EQUAL_HEX32(BELT_ERROR_LEVEL_MISSING, command.error_bits);
    TEST_ASSERT_TRUE(controller.present.level == BELT_REAL(0.25));
}

/* --- what is fed reaches the belt --- */

static double on_belt(void) {
    double sum = 0.0;
    for (uint32_t i = 0; i < controller.line.cell_slots; ++i) {
        sum += (double)controller.observer.density[i];
    }
    return sum;
}

static void test_applied_flux_is_what_lies_on_the_belt_and_not_the_command(void) {
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(command.inlet_flux > BELT_REAL(1)); /* an empty line is asked to be filled */
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX;
    measurement.applied_flux = BELT_REAL(0);
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(on_belt() == 0.0);
    measurement.present = BELT_HAS_LEVEL;
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(on_belt() > 0.0);
}

static void test_first_part_fed_is_as_dense_as_flux_over_speed(void) {
    (void)step_level(0.0);
    const double fed = (double)command.inlet_flux;
    (void)step_level(0.0);
    /* Speed 4 m/s; a period's loss of 1/s at most. */
    TEST_ASSERT_DOUBLE_WITHIN(0.0025 * fed / 4.0, fed / 4.0, on_belt());
}

static void test_inlet_flux_is_limited(void) {
    config.inlet_flux_max = BELT_REAL(0.5);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    (void)step_level(0.0);
    TEST_ASSERT_TRUE(command.inlet_flux == BELT_REAL(0.5));
}

static void test_measured_density_lies_on_the_belt(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = BELT_REAL(0.25);
    }
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_DENSITY;
    measurement.density = density;
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.0));
    TEST_ASSERT_DOUBLE_WITHIN(20 * EPSILON, 0.25 * 20.0, on_belt());
}

static void test_measured_outlet_flux_is_taken_as_density(void) {
    (void)step_level(0.25);
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_OUTLET_FLUX;
    measurement.outlet_flux = BELT_REAL(0.5);
    (void)step_level(0.25);
    /* 0.5 at 4/1.05 m/s. */
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, 0.5 * 1.05 / 4.0,
                              (double)controller.observer.outlet_density);
}

static void test_line_at_rest_is_fed_the_flux_that_holds_it(void) {
    const rest_t rest = line_at_rest(&config);
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = BELT_REAL(rest_density(&config, &rest, 0.1 * (double)i));
    }
    measurement.present = BELT_HAS_LEVEL | BELT_HAS_DENSITY;
    measurement.density = density;
    (void)step_level(0.3);
    /* Second order on 20 cells: 0.0265^2/8 of the belt's density between the nodes, which the law's
     * slope of 22 turns into flux, times the gain of the belt, alpha*density over 0.5 s. */
    TEST_ASSERT_DOUBLE_WITHIN(22.0 * 0.0265 * 0.0265 / 8.0 * 0.3 + 100 * EPSILON, rest.inlet_flux,
                              (double)command.inlet_flux);
}

/* --- the set-point --- */

static void test_refused_setpoint_leaves_the_old_one(void) {
    static belt_controller_t before;
    (void)step_level(0.1);
    before = controller;
    const belt_real_t refused[] = {BELT_REAL(0), BELT_REAL(-1), BELT_REAL(0.6), BELT_REAL(NAN),
                                   BELT_REAL(INFINITY)};
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
        TEST_ASSERT_EQUAL(BELT_LEVEL_SETPOINT, belt_set_setpoint(&controller, refused[i]));
        TEST_ASSERT_TRUE(memcmp(&controller, &before, sizeof before) == 0);
    }
}

static void test_setpoint_whose_slope_is_too_steep_leaves_the_old_one(void) {
    /* At 0.004 the least slope is 1.192/0.004 = 298; with the margin of 200 it is too steep. */
    config.slope = BELT_REAL(200);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_PERIOD_PER_SLOPE, belt_set_setpoint(&controller, BELT_REAL(0.004)));
    TEST_ASSERT_TRUE(controller.config.level_setpoint == BELT_REAL(0.3));
    TEST_ASSERT_TRUE(controller.law.level_setpoint == BELT_REAL(0.3));
}

static void test_new_setpoint_is_that_of_a_controller_made_for_it(void) {
    static belt_controller_t other;
    config.level_setpoint = BELT_REAL(0.45);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&other, &config));
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_setpoint(&controller, BELT_REAL(0.45)));
    TEST_ASSERT_TRUE(memcmp(&controller, &other, sizeof other) == 0);
}

/* --- any bits on any input --- */

static belt_real_t random_real(uint64_t *random) {
    /* Half of them any bits, half of them numbers of the size of sound ones. */
    const uint64_t bits = random_bits(random);
    return ((bits & 0x100000000u) != 0u) ? real_from_bits(random_bits(random))
                                         : BELT_REAL(2) * random_share(random) - BELT_REAL(0.5);
}

static void randomise(uint64_t *random, belt_real_t *density) {
    measurement.present = (uint32_t)random_bits(random) & 0xFFu;
    measurement.level = random_real(random);
    measurement.outlet_flux = random_real(random);
    measurement.applied_flux = random_real(random);
    measurement.sample_count = (uint32_t)random_bits(random);
    measurement.elapsed_ticks = (uint32_t)random_bits(random);
    const uint64_t kind = random_bits(random) & 7u;
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = (kind == 0u) ? random_real(random) : random_share(random);
    }
    measurement.density = (kind == 1u) ? NULL : density;
}

static void assert_command_is_sound(belt_status_t status) {
    TEST_ASSERT_TRUE(command.inlet_flux >= BELT_REAL(0));
    TEST_ASSERT_TRUE(command.inlet_flux <= config.inlet_flux_max);
    TEST_ASSERT_TRUE((status != BELT_OK) == (command.error_bits != 0u));
    TEST_ASSERT_TRUE((status == BELT_NO_LEVEL) == (command.mode == BELT_MODE_OFF));
}

static void assert_any_bits_give_a_sound_command(uint64_t seed, unsigned steps) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    for (unsigned i = 0; i < steps; ++i) {
        randomise(&seed, density);
        memset(&command, 0xFF, sizeof command);
        assert_command_is_sound(belt_step(&controller, &measurement, &command));
    }
}

static void test_any_bits_on_any_input_give_a_finite_command_within_the_limits(void) {
    assert_any_bits_give_a_sound_command(0x2545F4914F6CDD1Du, 50000u);
}

static void test_any_bits_give_a_sound_command_for_a_limited_lossy_profile(void) {
    config.inlet_flux_max = BELT_REAL(1.5);
    config.loss_count = 3;
    config.loss_rate[0] = BELT_REAL(2);
    config.loss_rate[1] = BELT_REAL(0);
    config.loss_rate[2] = BELT_REAL(1);
    config.node_count = 13;
    assert_any_bits_give_a_sound_command(0x9E3779B97F4A7C15u, 50000u);
}

/* --- one controller, one struct --- */

static void test_two_controllers_do_not_influence_each_other(void) {
    static belt_controller_t alone;
    static belt_controller_t other;
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    uint64_t random = 99u;
    uint64_t other_random = 7u;
    belt_command_t of_other;
    belt_command_t of_alone;
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&alone, &config));
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&other, &config));
    for (int i = 0; i < 2000; ++i) {
        randomise(&other_random, density);
        (void)belt_step(&other, &measurement, &of_other);
        randomise(&random, density);
        const belt_status_t status = belt_step(&controller, &measurement, &command);
        TEST_ASSERT_EQUAL(status, belt_step(&alone, &measurement, &of_alone));
        TEST_ASSERT_TRUE(command.inlet_flux == of_alone.inlet_flux);
    }
    TEST_ASSERT_TRUE(memcmp(&controller.observer, &alone.observer, sizeof alone.observer) == 0);
}

static void test_nothing_is_written_outside_the_structs(void) {
    static struct {
        unsigned char before[256];
        belt_controller_t controller;
        unsigned char between[256];
        belt_command_t command;
        unsigned char behind[256];
    } guarded;
    static unsigned char untouched[256];
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    uint64_t random = 4242u;
    memset(&guarded, 0x5A, sizeof guarded);
    memset(untouched, 0x5A, sizeof untouched);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&guarded.controller, &config));
    for (int i = 0; i < 5000; ++i) {
        randomise(&random, density);
        (void)belt_step(&guarded.controller, &measurement, &guarded.command);
        (void)belt_set_setpoint(&guarded.controller, random_real(&random));
    }
    TEST_ASSERT_TRUE(memcmp(guarded.before, untouched, sizeof untouched) == 0);
    TEST_ASSERT_TRUE(memcmp(guarded.between, untouched, sizeof untouched) == 0);
    TEST_ASSERT_TRUE(memcmp(guarded.behind, untouched, sizeof untouched) == 0);
}

static void test_inputs_are_left_as_they_are(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    belt_real_t density_before[BELT_NODE_CAPACITY + 1];
    belt_measurement_t before;
    belt_config_t config_before;
    uint64_t random = 17u;
    memset(density, 0, sizeof density);
    memcpy(&config_before, &config, sizeof config);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    for (int i = 0; i < 200; ++i) {
        randomise(&random, density);
        memcpy(&before, &measurement, sizeof before);
        memcpy(density_before, density, sizeof density);
        (void)belt_step(&controller, &measurement, &command);
        TEST_ASSERT_TRUE(memcmp(&before, &measurement, sizeof before) == 0);
        TEST_ASSERT_TRUE(memcmp(density_before, density, sizeof density) == 0);
    }
    TEST_ASSERT_TRUE(memcmp(&config_before, &config, sizeof config) == 0);
}

/* --- start again --- */

static void test_controller_can_start_again_with_its_own_configuration(void) {
    belt_command_t first;
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.1));
    first = command;
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.2));
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &controller.config));
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.1));
    TEST_ASSERT_TRUE(command.inlet_flux == first.inlet_flux);
}

/* --- no clock --- */

/* At rest on an empty buffer this line moves an eighth of a spacing a period, exactly. */
#define PERIODS_A_SPACING 8

static void make_dyadic(void) {
    config.node_count = 16;
    config.period = BELT_REAL(0.00390625);
    config.speed_window = BELT_REAL(0.125);
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
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

static void test_tick_and_sample_counts_change_nothing(void) {
    static belt_controller_t counted;
    belt_command_t of_counted;
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&counted, &config));
    for (uint32_t i = 0; i < 300u; ++i) {
        measurement.level = BELT_REAL(0.001 * i);
        measurement.sample_count = 0u;
        measurement.elapsed_ticks = 0u;
        (void)belt_step(&controller, &measurement, &command);
        measurement.sample_count = UINT32_MAX - 100u + i;
        measurement.elapsed_ticks = UINT32_MAX - i;
        (void)belt_step(&counted, &measurement, &of_counted);
        TEST_ASSERT_TRUE(of_counted.inlet_flux == command.inlet_flux);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_null_pointers_are_misuse);
    RUN_TEST(test_step_before_init_feeds_nothing);
    RUN_TEST(test_step_after_a_refused_init_is_misuse);
    RUN_TEST(test_refused_second_init_leaves_the_controller_running);
    RUN_TEST(test_second_init_starts_anew);
    RUN_TEST(test_without_any_level_nothing_is_fed);
    RUN_TEST(test_first_level_fills_the_whole_window);
    RUN_TEST(test_second_level_is_one_of_many);
    RUN_TEST(test_lost_level_is_said_and_the_last_one_stands_in);
    RUN_TEST(test_applied_flux_is_what_lies_on_the_belt_and_not_the_command);
    RUN_TEST(test_first_part_fed_is_as_dense_as_flux_over_speed);
    RUN_TEST(test_inlet_flux_is_limited);
    RUN_TEST(test_measured_density_lies_on_the_belt);
    RUN_TEST(test_measured_outlet_flux_is_taken_as_density);
    RUN_TEST(test_line_at_rest_is_fed_the_flux_that_holds_it);
    RUN_TEST(test_refused_setpoint_leaves_the_old_one);
    RUN_TEST(test_setpoint_whose_slope_is_too_steep_leaves_the_old_one);
    RUN_TEST(test_new_setpoint_is_that_of_a_controller_made_for_it);
    RUN_TEST(test_any_bits_on_any_input_give_a_finite_command_within_the_limits);
    RUN_TEST(test_any_bits_give_a_sound_command_for_a_limited_lossy_profile);
    RUN_TEST(test_two_controllers_do_not_influence_each_other);
    RUN_TEST(test_nothing_is_written_outside_the_structs);
    RUN_TEST(test_inputs_are_left_as_they_are);
    RUN_TEST(test_controller_can_start_again_with_its_own_configuration);
    RUN_TEST(test_a_long_rest_leaves_no_trace);
    RUN_TEST(test_tick_and_sample_counts_change_nothing);
    return UNITY_END();
}
