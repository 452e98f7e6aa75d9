/* SPDX-License-Identifier: MIT */
/* Every part that is fed stays a part, and a jump stays a jump. */
#include "observer_case.h"

void setUp(void) {
    set_up_case();
}

void tearDown(void) {
}

/* --- conservation of mass: no loss, no rework --- */

static void test_every_part_fed_lies_on_the_belt_or_has_left(void) {
    /* Travel of halves and wholes and densities in eighths: every operation is exact, so is the
     * balance, bit for bit. */
    uint64_t random = 11u;
    double balance = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const double travel = ((random_bits(&random) & 64u) != 0u) ? 0.5 : 1.0;
        const double fed = (double)((random_bits(&random) >> 20) & 15u) / 8.0;
        advance(travel, fed);
        balance += travel * (fed - left());
        TEST_ASSERT_TRUE(balance == on_belt());
    }
}

static void test_mass_is_kept_whatever_the_travel(void) {
    uint64_t random = 12u;
    long double balance = 0.0L;
    double through = 0.0;
    for (int i = 0; i < 5000; ++i) {
        const double travel = 0.02 + 0.9 * (double)random_share(&random);
        const double fed = 2.0 * (double)random_share(&random);
        advance(travel, fed);
        balance += (long double)BELT_REAL(travel) * ((long double)BELT_REAL(fed) - left());
        through += travel * fed;
        /* Each part is rounded six times while its cell is filled and emptied, at random: the sum
         * of all stays below one rounding of all that went through. */
        TEST_ASSERT_DOUBLE_WITHIN(EPSILON * (20.0 + through), (double)balance, on_belt());
    }
}

static void test_mass_is_kept_on_an_odd_number_of_cells(void) {
    uint64_t random = 13u;
    config.node_count = 7;
    begin();
    double balance = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double travel = ((random_bits(&random) & 64u) != 0u) ? 0.5 : 1.0;
        const double fed = (double)((random_bits(&random) >> 20) & 15u) / 8.0;
        advance(travel, fed);
        balance += travel * (fed - left());
        TEST_ASSERT_TRUE(balance == on_belt());
    }
}

static void test_constant_feed_leaves_as_it_was_fed(void) {
    for (int i = 0; i < 1000; ++i) {
        advance(0.173, 0.75);
        if (i * 0.173 > 21.0) {
            /* Mean over a piece 0.173 wide: roundings of the cell count 1/0.173 times as much. */
            TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON, 0.75, left());
        }
    }
}

static void test_empty_belt_fed_with_nothing_stays_empty(void) {
    for (int i = 0; i < 100; ++i) {
        advance(0.3, 0.0);
        TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(0));
        TEST_ASSERT_TRUE(on_belt() == 0.0);
    }
}

/* --- jumps --- */

/** A feed that jumps after `before` periods: what leaves must be that feed, one belt later, for
 * every period. */
static void assert_jump_arrives_sharp(double travel, int before) {
    belt_observer_init(&observer);
    const double t = (double)BELT_REAL(travel);
    const double jump = t * before + (double)config.node_count;
    for (int i = 0; (i - 2) * t < jump; ++i) {
        advance(travel, (i < before) ? 0.25 : 1.0);
        /* Share of this period's travel that is behind the jump, or behind the first part fed. */
        const double behind = fmin(1.0, fmax(0.0, ((i + 1) * t - jump) / t));
        const double behind_first =
            fmin(1.0, fmax(0.0, ((i + 1) * t - (double)config.node_count) / t));
        const double truth = 0.25 * behind_first + 0.75 * behind;
        /* The belt's way is a sum of up to 20/travel roundings of a cell, and counts 1/travel. */
        TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON * 20.0 / (t * t), truth, left());
    }
}

static void test_jump_stays_sharp_and_leaves_one_belt_later(void) {
    const double travels[] = {1.0, 0.5, 0.25, 0.125, 0.1, 0.3, 0.37, 0.71};
    for (size_t i = 0; i < sizeof travels / sizeof travels[0]; ++i) {
        for (int before = 30; before < 50; ++before) {
            const double place = fmod(before * travels[i], 1.0);
            if ((place > 0.001) && (place < 0.98)) { /* else it counts as the cell's end */
                assert_jump_arrives_sharp(travels[i], before);
            }
        }
    }
}

static void test_jump_before_the_belt_is_full_stays_sharp_too(void) {
    /* Both the first part fed and the jump a few cells on. */
    for (int before = 6; before < 30; ++before) {
        assert_jump_arrives_sharp(0.25, before);
    }
}

static void test_of_two_jumps_in_a_cell_the_mass_stays(void) {
    double fed = 0.0;
    for (int i = 0; i < 8; ++i) {
        const double density = ((i == 2) || (i == 5)) ? 1.0 : 0.5;
        advance(0.125, density);
        fed += 0.125 * density;
    }
    TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, fed, on_belt());
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_every_part_fed_lies_on_the_belt_or_has_left);
    RUN_TEST(test_mass_is_kept_whatever_the_travel);
    RUN_TEST(test_mass_is_kept_on_an_odd_number_of_cells);
    RUN_TEST(test_constant_feed_leaves_as_it_was_fed);
    RUN_TEST(test_empty_belt_fed_with_nothing_stays_empty);
    RUN_TEST(test_jump_stays_sharp_and_leaves_one_belt_later);
    RUN_TEST(test_jump_before_the_belt_is_full_stays_sharp_too);
    RUN_TEST(test_of_two_jumps_in_a_cell_the_mass_stays);
    return UNITY_END();
}
