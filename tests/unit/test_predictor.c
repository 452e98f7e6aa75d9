/* SPDX-License-Identifier: MIT */
#include "belt/predictor.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_line_t line;
static belt_level_history_t history;
static belt_observer_t observer;
static belt_present_t present;
static belt_prediction_t prediction;

/* --- what lies on the belt, and the levels before now --- */

static double nothing(double x) {
    (void)x;
    return 0.0;
}

static double half(double x) {
    (void)x;
    return 0.5;
}

static double wave(double x) {
    return 0.3 + 0.2 * sin(3.0 * x);
}

static double level_constant(double ago) {
    (void)ago;
    return 0.4;
}

static double level_falling(double ago) {
    return 0.4 + 0.3 * ago;
}

static double level_setpoint(double ago) {
    (void)ago;
    return (double)config.level_setpoint;
}

typedef double profile_t(double);

/** Lays density [over x] on the belt, levels [over time before now] into the window. */
static void lay(profile_t *density, profile_t *level) {
    belt_real_t nodes[BELT_NODE_CAPACITY + 1];
    belt_line_init(&line, &config);
    for (uint32_t i = 0; i <= line.node_count; ++i) {
        nodes[i] = BELT_REAL(density((double)line.spacing * i));
    }
    belt_observer_init(&observer);
    belt_observer_assume(&observer, &line, nodes);
    belt_level_history_init(&history, &config);
    for (uint32_t i = history.length; i > 0u; --i) {
        belt_level_history_push(&history, BELT_REAL(level((double)config.period * (i - 1u))));
    }
    present.level = BELT_REAL(level(0.0));
    present.congestion = belt_level_history_congestion(&history);
}

static void march(void) {
    memset(&prediction, 0xFF, sizeof prediction);
    belt_predictor_march(&prediction, &line, &history, &observer, &present, config.prediction);
}

/* The finest line of these tests; the presets have room for it. */
#define CELLS_NEEDED 161

void setUp(void) {
    TEST_ASSERT_TRUE_MESSAGE(BELT_NODE_CAPACITY >= CELLS_NEEDED, "build with a preset");
    config = paper_case();
}

void tearDown(void) {
}

static void forget_loss_and_rework(void) {
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
}

/** No congestion to speak of: P*D = 0.5 s of dead time. */
static void hold_speed(void) {
    config.congestion_scale = BELT_REAL(1e6);
}

/* A march's roundings: ten of each number for every cell. And what hold_speed() leaves of congestion:
 * up to 0.1 of a millionth. */
static double rounding(void) {
    const double slowed = 0.1 / (double)config.congestion_scale;
    return 10.0 * EPSILON * config.node_count + ((slowed < 1e-6) ? slowed : 0.0);
}

/* --- the future by the equations as the paper prints them (MF3)-(MF7): sums within sums, in double,
 * on its own fine grid --- */

#define FINE 800

typedef struct {
    double level;
    double arrival;
    double congestion;
    double survival;
    double rework;
} future_t;

static struct {
    double level[FINE + 1];
    double arrival[FINE + 1];
    double slowness[FINE];
    double outlet_density[FINE];
} fine;

static double loss_at(double x) {
    if (config.loss_count == 1) {
        return (double)config.loss_rate[0];
    }
    const double place = x / (double)config.belt_length * (config.loss_count - 1);
    const int piece = (int)fmin(place, config.loss_count - 2);
    const double from = (double)config.loss_rate[piece];
    return from + (place - piece) * ((double)config.loss_rate[piece + 1] - from);
}

static double service(double level) {
    return fmin(level / (double)config.service_time, (double)config.service_rate_max);
}

static double level_then(profile_t *past, int count, double time) {
    if (time <= 0.0) {
        return past(-time);
    }
    int i = count;
    while ((i > 0) && (fine.arrival[i] > time)) {
        --i;
    }
    if (i == count) {
        return fine.level[count];
    }
    return fine.level[i] + (fine.level[i + 1] - fine.level[i]) * (time - fine.arrival[i]) /
                               (fine.arrival[i + 1] - fine.arrival[i]);
}

