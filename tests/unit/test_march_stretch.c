/* SPDX-License-Identifier: MIT */
/* One stretch by itself, at the outlet: what leaves of each of its two cells, and how it looks ahead. */
#include "belt/march_stretch.h"

#include "march_case.h"

/* Pieces of a stretch where the equations are summed up. */
#define FINE 2000

/** Nothing but what a test turns on: constant speed, no service, loss or rework. */
void setUp(void) {
    config = paper_case();
    config.congestion_scale = BELT_REAL(1e6);
    config.service_time = BELT_REAL(1e6);
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
}

void tearDown(void) {
}

static void pass(double first, double second, double first_width, double second_width) {
    const belt_stretch_t stretch = {{BELT_REAL(first), BELT_REAL(second)},
                                    {BELT_REAL(first_width), BELT_REAL(second_width)}};
    belt_march_stretch(&prediction, &model, &stretch);
}

/** Loss from none at the outlet to 6.4 a second at the inlet, on four spacings of 0.125 s each: 0.1 on the
 * first of them, 0.3 on the second. */
static void steepen(void) {
    config.node_count = 4; /* 0.5 m, 0.125 s a spacing */
    config.loss_count = 5;
    for (int i = 0; i < 5; ++i) {
        config.loss_rate[i] = BELT_REAL(1.6 * i);
    }
}

/* --- two cells of a loss profile --- */

/** Loss of the way from `place` to the outlet: linear between nodes, as the line has it. */
static double loss_from(double place) {
    const double pace = (double)prediction.pace[0];
    const double first = (double)belt_line_loss(&model.line, 0u);
    const double second = (double)belt_line_loss(&model.line, 1u);
    return pace * (first * fmin(place, 1.0) + second * fmax(place - 1.0, 0.0));
}

/** Each cell leaves with what its own way has left of it. The three series of up to two ways, each of a
 * loss below 0.3, fall short by loss^4/20 and less; eight roundings. */
static void assert_each_cell_goes_its_own_way(double first_width, double second_width) {
    const double close = 3.0 * 0.3 * 0.3 * 0.3 * 0.3 / 20.0 + 8.0 * EPSILON;
    const double width = first_width + second_width;
    begin();
    pass(1.0, 0.0, first_width, second_width);
    TEST_ASSERT_DOUBLE_WITHIN(close, first_width / width * exp(-loss_from(0.5 * first_width)),
                              (double)prediction.outlet_density[0]);
    begin();
    pass(0.0, 1.0, first_width, second_width);
    TEST_ASSERT_DOUBLE_WITHIN(
        close, second_width / width * exp(-loss_from(first_width + 0.5 * second_width)),
        (double)prediction.outlet_density[0]);
}

static void test_each_cell_of_a_stretch_loses_on_its_own_way(void) {
    steepen();
    assert_each_cell_goes_its_own_way(0.3, 1.0);
    assert_each_cell_goes_its_own_way(1.0, 0.3);
    assert_each_cell_goes_its_own_way(1.0, 1.0);
    assert_each_cell_goes_its_own_way(1.0, 0.0001);
}

/* --- rework within a stretch --- */

/** Mean density that leaves of two whole cells, piece by piece: each has what was put back on its way while
 * those before it left. */
static double leaving_by_the_equation(double first, double second) {
    static double gained[FINE];
    const double spacing = 2.0 * (double)model.line.spacing / FINE;
    const double time = 2.0 * (double)prediction.pace[0] / FINE;
    double sum = 0.0;
    memset(gained, 0, sizeof gained);
    for (int i = 0; i < FINE; ++i) {
        const double left = gained[i] + ((i < FINE / 2) ? first : second);
        sum += left;
        for (int k = i + 1; k < FINE; ++k) {
            const double x = (k - i) * spacing;
            gained[k] +=
                (double)config.rework_rate * ((double)config.belt_length - x) * left * time;
        }
    }
    return sum / FINE;
}

/** On a line whose loss is not uniform, and next to nothing here. */
static double error_of_leaving(double first, double second, double rework_rate) {
    config.rework_rate = BELT_REAL(rework_rate);
    config.loss_count = 2;
    config.loss_rate[1] = BELT_REAL(1e-7);
    begin();
    pass(first, second, 1.0, 1.0);
    return (double)prediction.outlet_density[0] - leaving_by_the_equation(first, second);
}

/** The middle stands for the stretch. What is put back on its way is that of the first cell: with g put
 * back while a cell leaves, it gets g of that, where of a cell before an empty one the mean is 3/4 and of
 * one behind it 1/4. That quarter, g^2 for the rework of the rework. */
static void test_what_the_first_cell_leaves_is_put_back_on_the_way_of_the_middle(void) {
    const double put_back = 2.0 * 2.0 * 0.025; /* A*D*pace */
    const double close = (0.25 + put_back) * put_back;
    TEST_ASSERT_DOUBLE_WITHIN(close, 0.0, error_of_leaving(1.0, 0.0, 2.0));
    TEST_ASSERT_DOUBLE_WITHIN(close, 0.0, error_of_leaving(0.0, 1.0, 2.0));
}

/** Even density leaves as exp(g) grows, g^2*2/3 above 1 + g over two cells. With the rework of its own way
 * the middle has g^2 of it, without it none: a third too much, not two thirds too little. What is of third
 * order, g^3/3, and the rest of the half. */
