/* SPDX-License-Identifier: MIT */
#include "snapshot_case.h"

void setUp(void) {
    begin_snapshots();
}

void tearDown(void) {
}

/* --- the check sum --- */

static void test_crc_has_the_published_check_value(void) {
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, belt_snapshot_crc(0, "123456789", 9u));
    unsigned char bytes[256]; /* every entry of the table; zlib.crc32(bytes(range(256))) */
    for (size_t i = 0; i < sizeof bytes; ++i) {
        bytes[i] = (unsigned char)i;
    }
    TEST_ASSERT_EQUAL_HEX32(0x29058C73u, belt_snapshot_crc(0, bytes, sizeof bytes));
    TEST_ASSERT_EQUAL_HEX32(0u, belt_snapshot_crc(0, "", 0u));
}

static void test_crc_goes_on_from_what_came_before(void) {
    const uint32_t begun = belt_snapshot_crc(0, "1234", 4u);
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926u, belt_snapshot_crc(begun, "56789", 5u));
}

/* --- a good restart --- */

static void assert_goes_on_to_the_bit(void) {
    take();
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
    TEST_ASSERT_TRUE(know_the_same(&controller, &restored));
    for (unsigned i = 0; i < 1000u; ++i) {
        belt_command_t answer;
        measurement.level = BELT_REAL(0.25 + 0.1 * sin(0.01 * i));
        const belt_status_t status = belt_step(&restored, &measurement, &answer);
        TEST_ASSERT_EQUAL(step(), status);
        TEST_ASSERT_TRUE(real_bits(answer.inlet_flux) == real_bits(command.inlet_flux));
        TEST_ASSERT_EQUAL(command.mode, answer.mode);
        TEST_ASSERT_EQUAL_HEX32(command.error_bits, answer.error_bits);
    }
    TEST_ASSERT_TRUE(know_the_same(&controller, &restored));
}

static void test_good_restart_goes_on_to_the_bit(void) {
    assert_goes_on_to_the_bit();
}

static void test_good_restart_goes_on_to_the_bit_in_every_mode(void) {
    steps_blind(20u);
    TEST_ASSERT_EQUAL(BELT_MODE_HOLD, command.mode);
    assert_goes_on_to_the_bit();
    steps_blind(150u);
    TEST_ASSERT_EQUAL(BELT_MODE_SUBSTITUTE, command.mode);
    assert_goes_on_to_the_bit();
    ask(BELT_MODE_MANUAL);
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_manual_flux(&controller, BELT_REAL(0.7)));
    assert_goes_on_to_the_bit();
    ask(BELT_MODE_AUTOMATIC);
    run_for(20u); /* a bump is being worn off */
    assert_goes_on_to_the_bit();
}

static void test_setpoint_is_restored_and_not_the_configurations(void) {
    TEST_ASSERT_EQUAL(BELT_OK, belt_set_setpoint(&controller, BELT_REAL(0.45)));
    assert_goes_on_to_the_bit();
    TEST_ASSERT_TRUE(restored.config.level_setpoint == BELT_REAL(0.45));
}

static void test_configuration_may_be_the_controllers_own(void) {
    static belt_controller_t before;
    take();
    before = controller;
    TEST_ASSERT_EQUAL(BELT_OK, belt_snapshot_restore(&controller, &controller.config, slots, 0u));
    TEST_ASSERT_TRUE(know_the_same(&before, &controller));
}

/* --- two slots --- */

static void test_older_slot_is_overwritten_and_the_newer_restored(void) {
    for (uint32_t i = 1; i < 8u; ++i) {
        static belt_snapshot_t before;
        run_for(1u);
        before = slots[i % 2u];
        take();
        TEST_ASSERT_EQUAL_UINT32(i, slots[(i + 1u) % 2u].sequence);
        TEST_ASSERT_TRUE(memcmp(&before, &slots[i % 2u], sizeof before) == 0);
        TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
        TEST_ASSERT_TRUE(know_the_same(&controller, &restored));
    }
}