/** Material at x moves on while the fine cells `count` - 1 ... 0 leave; `exponent` and `gained` are of
 * the way after those. */
static void look_back(future_t *future, int count, double x, double exponent, double gained) {
    const double dx = (double)config.belt_length / FINE;
    for (int i = count - 1; i >= 0; --i) {
        const double place = x - (i + 0.5) * dx;
        const double time = fine.slowness[i] * dx;
        const double loss = loss_at(place) * time;
        gained += (double)config.rework_rate * ((double)config.belt_length - place) *
                  fine.outlet_density[i] * time * exp(-exponent - 0.5 * loss);
        exponent += loss;
    }
    future->survival = exp(-exponent);
    future->rework = gained;
}

static future_t future_of(profile_t *density, profile_t *past) {
    const double dx = (double)config.belt_length / FINE;
    const double alpha = (double)config.connectivity;
    const double tau = (double)config.speed_window;
    const double slope = (double)config.processing_time / (double)config.congestion_scale;
    double congestion = 0.0;
    for (int i = 0; i < 1000; ++i) {
        congestion += past(tau * (i + 0.5) / 1000.0) * tau / 1000.0;
    }
    double slowness = (double)config.processing_time + slope * congestion;
    future_t future = {0};
    fine.level[0] = past(0.0);
    fine.arrival[0] = 0.0;
    for (int i = 0; i < FINE; ++i) {
        const double level = fine.level[i];
        const double tail = level_then(past, i, fine.arrival[i] + 0.5 * dx * slowness - tau);
        const double s = slowness * (1.0 + 0.5 * dx * slope * (level - tail));
        const double x = (i + 0.5) * dx;
        const double way = 0.5 * s * dx;
        const double before = (i > 0) ? fine.outlet_density[i - 1] : density(0.0);
        look_back(&future, i, x, loss_at(0.25 * dx) * way,
                  (double)config.rework_rate * ((double)config.belt_length - 0.25 * dx) * before *
                      way);
        const double p2 = future.survival * density(x) + future.rework;
        const double middle = level + 0.5 * dx * (alpha * p2 - service(level) * s);
        fine.slowness[i] = s;
        fine.outlet_density[i] = p2;
        fine.arrival[i + 1] = fine.arrival[i] + s * dx;
        fine.level[i + 1] = level + dx * (alpha * p2 - service(middle) * s);
        slowness += slope * (middle - tail) * s * dx;
    }
    look_back(&future, FINE, (double)config.belt_length, 0.0, 0.0);
    future.level = fine.level[FINE];
    future.arrival = fine.arrival[FINE];
    future.congestion = (slowness - (double)config.processing_time) / slope;
    return future;
}

/** The greatest difference between march and future, each of its own size. */
static double distance(const future_t *future) {
    double worst = fabs((double)prediction.inlet_level - future->level);
    worst = fmax(worst, fabs((double)prediction.inlet_arrival - future->arrival));
    worst = fmax(worst, fabs((double)prediction.inlet_congestion - future->congestion));
    worst = fmax(worst, fabs((double)prediction.inlet_survival - future->survival));
    return fmax(worst, fabs((double)prediction.inlet_rework - future->rework));
}

static double error_on(uint16_t nodes, profile_t *density, profile_t *past) {
    config.node_count = nodes;
    lay(density, past);
    march();
    const future_t future = future_of(density, past);
    return distance(&future);
}

/* --- exact special cases --- */

static void test_empty_line_takes_its_shortest_dead_time(void) {
    lay(nothing, nothing);
    march();
    TEST_ASSERT_TRUE(prediction.inlet_level == BELT_REAL(0));
    TEST_ASSERT_TRUE(prediction.inlet_rework == BELT_REAL(0));
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.5, (double)prediction.inlet_arrival);
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.25, (double)prediction.inlet_slowness);
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.0, (double)prediction.inlet_congestion);
}

static void test_level_of_an_empty_belt_decays(void) {
    hold_speed();
    lay(nothing, level_constant);
    march();
    /* exp(-0.5); midpoint steps of 0.05 s: h^2/6 of the level for every second. */
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 6.0 * 0.5 * 0.4 + rounding(), 0.4 * exp(-0.5),
                              (double)prediction.inlet_level);
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.5, (double)prediction.inlet_arrival);
}

