/* SPDX-License-Identifier: MIT */
#include "safety.h"

#include "exponential.h"

#include <string.h>

/** Levels in order of time: their range, and by how much a later one lies below an earlier one. */
typedef struct {
    belt_real_t least;
    belt_real_t greatest;
    belt_real_t fall;
} levels_t;

/** What both bounds are made of. */
typedef struct {
    const belt_controller_t *controller;
    const belt_present_t *present;
    const belt_prediction_t *march; /**< anew: the controller's own is under no seal. */
    belt_real_t arriving;           /**< u(Q*, p1(D)) [parts/s]. */
    belt_real_t holding;            /**< u(Q*, Q*) [parts/s]. */
    bool applies;
} outlook_t;

static belt_real_t lesser(belt_real_t a, belt_real_t b) {
    return (a < b) ? a : b;
}

static belt_real_t greater(belt_real_t a, belt_real_t b) {
    return (a > b) ? a : b;
}

/** A number that should be 0 or more; what is not, or has left the numbers, has no bound. */
static belt_real_t bounded(belt_real_t number) {
    const bool is_sound = (number >= BELT_REAL(0)) && (number < BELT_REAL_MAX);
    return is_sound ? number : BELT_REAL_MAX;
}

static belt_real_t ratio(belt_real_t above, belt_real_t below) {
    return (below > BELT_REAL(0)) ? bounded(above / below) : BELT_REAL_MAX;
}

static void conclude(belt_promise_t *promise, const outlook_t *outlook) {
    promise->flux_min = bounded(promise->flux_min);
    promise->density_max = bounded(promise->density_max);
    promise->left = bounded(promise->left);
    promise->right = bounded(promise->right);
    promise->margin = ratio(promise->right, promise->left);
    promise->applies = outlook->applies;
    promise->holds = outlook->applies && (promise->left < promise->right);
}

/** Whether the level stays in the buffer, and the buffer is nowhere full along the march. */
static bool stays_below(const belt_prediction_t *march, belt_real_t capacity) {
    bool stays = true;
    for (uint32_t i = 0; i <= march->inlet.count; ++i) {
        stays = stays && (march->level[i] >= BELT_REAL(0)) && (march->level[i] < capacity);
    }
    return stays;
}

/** Greatest density on the belt, both sides of every cut looked at; `is_sound` becomes false where a
 * cell holds less than nothing or no number [parts/m]. */
static belt_real_t greatest_density(const belt_controller_t *controller, bool *is_sound) {
    const belt_observer_t *observer = &controller->model.observer;
    belt_real_t greatest = BELT_REAL(0);
    for (uint32_t i = 0; i <= controller->model.line.node_count; ++i) {
        const uint32_t cell = belt_observer_behind(&controller->model.line, observer->outlet, i);
        const belt_real_t mean = observer->density[cell];
        const belt_real_t near_side =
            mean - observer->step[cell] * (BELT_REAL(1) - observer->cut[cell]);
        *is_sound = *is_sound && (mean >= BELT_REAL(0));
        greatest = greater(greatest, greater(near_side, near_side + observer->step[cell]));
    }
    return greatest;
}

/** Whether both bounds are proved for such a line: the paper's laws, and nowhere a density that grows. */
#if BELT_LINE_HAS_LAWS
static bool is_proved_for(const belt_config_t *config) {
    (void)config;
    return false;
}
#else
static bool is_proved_for(const belt_config_t *config) {
    return belt_config_loss_exponent(config) <=
           belt_config_loss_mean(config) * belt_config_dead_time_max(config);
}
#endif

