/* SPDX-License-Identifier: MIT */
/* predictor_case.h - a line to march on, and its future by the equations as the paper prints them. */
#ifndef TESTS_UNIT_PREDICTOR_CASE_H
#define TESTS_UNIT_PREDICTOR_CASE_H

#include "belt/predictor.h"

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_model_t model;
static belt_prediction_t prediction;

/* --- what lies on the belt, and the levels before now --- */

static inline double nothing(double x) {
    (void)x;
    return 0.0;
}

static inline double half(double x) {
    (void)x;
    return 0.5;
}

static inline double wave(double x) {
    return 0.3 + 0.2 * sin(3.0 * x);
}

static inline double level_constant(double ago) {
    (void)ago;
    return 0.4;
}

static inline double level_falling(double ago) {
    return 0.4 + 0.3 * ago;
}

static inline double level_setpoint(double ago) {
    (void)ago;
    return (double)config.level_setpoint;
}

typedef double along_t(double);

/** Lays density [over x] on the belt, levels [over time before now] into the window. */
static inline void lay(along_t *density, along_t *level) {
    belt_real_t nodes[BELT_NODE_CAPACITY + 1];
    belt_line_init(&model.line, &config);
    for (uint32_t i = 0; i <= model.line.node_count; ++i) {
        nodes[i] = BELT_REAL(density((double)model.line.spacing * i));
    }
    belt_observer_init(&model.observer);
    belt_observer_assume(&model.observer, &model.line, nodes);
    belt_level_history_init(&model.history, &config);
    for (uint32_t i = model.history.length; i > 0u; --i) {
        belt_level_history_push(&model.history, BELT_REAL(level((double)config.period * (i - 1u))));
    }
    memset(&model.present, 0, sizeof model.present);
    model.present.level = BELT_REAL(level(0.0));
    model.present.congestion = belt_level_history_congestion(&model.history);
}

static inline void march(void) {
    memset(&prediction, 0xFF, sizeof prediction);
    belt_predictor_march(&prediction, &model);
}

/* The finest line of these tests; the presets have room for it. */
#define CELLS_NEEDED 161

static inline void set_up_case(void) {
    TEST_ASSERT_TRUE_MESSAGE(BELT_NODE_CAPACITY >= CELLS_NEEDED, "build with a preset");
    config = paper_case();
}

static inline void forget_loss_and_rework(void) {
    config.loss_rate[0] = BELT_REAL(0);
    config.rework_rate = BELT_REAL(0);
}

/** No congestion to speak of: P*D = 0.5 s of dead time. */
static inline void hold_speed(void) {
    config.congestion_scale = BELT_REAL(1e6);
}

/* A march's roundings: ten of each number for every cell. And what hold_speed() leaves of congestion:
 * up to 0.1 of a millionth. */
static inline double rounding(void) {
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

static inline double loss_at(double x) {
    if (config.loss_count == 1) {
        return (double)config.loss_rate[0];
    }
    const double place = x / (double)config.belt_length * (config.loss_count - 1);
    const int piece = (int)fmin(place, config.loss_count - 2);
    const double from = (double)config.loss_rate[piece];
    return from + (place - piece) * ((double)config.loss_rate[piece + 1] - from);
}

/* The laws in double; of another line, tests/laws has them. */
#ifdef SIM_LINE_LAWS
#include "laws_case.h"
#else
static inline double service(double level) {
    return fmin(level / (double)config.service_time, (double)config.service_rate_max);
}

static inline double slowness_at(double congestion) {
    return (double)config.processing_time * (1.0 + congestion / (double)config.congestion_scale);
}

/** Density put back at x in a second while v leaves. */
static inline double rework_at(double x, double v) {
    return (double)config.rework_rate * ((double)config.belt_length - x) * v;
}
#endif

static inline double level_then(along_t *past, int count, double time) {
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
static inline void look_back(future_t *future, int count, double x, double exponent,
                             double gained) {
    const double dx = (double)config.belt_length / FINE;
    for (int i = count - 1; i >= 0; --i) {
        const double place = x - (i + 0.5) * dx;
        const double time = fine.slowness[i] * dx;
        const double loss = loss_at(place) * time;
        gained += rework_at(place, fine.outlet_density[i]) * time * exp(-exponent - 0.5 * loss);
        exponent += loss;
    }
    future->survival = exp(-exponent);
    future->rework = gained;
}

static inline future_t future_of(along_t *density, along_t *past) {
    const double dx = (double)config.belt_length / FINE;
    const double alpha = (double)config.connectivity;
    const double tau = (double)config.speed_window;
    double congestion = 0.0;
    for (int i = 0; i < 1000; ++i) {
        congestion += past(tau * (i + 0.5) / 1000.0) * tau / 1000.0;
    }
    double slowness = slowness_at(congestion);
    future_t future = {0};
    fine.level[0] = past(0.0);
    fine.arrival[0] = 0.0;
    for (int i = 0; i < FINE; ++i) {
        const double level = fine.level[i];
        const double tail = level_then(past, i, fine.arrival[i] + 0.5 * dx * slowness - tau);
        const double s = slowness_at(congestion + 0.5 * dx * slowness * (level - tail));
        const double x = (i + 0.5) * dx;
        const double way = 0.5 * s * dx;
        const double before = (i > 0) ? fine.outlet_density[i - 1] : density(0.0);
        look_back(&future, i, x, loss_at(0.25 * dx) * way, rework_at(0.25 * dx, before) * way);
        const double p2 = future.survival * density(x) + future.rework;
        const double middle = level + 0.5 * dx * (alpha * p2 - service(level) * s);
        fine.slowness[i] = s;
        fine.outlet_density[i] = p2;
        fine.arrival[i + 1] = fine.arrival[i] + s * dx;
        fine.level[i + 1] = level + dx * (alpha * p2 - service(middle) * s);
        congestion += (middle - tail) * s * dx;
        slowness = slowness_at(congestion);
    }
    look_back(&future, FINE, (double)config.belt_length, 0.0, 0.0);
    future.level = fine.level[FINE];
    future.arrival = fine.arrival[FINE];
    future.congestion = congestion;
    return future;
}

/** The greatest difference between march and future, each of its own size. */
static inline double distance(const future_t *future) {
    double worst = fabs((double)prediction.inlet.level - future->level);
    worst = fmax(worst, fabs((double)prediction.inlet.arrival - future->arrival));
    worst = fmax(worst, fabs((double)prediction.inlet.congestion - future->congestion));
    worst = fmax(worst, fabs((double)prediction.inlet_survival - future->survival));
    return fmax(worst, fabs((double)prediction.inlet_rework - future->rework));
}

static inline double error_on(uint16_t nodes, along_t *density, along_t *past) {
    config.node_count = nodes;
    lay(density, past);
    march();
    const future_t future = future_of(density, past);
    return distance(&future);
}

#endif