static void test_full_service_takes_parts_at_its_greatest_rate(void) {
    hold_speed();
    config.service_rate_max = BELT_REAL(0.2);
    lay(nothing, level_constant);
    march();
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.4 - 0.2 * 0.5, (double)prediction.inlet_level);
}

static void test_at_constant_speed_without_loss_the_march_is_the_smith_predictor(void) {
    hold_speed();
    forget_loss_and_rework();
    lay(half, level_constant);
    march();
    /* Q' = alpha*omega*rho - Q = 1 - Q for 0.5 s. */
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 6.0 * 0.5 * 0.6 + rounding(), 1.0 - 0.6 * exp(-0.5),
                              (double)prediction.inlet_level);
    TEST_ASSERT_TRUE(prediction.inlet_survival == BELT_REAL(1));
    TEST_ASSERT_TRUE(prediction.inlet_rework == BELT_REAL(0));
    for (uint32_t i = 0; i < prediction.count; ++i) {
        if (prediction.width[i] > BELT_REAL(0)) { /* nothing leaves with a stretch of no width */
            TEST_ASSERT_DOUBLE_WITHIN(rounding(), 0.5, (double)prediction.outlet_density[i]);
        }
    }
}

static void test_without_service_the_level_gains_every_part_on_the_belt(void) {
    hold_speed();
    forget_loss_and_rework();
    config.service_time = BELT_REAL(1e6);
    for (uint16_t nodes = 20; nodes <= 21; ++nodes) {
        config.node_count = nodes;
        lay(wave, nothing);
        double parts = 0.0;
        for (uint32_t i = 0; i < line.node_count; ++i) {
            parts += 0.5 * (double)line.spacing *
                     (wave((double)line.spacing * i) + wave((double)line.spacing * (i + 1u)));
        }
        march();
        /* In 0.5 s a millionth of a level of 0.3 is served. */
        TEST_ASSERT_DOUBLE_WITHIN(rounding() + 2e-7, 0.5 * parts, (double)prediction.inlet_level);
    }
}

static void test_jumps_between_the_cells_of_a_pair_are_met_to_second_order(void) {
    hold_speed();
    forget_loss_and_rework();
    for (int first = 0; first <= 1; ++first) {
        lay(nothing, level_constant);
        belt_passage_t passage = {.travel = BELT_REAL(1), .duration = BELT_REAL(0.025)};
        double level = 0.4;
        for (int i = 0; i < 20; ++i) { /* every other cell full; each lasts 0.025 s */
            const double density = ((i + first) % 2 == 0) ? 1.0 : 0.0;
            passage.fed_density = BELT_REAL(density);
            belt_observer_advance(&observer, &line, &passage);
            level = 2.0 * density + (level - 2.0 * density) * exp(-0.025);
        }
        march();
        /* h^2/6 of the level's rate, up to 2, for a pair of 0.05 s. */
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 6.0 * 0.5 * 2.0 + rounding(), level,
                                  (double)prediction.inlet_level);
    }
}

static void test_survival_at_constant_speed_is_exponential(void) {
    hold_speed();
    lay(nothing, nothing);
    march();
    /* Series over halves of 0.025: 40*0.0125^4/24. */
    TEST_ASSERT_DOUBLE_WITHIN(5e-8 + rounding(), exp(-0.5), (double)prediction.inlet_survival);
}

/** Settles the belt at rest by feeding it, until the outlet is `gone` into a cell. */
static rest_t settle(double travel, int more) {
    const rest_t rest = line_at_rest(&config);
    lay(nothing, level_setpoint);
    const double pace = rest.slowness * (double)line.spacing;
    belt_passage_t passage = {.travel = BELT_REAL(travel), .duration = BELT_REAL(travel * pace)};
    passage.fed_density = BELT_REAL(rest.inlet_flux * rest.slowness);
    passage.left_is_measured = true; /* the observer's own loop has its own tests */
    passage.left_density = BELT_REAL(rest.outlet_density);
    for (int i = 0; i < (int)(2.0 * config.node_count / travel) + more; ++i) {
        belt_observer_advance(&observer, &line, &passage);
    }
    return rest;
}

