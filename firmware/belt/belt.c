/* SPDX-License-Identifier: MIT */
#include "belt.h"

#include <string.h>

BELT_STATIC_ASSERT(configuration_stands_before_all_else,
                   (offsetof(belt_controller_t, config) == 0) &&
                       (offsetof(belt_controller_t, law) >= sizeof(belt_config_t)));

/* Words no freshly declared memory holds by chance. */
#define STATE_READY 0x0BE17001u
#define STATE_RUNNING 0x0BE17002u
#define STATE_CORRUPT 0x0BE17003u

/** Error bits that are not an input's. */
#define LINE_BITS (BELT_ERROR_FLUX_MISMATCH | BELT_ERROR_DISTURBANCE_LIMIT)
#define PERIOD_BITS                                                                                \
    (BELT_ERROR_PERIODS_LATE | BELT_ERROR_PERIODS_LOST | BELT_ERROR_PERIOD_REPEATED |              \
     BELT_ERROR_HISTORY_SHORT)

/** Sum of all that is derived: counts, limits and gains, the history's constants. Of the line its
 * tables of losses are left out: a wrong loss is a wrong model and nothing worse. */
static uint32_t sum_of_derived(const belt_controller_t *controller) {
    const unsigned char *bytes = (const unsigned char *)controller;
    const size_t from = offsetof(belt_controller_t, law);
    const size_t end = offsetof(belt_controller_t, line) + offsetof(belt_line_t, loss);
    return belt_integrity_sum(bytes + from, end - from) +
           belt_integrity_sum(&controller->history, offsetof(belt_level_history_t, window_sum));
}

static uint32_t sum_of_command(const belt_controller_t *controller) {
    const unsigned char *bytes = (const unsigned char *)controller;
    const size_t from = offsetof(belt_controller_t, supervisor);
    return belt_integrity_sum(bytes + from, offsetof(belt_controller_t, command_seal) - from);
}

static uint32_t sum_of_config(const belt_controller_t *controller) {
    return belt_integrity_sum(&controller->config, sizeof controller->config);
}

static void close_command(belt_controller_t *controller) {
    controller->command_seal = sum_of_command(controller);
}

static void derive(belt_controller_t *controller) {
    const belt_config_t *config = &controller->config;
    belt_nominal_law_init(&controller->law, config);
    belt_limits_init(&controller->limits, config);
    belt_estimator_gains_init(&controller->estimator_gains, config);
    controller->prediction_kind = config->prediction;
    belt_line_init(&controller->line, config);
}

belt_status_t belt_init(belt_controller_t *controller, const belt_config_t *config) {
    BELT_ASSERT((controller != NULL) && (config != NULL));
    if ((controller == NULL) || (config == NULL)) {
        return BELT_MISUSE;
    }
    const belt_status_t status = belt_config_check(config, NULL);
    if (status != BELT_OK) {
        return status;
    }
    /* The configuration may be the controller's own: it is copied first, then all behind it cleared. */
    controller->config = *config;
    controller->config_seal = sum_of_config(controller);
    const size_t behind = offsetof(belt_controller_t, law);
    memset((unsigned char *)controller + behind, 0, sizeof *controller - behind);
    derive(controller);
    belt_level_history_init(&controller->history, config);
    belt_observer_init(&controller->observer);
    belt_measurement_init(&controller->gate, &controller->limits);
    belt_supervisor_init(&controller->supervisor);
    controller->command.mode = BELT_MODE_OFF;
    controller->state = STATE_READY;
    controller->seal = sum_of_derived(controller);
    close_command(controller);
    return BELT_OK;
}

static bool is_ready(const belt_controller_t *controller) {
    return (controller != NULL) &&
           ((controller->state == STATE_READY) || (controller->state == STATE_RUNNING));
}

/** True while every count, index and limit that the step relies on is as it was written. */
static bool is_intact(const belt_controller_t *controller) {
    const belt_observer_t *observer = &controller->observer;
    return (controller->seal == sum_of_derived(controller)) &&
           (controller->command_seal == sum_of_command(controller)) &&
           ((uint32_t)controller->command.mode < BELT_MODE_COUNT) &&
           (controller->history.newest < controller->history.length) &&
           (observer->outlet < controller->line.cell_slots) && (observer->gone >= BELT_REAL(0)) &&
           (observer->gone < BELT_REAL(1));
}

