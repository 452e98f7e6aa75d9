/* SPDX-License-Identifier: MIT */
#include "belt/snapshot.h"

#include "safety_case.h"

void setUp(void) {
    begin_case();
}

void tearDown(void) {
}

/** The belt's states at which the promises are looked at: fed by the law itself for a while. */
static void run_for(unsigned count) {
    measurement.present = BELT_HAS_LEVEL;
    for (unsigned i = 0; i < count; ++i) {
        (void)step_level(0.2 + 0.1 * sin(0.03 * (double)i));
    }
}

static void assert_all_zero(void) {
    static const belt_safety_t nothing;
    const belt_promise_t *promises[] = {&safety.proposition, &safety.sharper};
    for (size_t i = 0; i < 2u; ++i) {
        TEST_ASSERT_TRUE((promises[i]->flux_min == BELT_REAL(0)) &&
                         (promises[i]->density_max == BELT_REAL(0)));
        TEST_ASSERT_TRUE((promises[i]->left == BELT_REAL(0)) &&
                         (promises[i]->right == BELT_REAL(0)));
        TEST_ASSERT_TRUE((promises[i]->margin == BELT_REAL(0)) && !promises[i]->applies);
    }
    TEST_ASSERT_TRUE(safety.jump == nothing.jump);
    assert_no_promise();
}

static void assert_answer(belt_status_t expected, const belt_controller_t *asked) {
    memset(&safety, 0xA5, sizeof safety);
    TEST_ASSERT_EQUAL(expected, belt_safety_assess(asked, &safety));
}

static void test_null_pointers_are_misuse(void) {
    TEST_ASSERT_EQUAL(BELT_MISUSE, belt_safety_assess(&controller, NULL));
    assert_answer(BELT_MISUSE, NULL);
    assert_all_zero();
}

static void test_controller_that_is_not_running_is_promised_nothing(void) {
    static belt_controller_t never;
    assert_answer(BELT_NO_LEVEL, &never);
    assert_all_zero();
    assert_answer(BELT_NO_LEVEL, &controller); /* initialised, no level yet */
    assert_all_zero();
    run_for(3u);
    assert_answer(BELT_OK, &controller);
    controller.model.line.node_count += 1u;
    assert_answer(BELT_NO_LEVEL, &controller);
    assert_all_zero();
    controller.model.line.node_count -= 1u;
    controller.config.rework_rate = BELT_REAL(0);
    assert_answer(BELT_NO_LEVEL, &controller);
    assert_all_zero();
}

static void test_judging_changes_nothing_of_the_controller(void) {
    static belt_controller_t before;
    run_for(300u);
    before = controller;
    assess();
    TEST_ASSERT_TRUE(memcmp(&before, &controller, sizeof before) == 0);
}

static void test_restored_controller_is_judged_before_its_first_step_as_it_was(void) {
    static belt_snapshot_t slots[2];
    run_for(300u);
    assess();
    const belt_safety_t before = safety;
    TEST_ASSERT_EQUAL(BELT_OK, belt_snapshot_take(&controller, slots));
    memset(&controller, 0, sizeof controller);
    TEST_ASSERT_EQUAL(BELT_OK, belt_snapshot_restore(&controller, &config, slots, 0u));
    assess();
    TEST_ASSERT_TRUE(safety.proposition.left == before.proposition.left);
    TEST_ASSERT_TRUE(safety.sharper.left == before.sharper.left);
    TEST_ASSERT_TRUE(safety.jump == before.jump);
}

static void test_predictor_that_holds_the_congestion_is_promised_nothing(void) {
    config.prediction = BELT_HOLD_CONGESTION;
    begin_at(0.1);
    assess();
    TEST_ASSERT_FALSE(safety.proposition.applies || safety.sharper.applies);
    assert_no_promise();
}

static void test_full_buffer_is_promised_nothing(void) {
    begin_at(1.0);
    assess();
    TEST_ASSERT_FALSE(safety.sharper.applies);
    assert_no_promise();
    begin_at(0.999);
    assess();
    TEST_ASSERT_TRUE(safety.sharper.applies);
}

static void test_belt_that_will_overfill_the_buffer_is_promised_nothing(void) {
    static belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (size_t i = 0; i <= 20u; ++i) {
        density[i] = BELT_REAL((i < 10u) ? 2.4 : 0.0); /* full in between, not at the end */
    }
    begin_loaded(0.8, density);
    assess();
    TEST_ASSERT_TRUE(controller.prediction.inlet.level < BELT_REAL(1));
    TEST_ASSERT_FALSE(safety.proposition.applies || safety.sharper.applies);
    assert_no_promise();
}

static void test_material_that_overfills_the_buffer_as_the_last_is_promised_nothing(void) {
    run_for(25u);
    assess();
    TEST_ASSERT_TRUE(safety.sharper.applies);
    const uint32_t open = belt_observer_behind(
        &controller.model.line, controller.model.observer.outlet, controller.model.line.node_count);
    controller.model.observer.density[open] = BELT_REAL(1000);
    assess();
    TEST_ASSERT_FALSE(safety.proposition.applies || safety.sharper.applies);
}