static void assert_rest_predicts_itself(const rest_t *rest) {
    /* Second order in the loss of a spacing, C*dwell: its square, of each number. */
    const double dwell = rest->dead_time / config.node_count * (double)config.loss_rate[0];
    const double part = dwell * dwell + rounding();
    const double survival = exp(-rest->dead_time * (double)config.loss_rate[0]);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.3, 0.3, (double)prediction.inlet_level);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.53, rest->dead_time, (double)prediction.inlet_arrival);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.265, rest->slowness, (double)prediction.inlet_slowness);
    TEST_ASSERT_DOUBLE_WITHIN(part, rest->congestion, (double)prediction.inlet_congestion);
    TEST_ASSERT_DOUBLE_WITHIN(part, survival, (double)prediction.inlet_survival);
    TEST_ASSERT_DOUBLE_WITHIN(part * 0.159,
                              rest->outlet_density - survival * rest->inlet_flux * rest->slowness,
                              (double)prediction.inlet_rework);
    for (uint32_t i = 0; i < prediction.count; ++i) {
        if (prediction.width[i] > BELT_REAL(0)) { /* nothing leaves with a stretch of no width */
            TEST_ASSERT_DOUBLE_WITHIN(part * 0.159, rest->outlet_density,
                                      (double)prediction.outlet_density[i]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(part * 0.3, 0.3, (double)prediction.level[i + 1u]);
    }
}

static void test_line_at_rest_predicts_itself(void) {
    for (uint16_t nodes = 19; nodes <= 22; ++nodes) {
        config.node_count = nodes;
        const rest_t rest = settle(0.5, 2 * nodes % 2);
        march();
        assert_rest_predicts_itself(&rest);
    }
}

static void test_line_at_rest_predicts_itself_wherever_the_outlet_is_in_a_cell(void) {
    for (int more = 0; more < 40; ++more) { /* two cells, so both of a pair */
        const rest_t rest = settle(0.0625, more);
        march();
        assert_rest_predicts_itself(&rest);
    }
}

/* --- the shape of what the march hands on --- */

static void test_lines_and_stretches_add_up(void) {
    lay(wave, level_falling);
    for (int i = 0; i < 50; ++i) {
        belt_passage_t passage = {.travel = BELT_REAL(0.125),
                                  .duration = BELT_REAL(0.0034),
                                  .fed_density = BELT_REAL(0.25)};
        belt_observer_advance(&observer, &line, &passage);
        march();
        double width = 0.0;
        double time = 0.0;
        for (uint32_t k = 0; k < prediction.count; ++k) {
            TEST_ASSERT_DOUBLE_WITHIN(rounding(), time, (double)prediction.arrival[k]);
            width += (double)prediction.width[k];
            time += (double)prediction.width[k] * (double)prediction.pace[k];
        }
        TEST_ASSERT_DOUBLE_WITHIN(rounding() * 20.0, 20.0, width);
        TEST_ASSERT_DOUBLE_WITHIN(rounding(), time, (double)prediction.inlet_arrival);
        TEST_ASSERT_TRUE(prediction.level[0] == present.level);
        TEST_ASSERT_TRUE(prediction.level[prediction.count] == prediction.inlet_level);
        TEST_ASSERT_TRUE(prediction.arrival[prediction.count] == prediction.inlet_arrival);
    }
}

/* --- congestion and window --- */

static void test_held_congestion_keeps_the_pace(void) {
    config.prediction = BELT_HOLD_CONGESTION;
    config.speed_window = BELT_REAL(0.05);
    lay(wave, level_falling);
    march();
    const double pace = 0.25 * (1.0 + (double)present.congestion) * 0.1;
    for (uint32_t i = 0; i < prediction.count; ++i) {
        TEST_ASSERT_DOUBLE_WITHIN(rounding() * pace, pace, (double)prediction.pace[i]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), 20.0 * pace, (double)prediction.inlet_arrival);
    TEST_ASSERT_DOUBLE_WITHIN(rounding(), (double)present.congestion,
                              (double)prediction.inlet_congestion);
}

/** Integral of the predicted level over the window that ends at the last line. */
static double window_of_predicted_levels(void) {
    const double from = (double)prediction.inlet_arrival - (double)config.speed_window;
    double sum = 0.0;
    for (uint32_t i = 0; i < prediction.count; ++i) {
        const double start = (double)prediction.arrival[i];
        const double end = (double)prediction.arrival[i + 1u];
        const double first = fmax(start, from);
        if (end > first) {
            const double rise =
                ((double)prediction.level[i + 1u] - (double)prediction.level[i]) / (end - start);
            sum += (end - first) *
                   ((double)prediction.level[i] + rise * (0.5 * (first + end) - start));
        }
    }
    return sum;
}

static void test_window_that_slid_past_now_uses_predicted_levels_only(void) {
    const double windows[] = {0.02, 0.06, 0.2, 0.4};
    config.node_count = 80;
    for (size_t i = 0; i < sizeof windows / sizeof windows[0]; ++i) {
        config.speed_window = BELT_REAL(windows[i]);
        lay(wave, level_falling);
        march();
        TEST_ASSERT_TRUE((double)prediction.inlet_arrival > windows[i]);
        /* Trapezoids against midpoints: h^2/8 of Q'', h = 0.015 s, Q'' up to 8 for a wave of 0.2 at
         * 3*4/s; and the congestion is a difference of slownesses. */
        TEST_ASSERT_DOUBLE_WITHIN(0.015 * 0.015 + rounding(), window_of_predicted_levels(),
                                  (double)prediction.inlet_congestion);
    }
}

static void test_window_longer_than_the_dead_time_still_uses_recorded_levels(void) {
    config.speed_window = BELT_REAL(1);
    config.congestion_scale = BELT_REAL(10);
    config.node_count = 80;
    lay(wave, level_falling);
    march();
    const double recorded = 1.0 - (double)prediction.inlet_arrival;
    const double truth = recorded * level_falling(0.5 * recorded) + (window_of_predicted_levels());
    /* As above; the difference of slownesses counts ten times. */
    TEST_ASSERT_DOUBLE_WITHIN(0.015 * 0.015 + 10 * rounding(), truth,
                              (double)prediction.inlet_congestion);
}

static void test_level_that_leaves_the_window_at_the_inlet_is_told(void) {
    config.node_count = 80;
    lay(wave, level_constant);
    march();
    const double then = (double)prediction.inlet_arrival - 0.2;
    uint32_t i = 0;
    while ((double)prediction.arrival[i + 1u] < then) {
        ++i;
    }
    /* Taken in the middle of the last stretch, half of up to three spacings before the end. */
    const double slope = 2.0 * 4.0 * 0.25;
    TEST_ASSERT_DOUBLE_WITHIN(slope * 0.02, (double)prediction.level[i],
                              (double)prediction.inlet_tail);
}

/* --- against the equations as printed --- */

/** Second order: what is left falls with the square of the spacing, for odd and even counts alike. The
 * window's end passes a corner of the level, now, at some place in a stretch, so that the error jumps
 * up and down under this bound; measured are up to 0.092/N^2. Eight roundings. */
static void assert_error_falls_with_the_square(double factor, profile_t *density, profile_t *past) {
    const uint16_t counts[] = {20, 21, 40, 41, 80, 81, 160, 161};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
        const double nodes = counts[i];
        TEST_ASSERT_DOUBLE_WITHIN(factor / (nodes * nodes) + 8 * EPSILON, 0.0,
                                  error_on(counts[i], density, past));
    }
}