static void test_sequence_may_wrap(void) {
    take();
    slots[0].sequence = UINT32_MAX;
    seal(&slots[0]);
    run_for(1u);
    take();
    TEST_ASSERT_EQUAL_UINT32(0u, slots[1].sequence);
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
    TEST_ASSERT_TRUE(know_the_same(&controller, &restored));
    run_for(1u);
    take();
    TEST_ASSERT_EQUAL_UINT32(1u, slots[0].sequence);
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
    TEST_ASSERT_TRUE(know_the_same(&controller, &restored));
}

static void test_power_cut_at_any_byte_leaves_one_whole_state(void) {
    static belt_snapshot_t old;
    static belt_snapshot_t fresh;
    static belt_controller_t before;
    take();
    run_for(7u);
    take();
    old = slots[0];
    before = controller; /* in slots[1] */
    run_for(7u);
    take();
    fresh = slots[0];
    unsigned of_before = 0;
    for (size_t cut = 0; cut <= sizeof fresh; cut += stride_at(cut)) {
        slots[0] = old;
        memcpy(&slots[0], &fresh, cut);
        TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
        const bool is_before = know_the_same(&before, &restored);
        TEST_ASSERT_TRUE(is_before || know_the_same(&controller, &restored));
        of_before += is_before ? 1u : 0u;
        /* Whole only with its last bytes, those of the sum. */
        TEST_ASSERT_TRUE(is_before || (cut > offsetof(belt_snapshot_t, crc)));
    }
    TEST_ASSERT_TRUE(of_before > 500u);
    slots[0] = fresh;
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
    TEST_ASSERT_TRUE(know_the_same(&controller, &restored));
}

static void test_power_cut_during_the_first_snapshot_leaves_none(void) {
    static belt_snapshot_t fresh;
    take();
    fresh = slots[0];
    for (size_t cut = 0; cut < sizeof fresh - sizeof(uint32_t); cut += stride_at(cut)) {
        memset(&slots[0], 0xFF, sizeof slots[0]);
        memcpy(&slots[0], &fresh, cut);
        TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
    }
}

static void test_any_flipped_bit_makes_a_slot_invalid(void) {
    take();
    unsigned char *bytes = (unsigned char *)&slots[0];
    const size_t end = offsetof(belt_snapshot_t, crc) + sizeof slots[0].crc; /* behind it: a gap */
    for (size_t byte = 0; byte < end; byte += stride_at(byte)) {
        for (unsigned bit = 0; bit < 8u; ++bit) {
            const unsigned char well = bytes[byte];
            bytes[byte] = (unsigned char)(well ^ (1u << bit));
            TEST_ASSERT_EQUAL(BELT_NO_SNAPSHOT, restore(0u));
            bytes[byte] = well;
        }
    }
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
}

static void test_invalid_slot_yields_to_the_older_one_and_is_overwritten_next(void) {
    static belt_controller_t before;
    take();
    before = controller;
    run_for(1u);
    take();
    slots[1].state[100] ^= 1u;
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
    TEST_ASSERT_TRUE(know_the_same(&before, &restored));
    run_for(1u);
    take();
    TEST_ASSERT_EQUAL_UINT32(2u, slots[1].sequence);
    TEST_ASSERT_EQUAL(BELT_OK, restore(0u));
    TEST_ASSERT_TRUE(know_the_same(&controller, &restored));
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_crc_has_the_published_check_value);
    RUN_TEST(test_crc_goes_on_from_what_came_before);
    RUN_TEST(test_good_restart_goes_on_to_the_bit);
    RUN_TEST(test_good_restart_goes_on_to_the_bit_in_every_mode);
    RUN_TEST(test_setpoint_is_restored_and_not_the_configurations);
    RUN_TEST(test_configuration_may_be_the_controllers_own);
    RUN_TEST(test_older_slot_is_overwritten_and_the_newer_restored);
    RUN_TEST(test_sequence_may_wrap);
    RUN_TEST(test_power_cut_at_any_byte_leaves_one_whole_state);
    RUN_TEST(test_power_cut_during_the_first_snapshot_leaves_none);
    RUN_TEST(test_any_flipped_bit_makes_a_slot_invalid);
    RUN_TEST(test_invalid_slot_yields_to_the_older_one_and_is_overwritten_next);
    return UNITY_END();
}
