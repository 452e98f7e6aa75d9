/* SPDX-License-Identifier: MIT */
#include "snapshot_case.h"

void setUp(void) {
    begin_snapshots();
}

void tearDown(void) {
}

/* --- slots of others --- */

static void test_without_a_valid_slot_the_controller_is_as_it_was(void) {
    static belt_controller_t before;
    before = controller;
    TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, belt_snapshot_restore(&controller, &config, slots, 0u));
    TEST_ASSERT_TRUE(memcmp(&before, &controller, sizeof before) == 0);
    config.period = BELT_REAL(-1);
    TEST_ASSERT_EQUAL(BELT_PERIOD, belt_snapshot_restore(&controller, &config, slots, 0u));
    TEST_ASSERT_TRUE(memcmp(&before, &controller, sizeof before) == 0);
}

static void test_null_pointers_are_misuse(void) {
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_snapshot_restore(NULL, &config, slots, 0u));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_snapshot_restore(&controller, NULL, slots, 0u));
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_snapshot_restore(&controller, &config, NULL, 0u));
    belt_snapshot_take(NULL, slots);
    belt_snapshot_take(&controller, NULL);
}

static void test_controller_that_is_not_running_is_not_written(void) {
    static belt_snapshot_t empty;
    static belt_controller_t never;
    belt_snapshot_take(&never, slots);
    start();
    take(); /* no level yet */
    run_for(1u);
    controller.limits.inlet_flux_max = BELT_REAL(7);
    take(); /* corrupt */
    TEST_ASSERT_TRUE(memcmp(&empty, &slots[0], sizeof empty) == 0);
    TEST_ASSERT_TRUE(memcmp(&empty, &slots[1], sizeof empty) == 0);
}

static void test_other_layout_or_size_is_refused(void) {
    static belt_snapshot_t well;
    take();
    well = slots[0];
    slots[0].layout += 1u;
    seal(&slots[0]);
    TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
    slots[0] = well;
    slots[0].size -= 4u;
    seal(&slots[0]);
    TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
    slots[0] = well;
    seal(&slots[0]);
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
}

/** Still sound, but in one field. */
static void assert_other_configuration_is_refused(void) {
    TEST_ASSERT_EQUAL(BELT_OK, belt_config_check(&config, NULL));
    TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
}

static void test_other_configuration_is_refused_whichever_number_differs(void) {
    belt_real_t *const numbers[] = {
        &config.belt_length,      &config.processing_time,  &config.speed_window,
        &config.congestion_scale, &config.connectivity,     &config.service_rate_max,
        &config.service_time,     &config.level_capacity,   &config.rework_rate,
        &config.loss_rate[0],     &config.nominal_flux_max, &config.slope,
        &config.period,           &config.inlet_flux_max,   &config.estimator_time,
        &config.flux_rate_max,    &config.substitute_flux,  &config.level_step_max,
        &config.transfer_time};
    config.inlet_flux_max = BELT_REAL(3);
    config.estimator_time = BELT_REAL(0.4);
    config.flux_rate_max = BELT_REAL(100);
    config.level_step_max = BELT_REAL(0.2);
    config.transfer_time = BELT_REAL(0.3);
    start();
    run_for(10u);
    take();
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i) {
        const belt_real_t well = *numbers[i];
        *numbers[i] = real_next(well, BELT_REAL(0));
        assert_other_configuration_is_refused();
        *numbers[i] = well;
    }
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
}

static void test_other_configuration_is_refused_whichever_word_differs(void) {
    uint16_t *const counts[] = {&config.node_count, &config.sample_periods, &config.hold_periods,
                                &config.recovery_samples};
    const belt_config_t well = config;
    take();
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
        *counts[i] = (uint16_t)(*counts[i] + ((i == 0u) ? -1 : 1));
        assert_other_configuration_is_refused();
        config = well;
    }
    config.slope_kind = BELT_SLOPE_ABSOLUTE;
    config.slope = BELT_REAL(30);
    assert_other_configuration_is_refused();
    config = well;
    config.prediction = BELT_HOLD_CONGESTION;
    assert_other_configuration_is_refused();
    config = well;
    config.estimator = BELT_ESTIMATOR_OFF;
    assert_other_configuration_is_refused();
    config = well;
    config.loss_count = 2; /* the same loss, said with two values */
    config.loss_rate[1] = config.loss_rate[0];
    assert_other_configuration_is_refused();
    config = well;
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
}

/* --- slots of an enemy --- */