bool belt_is_running(const belt_controller_t *controller) {
    return (controller != NULL) && (controller->state == STATE_RUNNING) &&
           (controller->config_seal == sum_of_config(controller)) && is_intact(controller);
}

/** What the march starts from. */
static void look(belt_controller_t *controller, belt_real_t level) {
    belt_present_t *present = &controller->present;
    present->level = level;
    present->congestion = belt_level_history_congestion(&controller->history);
    present->disturbance = controller->estimator.disturbance;
    present->disturbance_flux = present->disturbance / controller->line.connectivity;
}

/** The first level, and what is said to lie on the belt. */
static void begin(belt_controller_t *controller, const belt_measurement_t *measurement) {
    const belt_real_t level = controller->trusted.level;
    belt_level_history_begin(&controller->history, level);
    controller->seal = sum_of_derived(controller);
    belt_estimator_begin(&controller->estimator, level);
    look(controller, level);
    if (controller->trusted.has_density) {
        belt_observer_assume(&controller->observer, &controller->line, measurement->density);
    }
    controller->state = STATE_RUNNING;
}

/** The belt over some periods: what was fed, how far it moved, what left. Returns the model's outlet
 * flux, its mean [parts/s]. */
static belt_real_t move_belt(belt_controller_t *controller, uint32_t periods) {
    const belt_line_t *line = &controller->line;
    const belt_level_history_t *history = &controller->history;
    const belt_trusted_t *trusted = &controller->trusted;
    const belt_present_t *present = &controller->present;
    /* The speed in the middle, from the congestion there. */
    const belt_real_t count = (belt_real_t)periods;
    const belt_real_t duration = count * history->period;
    const belt_real_t age = history->window - BELT_REAL(0.25) * count;
    const belt_real_t tail =
        belt_level_history_at(history, belt_within(BELT_REAL(0), age, history->window));
    const belt_real_t slower =
        line->slowness_slope * BELT_HALF * duration * (present->level - tail);
    const belt_real_t slowness = belt_line_slowness(line, present->congestion) + slower;
    const belt_real_t travel = duration / (slowness * line->spacing);
    belt_passage_t passage;
    passage.duration = duration;
    passage.travel = belt_within(BELT_TRAVEL_MIN, travel, BELT_REAL(1));
    passage.fed_density = trusted->applied_flux * slowness;
    passage.left_is_measured = trusted->has_outlet_flux;
    passage.left_density = trusted->outlet_flux * (slowness + slower);
    belt_observer_advance(&controller->observer, line, &passage);
    return controller->observer.modelled_density / slowness;
}

/** The level at the end of some periods, the last of `passed` out of all to be made up for. */
static belt_real_t next_level(belt_controller_t *controller, belt_real_t outlet_flux,
                              uint32_t periods, uint32_t passed) {
    const belt_trusted_t *trusted = &controller->trusted;
    const bool is_now = passed >= trusted->periods;
    if (controller->estimator_gains.is_on != 0u) {
        belt_estimator_expect(&controller->estimator, &controller->line, outlet_flux,
                              (belt_real_t)periods * controller->history.period);
        if (is_now && trusted->level_is_new) {
            belt_estimator_correct(&controller->estimator, &controller->estimator_gains,
                                   &controller->line, trusted->level);
        }
        return controller->estimator.level;
    }
    const belt_real_t last = controller->present.level;
    const belt_real_t share =
        (belt_real_t)periods / (belt_real_t)(trusted->periods - passed + periods);
    return is_now ? trusted->level : last + share * (trusted->level - last);
}

/** Levels enter the history, on a line from the last one; out of it comes the congestion. */
static void record_level(belt_controller_t *controller, belt_real_t level, uint32_t periods) {
    const belt_real_t from = belt_line_level(&controller->line, controller->present.level);
    const belt_real_t to = belt_line_level(&controller->line, level);
    const belt_real_t rise = (to - from) / (belt_real_t)periods;
    for (uint32_t i = 1; i < periods; ++i) {
        const belt_real_t between = from + (belt_real_t)i * rise;
        belt_level_history_push(&controller->history, belt_line_level(&controller->line, between));
    }
    belt_level_history_push(&controller->history, to);
    look(controller, to);
}

