/* SPDX-License-Identifier: MIT */
#include "belt/observer.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_line_t line;
static belt_observer_t observer;

static void begin(void) {
    belt_line_init(&line, &config);
    belt_observer_init(&observer);
}

/* The finest line of these tests; the presets have room for it. */
#define CELLS_NEEDED 40

void setUp(void) {
    TEST_ASSERT_TRUE_MESSAGE(BELT_NODE_CAPACITY >= CELLS_NEEDED, "build with a preset");
    config = paper_case();
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
    begin();
}

void tearDown(void) {
}

/** One period of a line on which a spacing takes `pace` seconds. */
static void advance_at(double pace, double travel, double fed) {
    belt_passage_t passage = {.fed_density = BELT_REAL(fed), .travel = BELT_REAL(travel)};
    passage.duration = BELT_REAL(pace * travel);
    belt_observer_advance(&observer, &line, &passage);
}

static void advance(double travel, double fed) {
    advance_at(0.025, travel, fed);
}

/** The same, with a measured outlet. */
static void advance_measured(double pace, double travel, double fed, double left) {
    belt_passage_t passage = {.fed_density = BELT_REAL(fed), .travel = BELT_REAL(travel)};
    passage.duration = BELT_REAL(pace * travel);
    passage.left_density = BELT_REAL(left);
    passage.left_is_measured = true;
    belt_observer_advance(&observer, &line, &passage);
}

/** Cell `i` from the outlet; cell node_count is the open one. */
static double cell(uint32_t i) {
    return (double)observer.density[belt_observer_behind(&line, observer.outlet, i)];
}

/** Parts on the belt, in units of density times spacing. */
static double on_belt(void) {
    const double gone = (double)observer.gone;
    double sum = (1.0 - gone) * (double)belt_observer_rest_of_outlet(&observer);
    for (uint32_t i = 1; i < line.node_count; ++i) {
        sum += cell(i);
    }
    return sum + gone * cell(line.node_count);
}

/** Cells that hold anything: an open cell of no width does not. */
static uint32_t last_cell(void) {
    return (observer.gone > BELT_REAL(0)) ? line.node_count : line.node_count - 1u;
}

/** Where the centre of cell `i` is [spacings from the outlet]; the open cell's filled part is
 * `gone` wide. */
static double centre(uint32_t i) {
    const double gone = (double)observer.gone;
    return (i < line.node_count) ? (double)i + 0.5 - gone : (double)i - 0.5 * gone;
}

