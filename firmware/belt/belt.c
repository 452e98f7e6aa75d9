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

/** Sum of what lies from one offset in the controller to another. */
static uint32_t sum_between(const belt_controller_t *controller, size_t from, size_t end) {
    return belt_integrity_sum((const unsigned char *)controller + from, end - from);
}

/** Sum of all that is derived: counts, limits and gains, the history's constants. Of the line its
 * tables are left out: a wrong loss is a wrong model and nothing worse. */
static uint32_t sum_of_derived(const belt_controller_t *controller) {
    return sum_between(controller, offsetof(belt_controller_t, law),
                       offsetof(belt_controller_t, model) + offsetof(belt_model_t, line) +
                           offsetof(belt_line_t, loss)) +
           sum_between(controller,
                       offsetof(belt_controller_t, model) + offsetof(belt_model_t, estimator_gains),
                       offsetof(belt_controller_t, model) + offsetof(belt_model_t, history) +
                           offsetof(belt_level_history_t, window_sum));
}

static uint32_t sum_of_command(const belt_controller_t *controller) {
    return sum_between(controller, offsetof(belt_controller_t, supervisor),
                       offsetof(belt_controller_t, command_seal));
}

static uint32_t sum_of_config(const belt_controller_t *controller) {
    return belt_integrity_sum(&controller->config, sizeof controller->config);
}

static void close_command(belt_controller_t *controller) {
    controller->command_seal = sum_of_command(controller);
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
    config = &controller->config;
    belt_nominal_law_init(&controller->law, config);
    belt_limits_init(&controller->limits, config);
    belt_model_init(&controller->model, config);
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
    const belt_observer_t *observer = &controller->model.observer;
    return (controller->seal == sum_of_derived(controller)) &&
           (controller->command_seal == sum_of_command(controller)) &&
           ((uint32_t)controller->command.mode < BELT_MODE_COUNT) &&
           (controller->model.history.newest < controller->model.history.length) &&
           (observer->outlet < controller->model.line.cell_slots) &&
           (observer->gone >= BELT_REAL(0)) && (observer->gone < BELT_REAL(1));
}

bool belt_is_running(const belt_controller_t *controller) {
    return (controller != NULL) && (controller->state == STATE_RUNNING) &&
           (controller->config_seal == sum_of_config(controller)) && is_intact(controller);
}

/** The first level, and what is said to lie on the belt. */
static void begin(belt_controller_t *controller, const belt_measurement_t *measurement) {
    belt_model_begin(&controller->model, &controller->trusted, measurement->density);
    controller->seal = sum_of_derived(controller);
    controller->state = STATE_RUNNING;
}

/** What the law asks to be fed [parts/s]. */
static belt_real_t law_flux(belt_controller_t *controller) {
    belt_predictor_march(&controller->prediction, &controller->model);
    return belt_command_solve(&controller->prediction, &controller->model, &controller->law);
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
    if (belt_estimator_is_at_limit(&controller->model.estimator,
                                   &controller->model.estimator_gains)) {
        trusted->error_bits |= BELT_ERROR_DISTURBANCE_LIMIT;
    }
    const uint32_t length = controller->model.history.length;
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
    belt_measurement_gate(&controller->trusted, &controller->gate, measurement,
                          controller->command.inlet_flux, &controller->model.line,
                          &controller->limits);
    if (controller->state == STATE_RUNNING) {
        belt_model_follow(&controller->model, &controller->trusted, measurement->density,
                          controller->limits.stretch_periods);
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
