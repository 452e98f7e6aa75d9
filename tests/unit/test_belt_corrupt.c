/* SPDX-License-Identifier: MIT */
#include "belt_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/** One block of the controller whose every bit is guarded. */
typedef struct {
    const char *name;
    size_t begin;
    size_t end;
} block_t;

#define AT(field) offsetof(belt_controller_t, field)
static const block_t sealed[] = {
    {"law", AT(law), AT(law) + sizeof(belt_nominal_law_t)},
    {"limits", AT(limits), AT(limits) + sizeof(belt_limits_t)},
    {"estimator gains", AT(model.estimator_gains), AT(model.history)},
    {"line", AT(model.line), AT(model.line) + offsetof(belt_line_t, loss_mean)},
    {"node_count", AT(model.line.node_count), AT(model.line.node_count) + sizeof(uint32_t)},
    {"cell_slots", AT(model.line.cell_slots), AT(model.line.cell_slots) + sizeof(uint32_t)},
    {"loss_is_uniform", AT(model.line.loss_is_uniform),
     AT(model.line.loss_is_uniform) + sizeof(bool)},
    {"history's constants", AT(model.history), AT(model.history.window_sum)},
    {"supervisor", AT(supervisor), AT(supervisor) + sizeof(belt_supervisor_t)},
    {"command", AT(command), AT(command) + sizeof(belt_command_t)},
    {"seal of the command", AT(command_seal), AT(command_seal) + sizeof(uint32_t)},
    {"seal", AT(seal), AT(seal) + sizeof(uint32_t)},
};

static void flip(size_t byte, unsigned bit) {
    unsigned char *bytes = (unsigned char *)&controller;
    bytes[byte] = (unsigned char)(bytes[byte] ^ (1u << bit));
}

static void assert_corrupt(const char *name) {
    memset(&command, 0xA5, sizeof command);
    TEST_ASSERT_EQUAL_MESSAGE(BELT_CORRUPT, step_level(0.25), name);
    TEST_ASSERT_TRUE_MESSAGE(command.inlet_flux == BELT_REAL(0), name);
    TEST_ASSERT_EQUAL_MESSAGE(BELT_MODE_OFF, command.mode, name);
    TEST_ASSERT_EQUAL_HEX32_MESSAGE(0u, command.error_bits, name);
}

static void begin_well(void) {
    config.estimator = BELT_ESTIMATOR_ON;
    start();
    steps_level(0.25, 20u);
}

static void test_every_bit_of_what_is_sealed_is_guarded(void) {
    static belt_controller_t well;
    begin_well();
    well = controller;
    for (size_t i = 0; i < sizeof sealed / sizeof sealed[0]; ++i) {
        for (size_t byte = sealed[i].begin; byte < sealed[i].end; ++byte) {
            for (unsigned bit = 0; bit < 8u; ++bit) {
                controller = well;
                flip(byte, bit);
                TEST_ASSERT_FALSE_MESSAGE(belt_is_running(&controller), sealed[i].name);
                assert_corrupt(sealed[i].name);
            }
        }
    }
}

static void test_index_or_share_out_of_its_range_is_corrupt(void) {
    static belt_controller_t well;
    begin_well();
    well = controller;
    controller.model.history.newest = controller.model.history.length;
    assert_corrupt("newest");
    controller = well;
    controller.model.observer.outlet = controller.model.line.cell_slots;
    assert_corrupt("outlet");
    const belt_real_t shares[] = {BELT_REAL(1), BELT_REAL(-1e-30), BELT_REAL(NAN),
                                  BELT_REAL(INFINITY)};
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; ++i) {
        controller = well;
        controller.model.observer.gone = shares[i];
        assert_corrupt("gone");
    }
}

static void test_corrupt_stays_corrupt_until_init_even_if_the_bit_flips_back(void) {
    begin_well();
    flip(AT(model.line), 3u);
    assert_corrupt("line");
    flip(AT(model.line), 3u);
    for (int i = 0; i < 10; ++i) {
        assert_corrupt("line");
        TEST_ASSERT_FALSE(belt_is_running(&controller));
    }
    start();
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25));
    TEST_ASSERT_TRUE(flux() > 0.0);
}