static double left(void) {
    return (double)observer.outlet_density;
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

/* --- loss --- */

/** Density leaving, after the belt has filled with `fed` at a constant pace. */
static double leaving_after_filling(double pace, double travel, double fed) {
    for (int i = 0; i * travel < 2.0 * config.node_count + 2.0; ++i) {
        advance_at(pace, travel, fed);
    }
    return left();
}

/** What the survival series falls short by: loss^4/24 for each of the ways, at most a period or half
 * a cell long. */
static double series_error(double loss, double ways) {
    return ways * loss * loss * loss * loss / 24.0;
}

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

/* --- rework --- */

/** Fills the belt with nothing but rework of a measured outlet density of 0.5. A material piece at x
 * then has picked up A*v*slowness*(D - x)^2/2, in spacings rework_per_spacing*v*pace*(20 - place)^2/2;
 * the midpoint rule is exact for it. */
static void assert_rework_of_a_known_outlet(double travel) {
    config.rework_rate = BELT_REAL(0.3);
    begin();
    for (int k = 0; k * travel < 24.35; ++k) {
        advance_measured(0.025, travel, 0.0, 0.5);
    }
    for (uint32_t k = 1; k <= last_cell(); ++k) {
        const double way = 20.0 - centre(k);
        const double truth = 0.3 * 2.0 / 20.0 * 0.5 * 0.025 * 0.5 * way * way;
        /* 20/travel sums of numbers up to 0.075: a rounding of that each. */
        TEST_ASSERT_DOUBLE_WITHIN(20.0 / travel * EPSILON * 0.075, truth, cell(k));
    }
}

static void test_rework_of_a_known_outlet_density(void) {
    assert_rework_of_a_known_outlet(1.0);
    assert_rework_of_a_known_outlet(0.5);
    assert_rework_of_a_known_outlet(0.125);
}

static void test_rework_goes_on_while_a_cell_closes_within_a_period(void) {
    assert_rework_of_a_known_outlet(0.3);
    assert_rework_of_a_known_outlet(0.71);
}

static void test_rework_with_loss(void) {
    /* After time a on the belt: A*v*w*(a/C - (1 - exp(-C*a))/C^2), w the speed. */
    config.rework_rate = BELT_REAL(0.3);
    config.loss_rate[0] = BELT_REAL(1.5);
    double worst[2] = {0.0, 0.0};
    for (int fine = 0; fine < 2; ++fine) {
        config.node_count = (uint16_t)(20 << fine);
        begin();
        const double pace = 0.5 / config.node_count;
        for (int k = 0; k * 0.5 < 1.2 * config.node_count; ++k) {
            advance_measured(pace, 0.5, 0.0, 0.5);
        }
        for (uint32_t k = 1; k < line.node_count; ++k) {
            const double age = pace * (config.node_count - centre(k));
            const double truth = 0.3 * 0.5 * 4.0 * (age / 1.5 + expm1(-1.5 * age) / (1.5 * 1.5));
            worst[fine] = fmax(worst[fine], fabs(cell(k) - truth));
        }
    }
    /* The rework of a period, up to 0.3*0.5*2*0.0125, keeps half its loss of 0.01875, to the square
     * of that; 40 times. Twice as fine: a quarter, or roundings. */
    TEST_ASSERT_TRUE(worst[0] < 40.0 * 0.00375 * 0.01875 * 0.01875 + 40 * EPSILON);
    TEST_ASSERT_TRUE(worst[1] < 0.3 * worst[0] + 80 * EPSILON);
}

static void test_rework_comes_from_the_belts_own_outlet_too(void) {
    /* Known after each period as outlet_density: the balance in + rework = out + change closes. Each
     * whole cell gains A*(D - x)*v*time. */
    config.rework_rate = BELT_REAL(0.3);
    begin();
    (void)leaving_after_filling(0.025, 0.5, 0.8);
    const double before = on_belt();
    advance(0.5, 0.8);
    /* Over all of the belt: A*D*v*time*20/2, while half a spacing is exchanged. */
    const double gained = 0.6 * left() * 0.0125 * 10.0;
    /* The outlet cell is aged ahead of its centre by up to half a cell, and the open one's centre
     * behind: a quarter of a spacing's rework, v*0.6*0.025/4, either end. */
    TEST_ASSERT_DOUBLE_WITHIN(2.0 * 0.25 * 0.6 * 0.025 * left(), 0.5 * (0.8 - left()) + gained,
                              on_belt() - before);
}

static void test_belt_at_rest_in_the_papers_case_leaves_what_holds_the_setpoint(void) {
    config = paper_case();
    begin();
    const rest_t rest = line_at_rest(&config);
    const double pace = rest.slowness * 0.1;
    const double fed = rest.inlet_flux * rest.slowness;
    for (int i = 0; i < 5000; ++i) { /* the loop through the rework settles in a few transits */
        advance_at(pace, 0.37, fed);
    }
    for (int i = 0; i < 100; ++i) { /* wherever in a cell the outlet is */
        advance_at(pace, 0.37, fed);
        /* Second order in the rework of a spacing, A*D*pace = 0.0053, and in its loss, 0.0265:
         * their product, of the density. */
        TEST_ASSERT_DOUBLE_WITHIN(0.0053 * 0.0265 * 0.159 + 800 * EPSILON * 0.159,
                                  rest.outlet_density, left());
    }
}

/* --- the outlet --- */

static void test_measured_outlet_replaces_the_observers_own(void) {
    (void)leaving_after_filling(0.025, 0.3, 0.8);
    advance_measured(0.025, 0.3, 0.8, 0.125);
    TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(0.125));
    advance(0.3, 0.8);
    TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON, 0.8, left());
}

static void test_measured_outlet_that_is_not_to_be_used_is_not(void) {
    (void)leaving_after_filling(0.025, 0.3, 0.8);
    belt_passage_t passage = {.duration = BELT_REAL(0.0075),
                              .travel = BELT_REAL(0.3),
                              .fed_density = BELT_REAL(0.8),
                              .left_density = BELT_REAL(0.125)};
    belt_observer_advance(&observer, &line, &passage);
    TEST_ASSERT_DOUBLE_WITHIN(16 * EPSILON, 0.8, left());
}

static void test_rest_of_the_outlet_cell_is_what_its_two_sides_leave(void) {
    /* Profile 1 at the outlet, 0 one spacing on: sides 0.75 and 0.25. Travel in eighths. */
    belt_real_t density[BELT_NODE_CAPACITY + 1] = {BELT_REAL(1)};
    belt_observer_assume(&observer, &line, density);
    const double rests[] = {0.5,
                            (0.375 * 0.75 + 0.5 * 0.25) / 0.875,
                            (0.25 * 0.75 + 0.5 * 0.25) / 0.75,
                            (0.125 * 0.75 + 0.5 * 0.25) / 0.625,
                            0.25,
                            0.25,
                            0.25,
                            0.25};
    for (int i = 0; i < 8; ++i) {
        /* Division and three roundings. */
        TEST_ASSERT_DOUBLE_WITHIN(4 * EPSILON, rests[i],
                                  (double)belt_observer_rest_of_outlet(&observer));
        advance(0.125, 0.0);
        TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, (i < 4) ? 0.75 : 0.25, left());
    }
}

/* --- a known profile --- */