/** Belt, level and history follow the line over all periods since the last step: one on time, more
 * after late or lost steps, then in stretches in which the belt moves at most a node spacing. */
static void follow_line(belt_controller_t *controller, const belt_measurement_t *measurement) {
    const belt_trusted_t *trusted = &controller->trusted;
    const uint32_t longest = controller->limits.stretch_periods;
    uint32_t passed = 0;
    /* At most BELT_CATCH_UP_PERIODS turns: each takes one period or more. */
    while (passed < trusted->periods) {
        const uint32_t rest = trusted->periods - passed;
        const uint32_t periods = (rest < longest) ? rest : longest;
        const belt_real_t outlet_flux = move_belt(controller, periods);
        passed += periods;
        record_level(controller, next_level(controller, outlet_flux, periods, passed), periods);
    }
    if (trusted->has_density) {
        belt_observer_assume(&controller->observer, &controller->line, measurement->density);
    }
}

/** What the law asks to be fed [parts/s]. */
static belt_real_t law_flux(belt_controller_t *controller) {
    belt_predictor_march(&controller->prediction, &controller->line, &controller->history,
                         &controller->observer, &controller->present, controller->prediction_kind);
    return belt_command_solve(&controller->prediction, &controller->line, &controller->history,
                              &controller->law, &controller->present);
}

static belt_status_t status_of(uint32_t error_bits) {
    if ((error_bits & ~(LINE_BITS | PERIOD_BITS)) != 0u) {
        return BELT_INPUT_REJECTED;
    }
    if ((error_bits & PERIOD_BITS) != 0u) {
        return BELT_PERIODS_MISSED;
    }
    return (error_bits != 0u) ? BELT_LINE_DEVIATES : BELT_OK;
}

static belt_status_t feed_nothing(belt_command_t *command, belt_status_t status) {
    if (command != NULL) {
        command->inlet_flux = BELT_REAL(0);
        command->mode = BELT_MODE_OFF;
        command->error_bits = 0;
    }
    return status;
}

/** Passes the command on, with what was wrong in this period. */
static belt_status_t conclude(belt_controller_t *controller, belt_command_t *command,
                              belt_status_t status) {
    controller->command.error_bits = controller->trusted.error_bits;
    close_command(controller);
    *command = controller->command;
    return status;
}

/** Error bits that no input caused: an estimate at its limit, a history not yet whole. */
static void note_state(belt_controller_t *controller) {
    belt_trusted_t *trusted = &controller->trusted;
    if (belt_estimator_is_at_limit(&controller->estimator, &controller->estimator_gains)) {
        trusted->error_bits |= BELT_ERROR_DISTURBANCE_LIMIT;
    }
    const uint32_t length = controller->history.length;
    const uint32_t missing =
        (controller->short_history < length) ? controller->short_history : length;
    if (missing > 0u) {
        trusted->error_bits |= BELT_ERROR_HISTORY_SHORT;
    }
    controller->short_history = (trusted->periods < missing) ? missing - trusted->periods : 0u;
}

/** A step before any level: the law cannot begin, the operator can. */
static belt_status_t step_without_level(belt_controller_t *controller, belt_command_t *command) {
    const bool is_manual = controller->supervisor.requested == BELT_MODE_MANUAL;
    if (controller->trusted.periods > 0u) {
        belt_supervisor_decide(&controller->supervisor, &controller->command, &controller->limits,
                               is_manual ? BELT_EVENT_MANUAL : BELT_EVENT_OFF, BELT_REAL(0));
    }
    return conclude(controller, command, BELT_NO_LEVEL);
}