static void test_march_finds_the_future_of_the_equations(void) {
    assert_error_falls_with_the_square(0.1, wave, level_falling);
    assert_error_falls_with_the_square(0.1, wave, level_constant);
}

static void test_march_finds_the_future_of_a_long_and_of_a_short_window(void) {
    config.speed_window = BELT_REAL(3); /* congestion itself is up to 1; measured 0.176/N^2 */
    assert_error_falls_with_the_square(0.2, wave, level_constant);
    config.speed_window = BELT_REAL(0.1);
    assert_error_falls_with_the_square(0.1, wave, level_constant);
}

static void test_march_finds_the_future_of_a_loss_profile(void) {
    config.loss_count = 3;
    config.loss_rate[0] = BELT_REAL(0.5);
    config.loss_rate[1] = BELT_REAL(2);
    config.loss_rate[2] = BELT_REAL(1);
    assert_error_falls_with_the_square(0.1, wave, level_falling);
}

static void test_march_finds_the_future_of_much_rework(void) {
    config.rework_rate = BELT_REAL(0.8);
    config.loss_rate[0] = BELT_REAL(0.3);
    assert_error_falls_with_the_square(0.1, wave, level_constant);
}

/** At constant speed there is no corner, and the error is smooth: level, survival, rework. */
static double error_at_constant_speed(uint16_t nodes) {
    config.node_count = nodes;
    lay(wave, level_constant);
    march();
    const future_t future = future_of(wave, level_constant);
    return fabs((double)prediction.inlet_level - future.level) +
           fabs((double)prediction.inlet_rework - future.rework);
}

