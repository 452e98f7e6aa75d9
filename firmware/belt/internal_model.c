/* SPDX-License-Identifier: MIT */
#include "internal_model.h"

/** What the march starts from. */
static void look(belt_model_t *model, belt_real_t level) {
    belt_present_t *present = &model->present;
    present->level = level;
    present->congestion = belt_level_history_congestion(&model->history);
    present->disturbance = model->estimator.disturbance;
    present->disturbance_flux = present->disturbance / model->line.connectivity;
}

void belt_model_init(belt_model_t *model, const belt_config_t *config) {
    belt_line_init(&model->line, config);
    belt_estimator_gains_init(&model->estimator_gains, config);
    belt_level_history_init(&model->history, config);
    belt_observer_init(&model->observer);
}

void belt_model_begin(belt_model_t *model, const belt_trusted_t *trusted,
                      const belt_real_t *density) {
    belt_level_history_begin(&model->history, trusted->level);
    belt_estimator_begin(&model->estimator, trusted->level);
    look(model, trusted->level);
    if (trusted->has_density) {
        belt_observer_assume(&model->observer, &model->line, density);
    }
}

/** The belt over some periods: what was fed, how far it moved, what left. Returns the model's outlet
 * flux, its mean [parts/s]. */
static belt_real_t move_belt(belt_model_t *model, const belt_trusted_t *trusted, uint32_t periods) {
    const belt_line_t *line = &model->line;
    const belt_level_history_t *history = &model->history;
    const belt_present_t *present = &model->present;
    /* The speed in the middle, from the congestion there. */
    const belt_real_t count = (belt_real_t)periods;
    const belt_real_t duration = count * history->period;
    const belt_real_t age = history->window - BELT_REAL(0.25) * count;
    const belt_real_t tail =
        belt_level_history_at(history, belt_within(BELT_REAL(0), age, history->window));
    const belt_real_t rise = BELT_HALF * duration * (present->level - tail);
    const belt_real_t slowness = belt_line_slowness(line, present->congestion + rise);
    const belt_real_t travel = duration / (slowness * line->spacing);
    belt_passage_t passage;
    passage.duration = duration;
    passage.travel = belt_within(BELT_TRAVEL_MIN, travel, BELT_REAL(1));
    passage.fed_density = trusted->applied_flux * slowness;
    passage.left_is_measured = trusted->has_outlet_flux;
    passage.left_density =
        trusted->outlet_flux * belt_line_slowness(line, present->congestion + rise + rise);
    belt_observer_advance(&model->observer, line, &passage);
    return model->observer.modelled_density / slowness;
}

/** The level at the end of some periods, the last of `passed` out of all to be made up for. */
static belt_real_t next_level(belt_model_t *model, const belt_trusted_t *trusted,
                              belt_real_t outlet_flux, uint32_t periods, uint32_t passed) {
    const bool is_now = passed >= trusted->periods;
    if (model->estimator_gains.is_on != 0u) {
        belt_estimator_expect(&model->estimator, &model->line, outlet_flux,
                              (belt_real_t)periods * model->history.period);
        if (is_now && trusted->level_is_new) {
            belt_estimator_correct(&model->estimator, &model->estimator_gains, &model->line,
                                   trusted->level);
        }
        return model->estimator.level;
    }
    const belt_real_t last = model->present.level;
    const belt_real_t share =
        (belt_real_t)periods / (belt_real_t)(trusted->periods - passed + periods);
    return is_now ? trusted->level : last + share * (trusted->level - last);
}

/** Levels enter the history, on a line from the last one; out of it comes the congestion. */
static void record_level(belt_model_t *model, belt_real_t level, uint32_t periods) {
    const belt_real_t from = belt_line_level(&model->line, model->present.level);
    const belt_real_t to = belt_line_level(&model->line, level);
    const belt_real_t rise = (to - from) / (belt_real_t)periods;
    for (uint32_t i = 1; i < periods; ++i) {
        const belt_real_t between = from + (belt_real_t)i * rise;
        belt_level_history_push(&model->history, belt_line_level(&model->line, between));
    }
    belt_level_history_push(&model->history, to);
    look(model, to);
}

void belt_model_follow(belt_model_t *model, const belt_trusted_t *trusted,
                       const belt_real_t *density, uint32_t longest) {
    uint32_t passed = 0;
    /* At most BELT_CATCH_UP_PERIODS turns: each takes one period or more. */
    while (passed < trusted->periods) {
        const uint32_t rest = trusted->periods - passed;
        const uint32_t periods = (rest < longest) ? rest : longest;
        const belt_real_t outlet_flux = move_belt(model, trusted, periods);
        passed += periods;
        record_level(model, next_level(model, trusted, outlet_flux, periods, passed), periods);
    }
    if (trusted->has_density) {
        belt_observer_assume(&model->observer, &model->line, density);
    }
}