static void test_state_outside_its_range_is_promised_nothing(void) {
    begin_at(0.0);
    controller.model.present.level = BELT_REAL(-1);
    assess();
    assert_no_promise();
    begin_at(0.0);
    controller.model.present.congestion = BELT_REAL(NAN);
    assess();
    assert_all_finite();
    TEST_ASSERT_FALSE(safety.proposition.holds || safety.sharper.holds);
}

static void test_flux_without_bound_is_the_greatest_number(void) {
    begin_at(0.0);
    controller.model.present.disturbance_flux = -BELT_REAL_MAX * BELT_REAL(2);
    assess();
    assert_all_finite();
}

static void test_belt_that_grows_anywhere_is_promised_nothing(void) {
    config.loss_count = 2;
    config.loss_rate[1] = BELT_REAL(-0.01);
    begin_at(0.0);
    assess();
    assert_no_promise();
    config.loss_rate[1] = BELT_REAL(0);
    begin_at(0.0);
    assess();
    TEST_ASSERT_TRUE(safety.sharper.applies);
}

static void test_negative_density_anywhere_is_promised_nothing(void) {
    run_for(250u);
    const uint32_t count = controller.model.line.node_count;
    for (uint32_t i = 0; i <= count; ++i) {
        const uint32_t cell =
            belt_observer_behind(&controller.model.line, controller.model.observer.outlet, i);
        const belt_real_t well = controller.model.observer.density[cell];
        controller.model.observer.density[cell] = BELT_REAL(-0.01);
        assess();
        TEST_ASSERT_FALSE(safety.proposition.applies);
        assert_no_promise();
        controller.model.observer.density[cell] = well;
    }
    assess();
    TEST_ASSERT_TRUE(safety.proposition.applies);
}

static void test_densest_side_of_a_cut_is_looked_at(void) {
    begin_at(0.0);
    controller.model.observer.density[5] = BELT_REAL(1);
    controller.model.observer.cut[5] = BELT_REAL(0.25);
    controller.model.observer.step[5] = BELT_REAL(-2); /* 2.5 outlet-side, 0.5 behind the cut */
    assess();
    const double growth = exp(2.0 * 0.1 * 4.0 * 0.25 * 1.2);
    assert_near(2.5 * growth, (double)safety.proposition.density_max, 20.0 * EPSILON);
    controller.model.observer.step[5] = BELT_REAL(2); /* -0.5, 1.5 */
    assess();
    assert_near(1.5 * growth, (double)safety.proposition.density_max, 20.0 * EPSILON);
}

static void test_numbers_are_finite_whatever_bits_the_state_holds(void) {
    static belt_controller_t well;
    static const size_t unsealed[] = {offsetof(belt_controller_t, model.observer),
                                      offsetof(belt_controller_t, model.present),
                                      offsetof(belt_controller_t, model.history.level)};
    static const size_t size[] = {sizeof(belt_observer_t), sizeof(belt_present_t),
                                  sizeof well.model.history.level};
    uint64_t random = 0x5AFE7Bu;
    run_for(300u);
    well = controller;
    for (int i = 0; i < 20000; ++i) {
        controller = well;
        for (size_t k = (size_t)random_bits(&random) % 4u; k < 4u; ++k) {
            const size_t block = (size_t)random_bits(&random) % 3u;
            const size_t word = (size_t)random_bits(&random) % (size[block] / sizeof(uint32_t));
            const uint32_t bits = (uint32_t)random_bits(&random);
            memcpy((unsigned char *)&controller + unsealed[block] + word * sizeof bits, &bits,
                   sizeof bits);
        }
        memset(&safety, 0xA5, sizeof safety);
        (void)belt_safety_assess(&controller, &safety);
        assert_all_finite();
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_null_pointers_are_misuse);
    RUN_TEST(test_controller_that_is_not_running_is_promised_nothing);
    RUN_TEST(test_judging_changes_nothing_of_the_controller);
    RUN_TEST(test_restored_controller_is_judged_before_its_first_step_as_it_was);
    RUN_TEST(test_predictor_that_holds_the_congestion_is_promised_nothing);
    RUN_TEST(test_full_buffer_is_promised_nothing);
    RUN_TEST(test_belt_that_will_overfill_the_buffer_is_promised_nothing);
    RUN_TEST(test_material_that_overfills_the_buffer_as_the_last_is_promised_nothing);
    RUN_TEST(test_state_outside_its_range_is_promised_nothing);
    RUN_TEST(test_flux_without_bound_is_the_greatest_number);
    RUN_TEST(test_belt_that_grows_anywhere_is_promised_nothing);
    RUN_TEST(test_negative_density_anywhere_is_promised_nothing);
    RUN_TEST(test_densest_side_of_a_cut_is_looked_at);
    RUN_TEST(test_numbers_are_finite_whatever_bits_the_state_holds);
    return UNITY_END();
}
