/* SPDX-License-Identifier: MIT */
#include "exchange.h"

#include <string.h>

exchange_t exchange_write(exchange_message_t *message, uint32_t what) {
    const exchange_t exchange = {message, 0, true, true};
    message->what = what;
    message->count = 0;
    return exchange;
}

exchange_t exchange_read(exchange_message_t *message) {
    const exchange_t exchange = {message, 0, false, true};
    return exchange;
}

bool exchange_end(exchange_t *exchange) {
    if (exchange->is_written) {
        exchange->message->count = exchange->at;
    }
    return exchange->is_sound && (exchange->at == exchange->message->count);
}

void exchange_word(exchange_t *exchange, uint32_t *value) {
    const uint32_t end = exchange->is_written ? EXCHANGE_CAPACITY : exchange->message->count;
    if (exchange->at >= end) {
        exchange->is_sound = false;
        return;
    }
    uint32_t *const word = &exchange->message->word[exchange->at];
    if (exchange->is_written) {
        *word = *value;
    } else {
        *value = *word;
    }
    exchange->at += 1;
}

void exchange_real(exchange_t *exchange, belt_real_t *value) {
    uint32_t word;
    memcpy(&word, value, sizeof word);
    exchange_word(exchange, &word);
    memcpy(value, &word, sizeof word);
}

static void reals(exchange_t *exchange, belt_real_t *value, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) {
        exchange_real(exchange, &value[i]);
    }
}

/** A number of 16 bits, or one of an enumeration, as a word. */
static uint32_t as_word(exchange_t *exchange, uint32_t value) {
    exchange_word(exchange, &value);
    return value;
}

void exchange_config(exchange_t *exchange, belt_config_t *config) {
    belt_real_t *const number[] = {
        &config->belt_length,      &config->processing_time,  &config->speed_window,
        &config->congestion_scale, &config->connectivity,     &config->service_rate_max,
        &config->service_time,     &config->level_capacity,   &config->rework_rate,
        &config->level_setpoint,   &config->nominal_flux_max, &config->slope,
        &config->period,           &config->inlet_flux_max,   &config->estimator_time,
        &config->flux_rate_max,    &config->substitute_flux,  &config->level_step_max,
        &config->transfer_time};
    uint16_t *const count[] = {&config->node_count, &config->sample_periods, &config->hold_periods,
                               &config->recovery_samples, &config->loss_count};
    for (size_t i = 0; i < sizeof number / sizeof number[0]; ++i) {
        exchange_real(exchange, number[i]);
    }
    for (size_t i = 0; i < sizeof count / sizeof count[0]; ++i) {
        *count[i] = (uint16_t)as_word(exchange, *count[i]);
    }
    config->slope_kind = (belt_slope_kind_t)as_word(exchange, (uint32_t)config->slope_kind);
    config->prediction = (belt_prediction_kind_t)as_word(exchange, (uint32_t)config->prediction);
    config->estimator = (belt_estimator_kind_t)as_word(exchange, (uint32_t)config->estimator);
    /* A profile longer than this build holds is refused by the rule LOSS_COUNT. */
    for (uint32_t i = 0; i < config->loss_count; ++i) {
        belt_real_t beyond = BELT_REAL(0);
        exchange_real(exchange, (i < BELT_LOSS_CAPACITY) ? &config->loss_rate[i] : &beyond);
    }
}

void exchange_measurement(exchange_t *exchange, belt_measurement_t *measurement,
                          belt_real_t *profile, uint32_t node_count) {
    exchange_word(exchange, &measurement->present);
    exchange_real(exchange, &measurement->level);
    exchange_real(exchange, &measurement->outlet_flux);
    exchange_real(exchange, &measurement->applied_flux);
    exchange_word(exchange, &measurement->sample_count);
    exchange_word(exchange, &measurement->elapsed_ticks);
    if (!exchange->is_written) {
        measurement->density = profile;
    } else if (measurement->density != NULL) {
        memcpy(profile, measurement->density, (node_count + 1u) * sizeof profile[0]);
    }
    if ((measurement->present & BELT_HAS_DENSITY) != 0u) {
        reals(exchange, profile, node_count + 1u);
    }
}

void exchange_state(exchange_t *exchange, belt_controller_t *controller, belt_command_t *command) {
    belt_prediction_t *const prediction = &controller->prediction;
    belt_observer_t *const observer = &controller->model.observer;
    exchange_real(exchange, &command->inlet_flux);
    command->mode = (belt_mode_t)as_word(exchange, (uint32_t)command->mode);
    exchange_word(exchange, &command->error_bits);
    exchange_real(exchange, &controller->config.level_setpoint);
    exchange_real(exchange, &prediction->inlet.level);
    exchange_real(exchange, &prediction->inlet.arrival);
    exchange_real(exchange, &prediction->inlet_survival);
    exchange_real(exchange, &controller->model.estimator.disturbance);
    exchange_real(exchange, &controller->model.present.level);
    exchange_real(exchange, &controller->gate.level_quality);
    exchange_word(exchange, &observer->outlet);
    exchange_real(exchange, &observer->gone);
    reals(exchange, observer->density, controller->model.line.cell_slots);
    reals(exchange, observer->step, controller->model.line.cell_slots);
    reals(exchange, observer->cut, controller->model.line.cell_slots);
}