static void assert_never_a_bad_command(uint32_t down_periods) {
    const belt_status_t status = restore(down_periods);
    TEST_ASSERT_TRUE((status == BELT_OK) || (status == BELT_SNAPSHOT_OLD) ||
                     (status == BELT_NO_SNAPSHOT) || (status == BELT_LEVEL_SETPOINT));
    for (int i = 0; (i < 5) && ((status == BELT_OK) || (status == BELT_SNAPSHOT_OLD)); ++i) {
        belt_command_t answer;
        (void)step_restored(0.25, &answer);
        TEST_ASSERT_TRUE((answer.inlet_flux >= BELT_REAL(0)) &&
                         (answer.inlet_flux <= config.inlet_flux_max));
        TEST_ASSERT_TRUE((unsigned)answer.mode < BELT_MODE_COUNT);
    }
}

/** Puts any bits in one word of a slot. */
static void spoil(size_t word, uint64_t *random) {
    const uint32_t bits = (uint32_t)random_bits(random);
    memcpy((unsigned char *)&slots[0] + word * sizeof bits, &bits, sizeof bits);
}

static void test_valid_slot_with_any_word_hostile_never_gives_a_bad_command(void) {
    static belt_snapshot_t well;
    uint64_t random = 0xC0FFEEu;
    config.inlet_flux_max = BELT_REAL(3);
    start();
    run_for(300u);
    take();
    well = slots[0];
    for (size_t word = 3; word < sizeof well / sizeof(uint32_t);
         word += stride_at(word * sizeof(uint32_t))) {
        for (uint32_t i = 0; i < 4u; ++i) {
            slots[0] = well;
            spoil(word, &random);
            seal(&slots[0]);
            assert_never_a_bad_command(i * 60u);
        }
    }
}

/** Adds to one word of a slot what it takes off another, so that a sum of both stays. */
static void shift(size_t more, size_t less, uint32_t amount) {
    uint32_t word;
    unsigned char *bytes = (unsigned char *)&slots[0];
    memcpy(&word, bytes + more, sizeof word);
    word += amount;
    memcpy(bytes + more, &word, sizeof word);
    memcpy(&word, bytes + less, sizeof word);
    word -= amount;
    memcpy(bytes + less, &word, sizeof word);
}

#define IN_SLOT(field)                                                                             \
    (offsetof(belt_snapshot_t, state) + offsetof(belt_controller_t, field) -                       \
     offsetof(belt_controller_t, model.history))

static void test_valid_slot_with_a_mode_that_is_none_is_refused_though_its_sum_fits(void) {
    static belt_snapshot_t well;
    take();
    well = slots[0];
    shift(IN_SLOT(model.history.length), IN_SLOT(model.history.quantum), 0x00100000u);
    seal(&slots[0]);
    TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
    slots[0] = well;
    shift(IN_SLOT(model.history.length), IN_SLOT(seal), 0u - 0x00100000u);
    seal(&slots[0]);
    TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
    slots[0] = well;
    shift(IN_SLOT(command.mode), IN_SLOT(command.error_bits), 1000u);
    seal(&slots[0]);
    TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
}

static void test_valid_slot_of_hostile_words_never_gives_a_bad_command(void) {
    static belt_snapshot_t well;
    uint64_t random = 0xBADC0DEu;
    take();
    well = slots[0];
    for (int i = 0; i < 500; ++i) {
        slots[0] = well;
        const size_t count = (size_t)1 << (random_bits(&random) % 10u);
        for (size_t k = 0; k < count; ++k) {
            spoil(3u + (size_t)random_bits(&random) % (sizeof well / sizeof(uint32_t) - 4u),
                  &random);
        }
        seal(&slots[0]);
        assert_never_a_bad_command((uint32_t)(random_bits(&random) % 120u));
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_without_a_valid_slot_the_controller_is_as_it_was);
    RUN_TEST(test_null_pointers_are_misuse);
    RUN_TEST(test_controller_that_is_not_running_is_not_written);
    RUN_TEST(test_other_layout_or_size_is_refused);
    RUN_TEST(test_other_configuration_is_refused_whichever_number_differs);
    RUN_TEST(test_other_configuration_is_refused_whichever_word_differs);
    RUN_TEST(test_valid_slot_with_any_word_hostile_never_gives_a_bad_command);
    RUN_TEST(test_valid_slot_with_a_mode_that_is_none_is_refused_though_its_sum_fits);
    RUN_TEST(test_valid_slot_of_hostile_words_never_gives_a_bad_command);
    return UNITY_END();
}