static void test_half_the_spacing_leaves_a_quarter_of_the_error(void) {
    hold_speed();
    config.rework_rate = BELT_REAL(0.8);
    for (uint16_t coarse = 10; coarse <= 20; coarse = (uint16_t)(coarse * 2)) {
        const double before = error_at_constant_speed(coarse);
        const double after = error_at_constant_speed((uint16_t)(2 * coarse));
        /* A tenth for what is of higher order, and eight roundings. */
        TEST_ASSERT_DOUBLE_WITHIN(0.1 * 0.25 * before + 8 * EPSILON, 0.25 * before, after);
        TEST_ASSERT_TRUE(before > 1e-5); /* or there was nothing to divide */
    }
}

static void test_odd_and_even_node_counts_agree_to_second_order(void) {
    for (uint16_t nodes = 20; nodes <= 160; nodes = (uint16_t)(nodes * 2)) {
        config.node_count = (uint16_t)(nodes + 1);
        lay(wave, level_falling);
        march();
        const double odd = (double)prediction.inlet_level;
        config.node_count = nodes;
        lay(wave, level_falling);
        march();
        /* The bound of above, for the level alone. */
        TEST_ASSERT_DOUBLE_WITHIN(0.02 / ((double)nodes * nodes) + 8 * EPSILON, odd,
                                  (double)prediction.inlet_level);
    }
}

/* --- loss profiles --- */

static void test_profile_of_equal_values_is_the_uniform_loss_bit_for_bit(void) {
    static belt_prediction_t uniform;
    lay(wave, level_falling);
    march();
    uniform = prediction;
    config.loss_count = 3;
    config.loss_rate[1] = config.loss_rate[0];
    config.loss_rate[2] = config.loss_rate[0];
    lay(wave, level_falling);
    march();
    TEST_ASSERT_TRUE(memcmp(&uniform, &prediction, sizeof uniform) == 0);
}

static void test_profile_of_nearly_equal_values_is_close_to_the_uniform_loss(void) {
    for (uint16_t nodes = 20; nodes <= 21; ++nodes) {
        config = paper_case();
        config.node_count = nodes;
        lay(wave, level_falling);
        march();
        const future_t uniform = {(double)prediction.inlet_level, (double)prediction.inlet_arrival,
                                  (double)prediction.inlet_congestion,
                                  (double)prediction.inlet_survival,
                                  (double)prediction.inlet_rework};
        config.loss_count = 2;
        config.loss_rate[1] = real_next(config.loss_rate[0], BELT_REAL(2));
        lay(wave, level_falling);
        march();
        TEST_ASSERT_FALSE(line.loss_is_uniform);
        /* Two second-order ways to the same: a twentieth of loss a pair, its square over 12. */
        TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.05 / 12.0 + rounding(), 0.0, distance(&uniform));
    }
}