static void test_assumed_profile_lies_on_the_belt_by_trapezoids(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    double trapezoids = 0.0;
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL((double)((i * 7u) % 5u) * 0.25);
        trapezoids += (double)density[i] * (((i == 0u) || (i == line.node_count)) ? 0.5 : 1.0);
    }
    belt_observer_assume(&observer, &line, density);
    TEST_ASSERT_TRUE(on_belt() == trapezoids); /* quarters: exact */
    for (uint32_t i = 0; i < line.node_count; ++i) {
        TEST_ASSERT_TRUE(cell(i) == 0.5 * ((double)density[i] + (double)density[i + 1u]));
    }
}

static void test_assumed_ramp_leaves_as_a_ramp(void) {
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL(0.05 * i);
    }
    belt_observer_assume(&observer, &line, density);
    for (int i = 0; i < 40; ++i) {
        advance(0.5, 0.0);
        /* The mean of each half cell; rounded at 1, divided by 0.5. */
        TEST_ASSERT_DOUBLE_WITHIN(8 * EPSILON, 0.05 * (0.5 * i + 0.25), left());
    }
    advance(0.5, 0.0);
    TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(0));
}

static void test_assumed_profile_replaces_all_that_was_known(void) {
    static belt_observer_t fresh;
    belt_real_t density[BELT_NODE_CAPACITY + 1];
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        density[i] = BELT_REAL(0.5);
    }
    belt_observer_init(&fresh);
    belt_observer_assume(&fresh, &line, density);
    for (int i = 0; i < 77; ++i) {
        advance(0.3, 0.1 * i);
    }
    belt_observer_assume(&observer, &line, density);
    for (int i = 0; i < 100; ++i) {
        const belt_real_t used = observer.outlet_density;
        TEST_ASSERT_TRUE(used == fresh.outlet_density);
        belt_passage_t passage = {.duration = BELT_REAL(0.0075),
                                  .travel = BELT_REAL(0.3),
                                  .fed_density = BELT_REAL(0.25)};
        belt_observer_advance(&observer, &line, &passage);
        belt_observer_advance(&fresh, &line, &passage);
    }
}

/* --- nothing leaves its bounds --- */

static void test_line_that_runs_away_stays_finite(void) {
    config.rework_rate = BELT_REAL(4); /* twice of what leaves comes back: no rule would have it */
    begin();
    for (int i = 0; i < 40000; ++i) {
        advance(0.5, 1.0);
        TEST_ASSERT_TRUE(observer.outlet_density >= BELT_REAL(0));
        TEST_ASSERT_TRUE(observer.outlet_density <= line.density_bound);
    }
    TEST_ASSERT_TRUE(observer.outlet_density >= BELT_HALF * line.density_bound);
}

static void test_outlet_density_that_is_no_number_is_none_at_all(void) {
    advance_measured(0.025, 0.5, 1.0, (double)NAN);
    TEST_ASSERT_TRUE(observer.outlet_density == BELT_REAL(0));
}

static void test_neither_side_of_a_cut_is_below_zero(void) {
    uint64_t state = 20260101u;
    for (int i = 0; i < 20000; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        advance(0.03 + 0.4 * (double)(state >> 40) / (double)(1 << 24),
                (double)((state >> 33) & 1u));
        TEST_ASSERT_TRUE(observer.outlet_density >= BELT_REAL(0));
        TEST_ASSERT_TRUE(belt_observer_rest_of_outlet(&observer) >= -BELT_REAL(EPSILON));
    }
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
    RUN_TEST(test_uniform_loss_is_exponential);
    RUN_TEST(test_loss_does_not_depend_on_where_in_a_cell_the_outlet_is);
    RUN_TEST(test_cells_hold_the_density_of_their_centre);
    RUN_TEST(test_loss_profile_is_the_exponential_of_its_integral);
    RUN_TEST(test_profile_of_equal_values_is_the_uniform_loss_bit_for_bit);
    RUN_TEST(test_profile_of_nearly_equal_values_is_close_to_the_uniform_loss);
    RUN_TEST(test_rework_of_a_known_outlet_density);
    RUN_TEST(test_rework_goes_on_while_a_cell_closes_within_a_period);
    RUN_TEST(test_rework_with_loss);
    RUN_TEST(test_rework_comes_from_the_belts_own_outlet_too);
    RUN_TEST(test_belt_at_rest_in_the_papers_case_leaves_what_holds_the_setpoint);
    RUN_TEST(test_measured_outlet_replaces_the_observers_own);
    RUN_TEST(test_measured_outlet_that_is_not_to_be_used_is_not);
    RUN_TEST(test_rest_of_the_outlet_cell_is_what_its_two_sides_leave);
    RUN_TEST(test_assumed_profile_lies_on_the_belt_by_trapezoids);
    RUN_TEST(test_assumed_ramp_leaves_as_a_ramp);
    RUN_TEST(test_assumed_profile_replaces_all_that_was_known);
    RUN_TEST(test_line_that_runs_away_stays_finite);
    RUN_TEST(test_outlet_density_that_is_no_number_is_none_at_all);
    RUN_TEST(test_neither_side_of_a_cut_is_below_zero);
    return UNITY_END();
}
