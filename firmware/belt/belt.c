/* SPDX-License-Identifier: MIT */
#include "belt.h"

#include <string.h>

BELT_STATIC_ASSERT(configuration_stands_before_all_else,
                   (offsetof(belt_controller_t, config) == 0) &&
                       (offsetof(belt_controller_t, line) >= sizeof(belt_config_t)));

/* Words no freshly declared memory holds by chance. */
#define STATE_READY 0x0BE17001u
#define STATE_RUNNING 0x0BE17002u

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
    const size_t behind = offsetof(belt_controller_t, line);
    memset((unsigned char *)controller + behind, 0, sizeof *controller - behind);
    belt_line_init(&controller->line, &controller->config);
    belt_nominal_law_init(&controller->law, &controller->config);
    belt_level_history_init(&controller->history, &controller->config);
    belt_observer_init(&controller->observer);
    controller->command.mode = BELT_MODE_OFF;
    controller->transport_speed = BELT_REAL(1) / controller->config.processing_time;
    controller->state = STATE_READY;
    return BELT_OK;
}

/** The level enters the history; out of it come congestion and speed. Returns the speed before. */
static belt_real_t record_level(belt_controller_t *controller) {
    const belt_real_t speed_before = controller->transport_speed;
    if (controller->state == STATE_READY) {
        belt_level_history_begin(&controller->history, controller->trusted.level);
    } else {
        belt_level_history_push(&controller->history, controller->trusted.level);
    }
    controller->present.level = controller->trusted.level;
    controller->present.congestion = belt_level_history_congestion(&controller->history);
    controller->transport_speed =
        BELT_REAL(1) / belt_line_slowness(&controller->line, controller->present.congestion);
    return speed_before;
}

/** The belt since the last step: what was fed, how far it moved, what left. */
static void move_belt(belt_controller_t *controller, belt_real_t speed_before,
                      const belt_measurement_t *measurement) {
    const belt_trusted_t *trusted = &controller->trusted;
    if (trusted->has_density) {
        belt_observer_assume(&controller->observer, &controller->line, measurement->density);
    } else if (controller->state == STATE_RUNNING) {
        const belt_real_t speed = BELT_HALF * (speed_before + controller->transport_speed);
        const belt_real_t travel = speed * controller->config.period / controller->line.spacing;
        belt_passage_t passage;
        passage.duration = controller->config.period;
        passage.travel = (travel < BELT_REAL(1)) ? travel : BELT_REAL(1);
        passage.fed_density = trusted->applied_flux / speed;
        passage.left_is_measured = trusted->has_outlet_flux;
        passage.left_density = trusted->outlet_flux / controller->transport_speed;
        belt_observer_advance(&controller->observer, &controller->line, &passage);
    }
}

static belt_status_t feed_nothing(belt_command_t *command, belt_status_t status,
                                  uint32_t error_bits) {
    if (command != NULL) {
        command->inlet_flux = BELT_REAL(0);
        command->mode = BELT_MODE_OFF;
        command->error_bits = error_bits;
    }
    return status;
}

static bool is_ready(const belt_controller_t *controller) {
    return (controller != NULL) &&
           ((controller->state == STATE_READY) || (controller->state == STATE_RUNNING));
}

belt_status_t belt_step(belt_controller_t *controller, const belt_measurement_t *measurement,
                        belt_command_t *command) {
    const bool usable = is_ready(controller) && (measurement != NULL) && (command != NULL);
    BELT_ASSERT(usable);
    if (!usable) {
        return feed_nothing(command, BELT_MISUSE, 0);
    }
    controller->trusted = belt_measurement_gate(measurement, &controller->trusted,
                                                controller->command.inlet_flux, &controller->line);
    if ((controller->state == STATE_READY) && !controller->trusted.level_is_new) {
        return feed_nothing(command, BELT_NO_LEVEL, controller->trusted.error_bits);
    }
    const belt_real_t speed_before = record_level(controller);
    move_belt(controller, speed_before, measurement);
    controller->state = STATE_RUNNING;

    belt_predictor_march(&controller->prediction, &controller->line, &controller->history,
                         &controller->observer, &controller->present,
                         controller->config.prediction);
    const belt_real_t flux =
        belt_command_solve(&controller->prediction, &controller->line, &controller->history,
                           &controller->law, &controller->present);

    controller->command.inlet_flux = belt_command_limit(flux, controller->config.inlet_flux_max);
    controller->command.mode = BELT_MODE_AUTOMATIC;
    controller->command.error_bits = controller->trusted.error_bits;
    *command = controller->command;
    return (command->error_bits == 0u) ? BELT_OK : BELT_INPUT_REJECTED;
}

belt_status_t belt_set_setpoint(belt_controller_t *controller, belt_real_t level_setpoint) {
    BELT_ASSERT(is_ready(controller));
    if (!is_ready(controller)) {
        return BELT_MISUSE;
    }
    const belt_real_t before = controller->config.level_setpoint;
    controller->config.level_setpoint = level_setpoint;
    const belt_status_t status = belt_config_check(&controller->config, NULL);
    if (status != BELT_OK) {
        controller->config.level_setpoint = before;
        return status;
    }
    belt_nominal_law_init(&controller->law, &controller->config);
    return BELT_OK;
}