static void test_what_is_put_back_has_had_the_rework_of_the_last_way(void) {
    const double put_back = 5.0 * 2.0 * 0.025;
    TEST_ASSERT_DOUBLE_WITHIN(0.5 * put_back * put_back, 0.0, error_of_leaving(1.0, 1.0, 5.0));
}

/* --- the moment of what leaves --- */

/** The mean level while a stretch without loss leaves, seen through the congestion: with an empty window
 * it is that mean times the time. */
static double mean_level(double first, double second) {
    begin();
    pass(first, second, 1.0, 1.0);
    return (double)prediction.inlet.congestion / (double)prediction.inlet.arrival;
}

/** Over two cells of equal width a straight line from one cell's mean to the other's has the first moment
 * (first - second)/6 about the middle, over width^2. Eight roundings of a level up to 0.4; of it 1e-7
 * is served, and the pace grows by as little. */
static void assert_moment_is_that_of_a_straight_line(void) {
    const double gain = 2.0 * 0.5 * 2.0 / config.node_count;
    TEST_ASSERT_DOUBLE_WITHIN(8.0 * EPSILON + 1e-7, gain * (0.5 * 4.0 + 4.0 / 6.0),
                              mean_level(6.0, 2.0));
    TEST_ASSERT_DOUBLE_WITHIN(8.0 * EPSILON + 1e-7, gain * (0.5 * 4.0 - 4.0 / 6.0),
                              mean_level(2.0, 6.0));
}

static void test_density_that_falls_over_a_stretch_is_in_the_buffer_for_longer(void) {
    assert_moment_is_that_of_a_straight_line();
    config.loss_count = 2; /* no loss here, but none that is uniform */
    config.loss_rate[1] = BELT_REAL(1e-7);
    assert_moment_is_that_of_a_straight_line();
}

/* --- looking ahead --- */

/* Levels of the window: they leave it rising from 0.1 by 5 parts/s, or falling from 0.9. */
#define SLOPE 5.0

static void fill_window(double slope) {
    const double from = (slope > 0.0) ? 0.1 : 0.9;
    const double window = (double)config.speed_window;
    for (uint32_t i = model.history.length; i > 0u; --i) {
        const double ago = (double)config.period * (double)(i - 1u);
        const double level = from + slope * (window - ago);
        belt_level_history_push(&model.history, BELT_REAL(fmax(0.0, fmin(level, 1.0))));
    }
}

/** R' = level - tail in time, over `width` spacings in small steps: the mean pace. */
static double pace_by_the_equation(double level, double tail, double slope, double width) {
    const double spacing = (double)model.line.spacing;
    const double dx = width / FINE;
    double congestion = 0.0;
    double time = 0.0;
    for (int i = 0; i < FINE; ++i) {
        const double begin_pace = spacing * ((double)model.line.slowness_empty +
                                             (double)model.line.slowness_slope * congestion);
        const double half = 0.5 * dx * begin_pace;
        const double at_half = congestion + half * (level - tail - slope * (time + 0.5 * half));
        const double pace = spacing * ((double)model.line.slowness_empty +
                                       (double)model.line.slowness_slope * at_half);
        congestion += dx * pace * (level - tail - slope * (time + half));
        time += dx * pace;
    }
    return time / width;
}

static double error_of_the_pace(double level, double slope, double width) {
    begin();
    fill_window(slope);
    prediction.inlet.level = BELT_REAL(level);
    const double tail = (slope > 0.0) ? 0.1 : 0.9;
    pass(0.0, 0.0, 0.5 * width, 0.5 * width);
    return fabs((double)prediction.pace[0] - pace_by_the_equation(level, tail, slope, width));
}

/** Third order, an eighth of the error for half the width; a sixth leaves room for the fourth, and a term
 * of second order would leave a quarter. Levels are kept in quanta of 1e-7 in float: rounding is 8 of the
 * pace. */
static void assert_pace_is_of_third_order(double level, double slope) {
    begin();
    const double rounding = 8.0 * EPSILON * (double)prediction.inlet.pace;
    double before = error_of_the_pace(level, slope, 2.0);
    TEST_ASSERT_TRUE(before > 100.0 * rounding); /* or there was nothing to divide */
    for (double width = 1.0; width >= 0.25; width *= 0.5) {
        const double error = error_of_the_pace(level, slope, width);
        TEST_ASSERT_TRUE(error <= before / 6.0 + rounding);
        before = error;
    }
}

static void test_pace_follows_the_windows_end_on_a_loss_profile_to_third_order(void) {
    config.congestion_scale = BELT_REAL(0.05);
    config.loss_count = 2;
    config.loss_rate[1] = BELT_REAL(1);
    assert_pace_is_of_third_order(0.6, SLOPE);
    assert_pace_is_of_third_order(0.2, -SLOPE);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_each_cell_of_a_stretch_loses_on_its_own_way);
    RUN_TEST(test_what_the_first_cell_leaves_is_put_back_on_the_way_of_the_middle);
    RUN_TEST(test_what_is_put_back_has_had_the_rework_of_the_last_way);
    RUN_TEST(test_density_that_falls_over_a_stretch_is_in_the_buffer_for_longer);
    RUN_TEST(test_pace_follows_the_windows_end_on_a_loss_profile_to_third_order);
    return UNITY_END();
}