/* --- what the command needs besides --- */

static void assert_rework_slope_is_the_change_at_the_inlet(uint16_t nodes) {
    config.node_count = nodes;
    lay(wave, level_constant);
    march();
    (void)future_of(wave, level_constant);
    /* Over the last spacing and over the last four: the march may take any piece between. */
    const double share = (double)FINE / nodes;
    future_t at_end;
    future_t one_before;
    future_t four_before;
    look_back(&at_end, FINE, 2.0, 0.0, 0.0);
    look_back(&one_before, (int)(FINE - share), 2.0 - 2.0 / nodes, 0.0, 0.0);
    look_back(&four_before, (int)(FINE - 4.0 * share), 2.0 - 8.0 / nodes, 0.0, 0.0);
    const double last = at_end.rework - one_before.rework;
    const double four = 0.25 * (at_end.rework - four_before.rework);
    TEST_ASSERT_DOUBLE_WITHIN(1.2 * fabs(four - last) + 8 * EPSILON, last,
                              (double)prediction.inlet_rework_slope);
}

static void test_rework_slope_is_the_change_of_rework_at_the_inlet(void) {
    hold_speed();
    config.rework_rate = BELT_REAL(0.8);
    for (int kind = 0; kind < 2; ++kind) {
        assert_rework_slope_is_the_change_at_the_inlet(20);
        assert_rework_slope_is_the_change_at_the_inlet(40);
        assert_rework_slope_is_the_change_at_the_inlet(80);
        config.loss_count = 2;
        config.loss_rate[1] = BELT_REAL(0.2);
    }
}

static double heavy(double x) {
    (void)x;
    return 8.0;
}

static void test_predicted_level_ends_at_the_capacity_where_the_buffer_spills(void) {
    lay(heavy, level_constant);
    march();
    for (uint32_t k = 0; k <= prediction.count; ++k) {
        TEST_ASSERT_TRUE(prediction.level[k] <= config.level_capacity);
    }
    TEST_ASSERT_TRUE(prediction.inlet_level == config.level_capacity);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_empty_line_takes_its_shortest_dead_time);
    RUN_TEST(test_level_of_an_empty_belt_decays);
    RUN_TEST(test_full_service_takes_parts_at_its_greatest_rate);
    RUN_TEST(test_at_constant_speed_without_loss_the_march_is_the_smith_predictor);
    RUN_TEST(test_without_service_the_level_gains_every_part_on_the_belt);
    RUN_TEST(test_jumps_between_the_cells_of_a_pair_are_met_to_second_order);
    RUN_TEST(test_survival_at_constant_speed_is_exponential);
    RUN_TEST(test_line_at_rest_predicts_itself);
    RUN_TEST(test_line_at_rest_predicts_itself_wherever_the_outlet_is_in_a_cell);
    RUN_TEST(test_lines_and_stretches_add_up);
    RUN_TEST(test_held_congestion_keeps_the_pace);
    RUN_TEST(test_window_that_slid_past_now_uses_predicted_levels_only);
    RUN_TEST(test_window_longer_than_the_dead_time_still_uses_recorded_levels);
    RUN_TEST(test_level_that_leaves_the_window_at_the_inlet_is_told);
    RUN_TEST(test_march_finds_the_future_of_the_equations);
    RUN_TEST(test_march_finds_the_future_of_a_long_and_of_a_short_window);
    RUN_TEST(test_march_finds_the_future_of_a_loss_profile);
    RUN_TEST(test_march_finds_the_future_of_much_rework);
    RUN_TEST(test_half_the_spacing_leaves_a_quarter_of_the_error);
    RUN_TEST(test_odd_and_even_node_counts_agree_to_second_order);
    RUN_TEST(test_profile_of_equal_values_is_the_uniform_loss_bit_for_bit);
    RUN_TEST(test_profile_of_nearly_equal_values_is_close_to_the_uniform_loss);
    RUN_TEST(test_rework_slope_is_the_change_of_rework_at_the_inlet);
    RUN_TEST(test_predicted_level_ends_at_the_capacity_where_the_buffer_spills);
    return UNITY_END();
}