static void look_ahead(outlook_t *outlook, belt_prediction_t *march,
                       const belt_controller_t *controller) {
    const belt_model_t *model = &controller->model;
    outlook->controller = controller;
    outlook->march = march;
    outlook->present = &model->present;
    belt_predictor_march(march, model);
    outlook->arriving = belt_command_wanted(&controller->law, &model->present, march->inlet.level);
    outlook->holding =
        belt_command_wanted(&controller->law, &model->present, controller->law.level_setpoint);
    outlook->applies = (controller->config.prediction == BELT_PREDICT_CONGESTION) &&
                       (model->present.congestion >= BELT_REAL(0)) &&
                       is_proved_for(&controller->config) &&
                       stays_below(march, model->line.level_capacity);
}

/** M/u < 2/(A D^2 s), s = 1 + tau Qmax/congestion_scale (Abound), (Mchar). */
static belt_promise_t proposition(const outlook_t *outlook, belt_real_t densest) {
    const belt_controller_t *controller = outlook->controller;
    const belt_config_t *config = &controller->config;
    const belt_real_t crowded = belt_config_slowdown_max(config);
    /* What a negative disturbance takes, the law adds to what it wants. */
    const belt_real_t wanted_max =
        config->nominal_flux_max - lesser(outlook->present->disturbance_flux, BELT_REAL(0));
    const belt_real_t fed = config->processing_time * crowded * crowded * wanted_max;
    const belt_real_t now =
        belt_command_wanted(&controller->law, outlook->present, outlook->present->level);
    /* A D^2 P s; BELT_REWORK_GAIN_MAX keeps it below 2. */
    const belt_real_t rework =
        controller->model.line.rework_at_outlet * belt_config_dead_time_max(config);
    belt_promise_t promise;
    promise.flux_min = lesser(outlook->holding, lesser(now, outlook->arriving));
    promise.density_max =
        greater(densest, fed) / (BELT_REAL(1) + belt_expm1(-BELT_REAL(2) * rework));
    promise.left = ratio(promise.density_max, promise.flux_min);
    promise.right = ratio(BELT_REAL(2) * config->processing_time, rework);
    conclude(&promise, outlook);
    return promise;
}

static void pass_level(levels_t *levels, belt_real_t level) {
    levels->least = lesser(levels->least, level);
    levels->greatest = greater(levels->greatest, level);
    levels->fall = greater(levels->fall, levels->greatest - level);
}

/** The levels of the window, then those predicted, then the set-point. */
static levels_t levels_passed(const outlook_t *outlook) {
    const belt_controller_t *controller = outlook->controller;
    const belt_level_history_t *history = &controller->model.history;
    const belt_real_t oldest = belt_level_history_at(history, history->window);
    levels_t levels = {oldest, oldest, BELT_REAL(0)};
    for (uint32_t age = history->whole; age > 0u; --age) {
        pass_level(&levels, belt_level_history_at(history, (belt_real_t)age));
    }
    for (uint32_t i = 0; i <= outlook->march->inlet.count; ++i) {
        pass_level(&levels, outlook->march->level[i]);
    }
    pass_level(&levels, controller->law.level_setpoint);
    return levels;
}

/** A y E(D - y): flux that a density which left with material still `place` spacings ahead of the last
 * part fed brings by the time that part arrives, per density and metre [1/(m s)]. `pace`: least time a
 * spacing takes. */
static belt_real_t weight(const belt_line_t *line, belt_real_t place, belt_real_t pace) {
    const belt_real_t nodes = (belt_real_t)line->node_count;
    const belt_real_t way = belt_within(BELT_REAL(0), nodes - place, nodes);
    return belt_line_rework(line, way) *
           (BELT_REAL(1) + belt_expm1(-pace * belt_line_loss_sum(line, way)));
}

/** Rework when the first `gone` stretches of the belt have left, `moved` spacings in all, and as many
 * have come in with the density `fed`: midpoints of the stretches [parts/s]. */