static void test_calls_from_outside_are_refused_when_corrupt(void) {
    static belt_controller_t before;
    begin_well();
    ask(BELT_MODE_MANUAL);
    flip(AT(limits), 5u);
    for (int i = 0; i < 2; ++i) {
        before = controller;
        TEST_ASSERT_EQUAL(BELT_CORRUPT, belt_set_setpoint(&controller, BELT_REAL(0.4)));
        TEST_ASSERT_EQUAL(BELT_CORRUPT, belt_set_mode(&controller, BELT_MODE_OFF));
        TEST_ASSERT_EQUAL(BELT_CORRUPT, belt_set_manual_flux(&controller, BELT_REAL(0.5)));
        TEST_ASSERT_TRUE(memcmp(&before, &controller, sizeof before) == 0);
        assert_corrupt("limits"); /* and once more, now that the controller knows */
    }
}

static void test_calls_that_read_the_configuration_refuse_one_that_has_changed(void) {
    static belt_controller_t well;
    begin_well();
    well = controller;
    for (size_t byte = 0; byte < sizeof(belt_config_t); ++byte) {
        controller = well;
        flip(byte, byte % 8u);
        TEST_ASSERT_EQUAL(BELT_CORRUPT, belt_set_setpoint(&controller, BELT_REAL(0.4)));
        TEST_ASSERT_FALSE(belt_is_running(&controller));
        TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25)); /* the step does not read it */
    }
}

static void test_set_calls_seal_what_they_change(void) {
    begin_well();
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_setpoint(&controller, BELT_REAL(0.4)));
    TEST_ASSERT_TRUE(belt_is_running(&controller));
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_TRUE(belt_is_running(&controller));
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.5)));
    TEST_ASSERT_TRUE(belt_is_running(&controller));
    TEST_ASSERT_EQUAL(BELT_OK, step_level(0.25));
}

static void test_state_that_is_no_word_of_it_feeds_nothing(void) {
    static belt_controller_t well;
    begin_well();
    well = controller;
    for (size_t byte = AT(state); byte < AT(state) + sizeof(uint32_t); ++byte) {
        for (unsigned bit = 0; bit < 8u; ++bit) {
            controller = well;
            flip(byte, bit);
            const belt_status_t status = step_level(0.25);
            TEST_ASSERT_TRUE((status == BELT_CORRUPT) || (status == BELT_MISUSE));
            assert_nothing_is_fed();
        }
    }
}

static void test_bits_of_the_belt_leave_with_the_material(void) {
    static belt_controller_t well;
    belt_command_t of_well;
    (void)begin_at_rest();
    well = controller;
    controller.model.observer.density[10] *= BELT_REAL(2); /* a bit of the exponent */
    double worst = 0.0;
    double last = 0.0;
    for (int i = 0; i < 220; ++i) { /* one dead time is 212 periods */
        measurement.present = BELT_HAS_LEVEL | BELT_HAS_APPLIED_FLUX;
        measurement.applied_flux = well.command.inlet_flux;
        measurement.level = BELT_REAL(0.3);
        TEST_ASSERT_EQUAL(BELT_OK, belt_step(&well, &measurement, &of_well));
        (void)step();
        last = fabs((double)of_well.inlet_flux - flux());
        worst = fmax(worst, last);
    }
    TEST_ASSERT_TRUE(worst > 1e-3);
    /* Rework puts a twentieth of what leaves back on the belt: A D P D/2. */
    TEST_ASSERT_TRUE(last < 0.06 * worst);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_every_bit_of_what_is_sealed_is_guarded);
    RUN_TEST(test_index_or_share_out_of_its_range_is_corrupt);
    RUN_TEST(test_corrupt_stays_corrupt_until_init_even_if_the_bit_flips_back);
    RUN_TEST(test_calls_from_outside_are_refused_when_corrupt);
    RUN_TEST(test_calls_that_read_the_configuration_refuse_one_that_has_changed);
    RUN_TEST(test_set_calls_seal_what_they_change);
    RUN_TEST(test_state_that_is_no_word_of_it_feeds_nothing);
    RUN_TEST(test_bits_of_the_belt_leave_with_the_material);
    return UNITY_END();
}
