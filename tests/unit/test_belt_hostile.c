/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
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
    const uint64_t late = random_bits(random);
    measurement.elapsed_ticks =
        ((late & 7u) == 0u) ? (uint32_t)random_bits(random) : (uint32_t)(late >> 8) & 3u;
    const uint64_t kind = random_bits(random) & 7u;
    for (size_t i = 0; i <= config.node_count; ++i) {
        density[i] = (kind == 0u) ? random_real(random) : random_share(random);
    }
    measurement.density = (kind == 1u) ? NULL : density;
}

static void assert_command_is_sound(belt_status_t status) {
    TEST_ASSERT_TRUE(command.inlet_flux >= BELT_REAL(0));
    TEST_ASSERT_TRUE(command.inlet_flux <= config.inlet_flux_max);
    TEST_ASSERT_TRUE((unsigned)command.mode < BELT_MODE_COUNT);
    TEST_ASSERT_TRUE((status == BELT_OK) || (status == BELT_INPUT_REJECTED) ||
                     (status == BELT_PERIODS_MISSED) || (status == BELT_LINE_DEVIATES) ||
                     (status == BELT_NO_LEVEL));
    if (status != BELT_NO_LEVEL) {
        TEST_ASSERT_TRUE((status != BELT_OK) == (command.error_bits != 0u));
    }
}

static void assert_any_bits_give_a_sound_command(uint64_t seed, unsigned steps) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    TEST_ASSERT_EQUAL(BELT_OK, belt_init(&controller, &config));
    for (unsigned i = 0; i < steps; ++i) {
        randomise(&seed, density);
        if ((random_bits(&seed) & 15u) == 0u) {
            (void)belt_set_mode(&controller, (belt_mode_t)(random_bits(&seed) % 6u));
            (void)belt_set_manual_flux(&controller, random_real(&seed));
        }
        memset(&command, 0xFF, sizeof command);
        assert_command_is_sound(belt_step(&controller, &measurement, &command));
    }
}

static void test_any_bits_on_any_input_give_a_finite_command_within_the_limits(void) {
    assert_any_bits_give_a_sound_command(0x2545F4914F6CDD1Du, 50000u);
}

static void test_any_bits_give_a_sound_command_for_an_estimator_on_a_limited_lossy_profile(void) {
    config.inlet_flux_max = BELT_REAL(1.5);
    config.loss_count = 3;
    config.loss_rate[0] = BELT_REAL(2);
    config.loss_rate[1] = BELT_REAL(0);
    config.loss_rate[2] = BELT_REAL(1);
    config.node_count = 13;
    config.estimator = BELT_ESTIMATOR_ON;
    config.flux_rate_max = BELT_REAL(50);
    config.substitute_flux = BELT_REAL(0.5);
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
    TEST_ASSERT_TRUE(memcmp(&controller.model.observer, &alone.model.observer,
                            sizeof alone.model.observer) == 0);
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
        (void)belt_set_mode(&guarded.controller, (belt_mode_t)(random_bits(&random) % 4u));
        (void)belt_set_manual_flux(&guarded.controller, random_real(&random));
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

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_any_bits_on_any_input_give_a_finite_command_within_the_limits);
    RUN_TEST(test_any_bits_give_a_sound_command_for_an_estimator_on_a_limited_lossy_profile);
    RUN_TEST(test_two_controllers_do_not_influence_each_other);
    RUN_TEST(test_nothing_is_written_outside_the_structs);
    RUN_TEST(test_inputs_are_left_as_they_are);
    return UNITY_END();
}