static belt_real_t rework_after(const outlook_t *outlook, uint32_t gone, belt_real_t moved,
                                belt_real_t fed, belt_real_t pace) {
    const belt_line_t *line = &outlook->controller->model.line;
    const belt_prediction_t *march = outlook->march;
    belt_real_t rework = BELT_REAL(0);
    belt_real_t place =
        (belt_real_t)line->node_count - moved; /* where the gone ones come in again */
    for (uint32_t i = 0; i < march->inlet.count; ++i) {
        if (i == gone) {
            place = BELT_REAL(0);
        }
        const belt_real_t density = (i < gone) ? fed : march->outlet_density[i];
        const belt_real_t width = march->width[i];
        rework +=
            weight(line, place + BELT_HALF * width, pace) * width * belt_line_returned(density);
        place += width;
    }
    return rework * line->spacing;
}

/** The greatest of them, from the belt as it is to the one on which all has been fed, with what the
 * midpoints of stretches two nodes wide may miss of a smooth belt, (2/node_count)^2 [parts/s]. */
static belt_real_t rework_ahead(const outlook_t *outlook, belt_real_t fed, belt_real_t pace) {
    const belt_real_t stretch =
        BELT_REAL(2) / (belt_real_t)outlook->controller->model.line.node_count;
    belt_real_t moved = BELT_REAL(0);
    belt_real_t greatest = rework_after(outlook, 0u, moved, fed, pace);
    for (uint32_t gone = 1; gone <= outlook->march->inlet.count; ++gone) {
        moved += outlook->march->width[gone - 1u];
        greatest = greater(greatest, rework_after(outlook, gone, moved, fed, pace));
    }
    return greatest * (BELT_REAL(1) + stretch * stretch);
}

/** The rework of the belt as it is, moved on, against u. */
static belt_promise_t sharper(const outlook_t *outlook) {
    const belt_line_t *line = &outlook->controller->model.line;
    const belt_real_t window = outlook->controller->config.speed_window;
    const levels_t levels = levels_passed(outlook);
    const belt_real_t quickest = belt_line_slowness(line, window * levels.least);
    const belt_real_t slowest = belt_line_slowness(line, window * levels.greatest);
    const belt_real_t fed = slowest * greater(outlook->holding, outlook->arriving);
    const belt_real_t fall = BELT_REAL(1) + line->slowness_slope * window * levels.fall / quickest;
    belt_promise_t promise;
    promise.flux_min = lesser(outlook->holding, outlook->arriving);
    promise.density_max = fed;
    for (uint32_t i = 0; i < outlook->march->inlet.count; ++i) {
        promise.density_max = greater(promise.density_max, outlook->march->outlet_density[i]);
    }
    promise.left = fall * rework_ahead(outlook, fed, quickest * line->spacing);
    promise.right = promise.flux_min;
    conclude(&promise, outlook);
    return promise;
}

/** The density at the inlet less the one with which w(D) = 0 (nu0). */
static belt_real_t jump_at_the_inlet(const outlook_t *outlook) {
    const belt_prediction_t *march = outlook->march;
    const belt_real_t slowness =
        belt_line_slowness(&outlook->controller->model.line, march->inlet.congestion);
    const belt_real_t asked =
        (slowness * outlook->arriving - march->inlet_rework) / march->inlet_survival;
    return belt_within(-BELT_REAL_MAX, outlook->controller->model.observer.fed_density - asked,
                       BELT_REAL_MAX);
}

belt_status_t belt_safety_assess(const belt_controller_t *controller, belt_safety_t *safety) {
    BELT_ASSERT((controller != NULL) && (safety != NULL));
    if (safety == NULL) {
        return BELT_MISUSE;
    }
    memset(safety, 0, sizeof *safety);
    if (controller == NULL) {
        return BELT_MISUSE;
    }
    if (!belt_is_running(controller)) {
        return BELT_NO_LEVEL;
    }
    belt_prediction_t march;
    outlook_t outlook;
    look_ahead(&outlook, &march, controller);
    const belt_real_t densest = greatest_density(controller, &outlook.applies);
    safety->proposition = proposition(&outlook, densest);
    safety->sharper = sharper(&outlook);
    safety->jump = jump_at_the_inlet(&outlook);
    return BELT_OK;
}