/** Whether the step may run; if not, `status` says why. */
static bool may_step(belt_controller_t *controller, const belt_measurement_t *measurement,
                     const belt_command_t *command, belt_status_t *status) {
    const bool is_known = (controller != NULL) && (controller->state == STATE_CORRUPT);
    const bool is_usable =
        (is_known || is_ready(controller)) && (measurement != NULL) && (command != NULL);
    BELT_ASSERT(is_usable);
    *status = BELT_MISUSE;
    if (is_usable) {
        *status = (!is_known && is_intact(controller)) ? BELT_OK : BELT_CORRUPT;
    }
    if (*status == BELT_CORRUPT) {
        controller->state = STATE_CORRUPT;
    }
    return *status == BELT_OK;
}

belt_status_t belt_step(belt_controller_t *controller, const belt_measurement_t *measurement,
                        belt_command_t *command) {
    belt_status_t status;
    if (!may_step(controller, measurement, command, &status)) {
        return feed_nothing(command, status);
    }
    controller->trusted =
        belt_measurement_gate(&controller->gate, measurement, controller->command.inlet_flux,
                              &controller->line, &controller->limits);
    if (controller->state == STATE_RUNNING) {
        follow_line(controller, measurement);
    } else if (controller->trusted.level_is_new) {
        begin(controller, measurement);
    } else {
        return step_without_level(controller, command);
    }
    note_state(controller);
    if (controller->trusted.periods > 0u) {
        const belt_event_t event =
            belt_supervisor_event(&controller->supervisor, controller->gate.health);
        belt_supervisor_decide(&controller->supervisor, &controller->command, &controller->limits,
                               event, law_flux(controller));
    }
    return conclude(controller, command, status_of(controller->trusted.error_bits));
}

/** BELT_OK when a call from outside the step may change the controller. */
static belt_status_t may_change(belt_controller_t *controller) {
    const bool is_known = (controller != NULL) && (controller->state == STATE_CORRUPT);
    BELT_ASSERT(is_known || is_ready(controller));
    if (!is_known && !is_ready(controller)) {
        return BELT_MISUSE;
    }
    return (!is_known && is_intact(controller)) ? BELT_OK : BELT_CORRUPT;
}

belt_status_t belt_set_setpoint(belt_controller_t *controller, belt_real_t level_setpoint) {
    belt_status_t status = may_change(controller);
    if (status != BELT_OK) {
        return status;
    }
    if (controller->config_seal != sum_of_config(controller)) {
        return BELT_CORRUPT;
    }
    const belt_real_t before = controller->config.level_setpoint;
    controller->config.level_setpoint = level_setpoint;
    status = belt_config_check(&controller->config, NULL);
    if (status != BELT_OK) {
        controller->config.level_setpoint = before;
        return status;
    }
    belt_nominal_law_init(&controller->law, &controller->config);
    controller->config_seal = sum_of_config(controller);
    controller->seal = sum_of_derived(controller);
    return BELT_OK;
}

belt_status_t belt_set_mode(belt_controller_t *controller, belt_mode_t mode) {
    const belt_status_t status = may_change(controller);
    if (status != BELT_OK) {
        return status;
    }
    const bool is_known =
        (mode == BELT_MODE_OFF) || (mode == BELT_MODE_MANUAL) || (mode == BELT_MODE_AUTOMATIC);
    if (!is_known) {
        return BELT_UNKNOWN_MODE;
    }
    if ((mode == BELT_MODE_MANUAL) && (controller->supervisor.requested != BELT_MODE_MANUAL)) {
        controller->supervisor.manual_flux = controller->command.inlet_flux;
    }
    controller->supervisor.requested = mode;
    close_command(controller);
    return BELT_OK;
}

belt_status_t belt_set_manual_flux(belt_controller_t *controller, belt_real_t inlet_flux) {
    const belt_status_t status = may_change(controller);
    if (status != BELT_OK) {
        return status;
    }
    if (controller->supervisor.requested != BELT_MODE_MANUAL) {
        return BELT_NOT_MANUAL;
    }
    if (!(inlet_flux >= BELT_REAL(0)) || !(inlet_flux <= controller->limits.inlet_flux_max)) {
        return BELT_MANUAL_FLUX;
    }
    controller->supervisor.manual_flux = inlet_flux;
    if (controller->command.mode == BELT_MODE_MANUAL) { /* what was left of the switch is settled */
        controller->supervisor.bump = BELT_REAL(0);
    }
    close_command(controller);
    return BELT_OK;
}
