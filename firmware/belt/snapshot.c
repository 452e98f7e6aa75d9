/* SPDX-License-Identifier: MIT */
#include "snapshot.h"

#include <string.h>

#define STATE_BEGIN offsetof(belt_controller_t, model.history)

uint32_t belt_snapshot_crc(uint32_t crc, const void *bytes, size_t size) {
    /* Remainders of the 16 half bytes. */
    static const uint32_t half[16] = {0x00000000u, 0x1DB71064u, 0x3B6E20C8u, 0x26D930ACu,
                                      0x76DC4190u, 0x6B6B51F4u, 0x4DB26158u, 0x5005713Cu,
                                      0xEDB88320u, 0xF00F9344u, 0xD6D6A3E8u, 0xCB61B38Cu,
                                      0x9B64C2B0u, 0x86D3D2D4u, 0xA00AE278u, 0xBDBDF21Cu};
    const unsigned char *byte = bytes;
    crc = ~crc;
    for (size_t i = 0; i < size; ++i) {
        crc ^= byte[i];
        crc = (crc >> 4) ^ half[crc & 0xFu];
        crc = (crc >> 4) ^ half[crc & 0xFu];
    }
    return ~crc;
}

static uint32_t crc_of_real(uint32_t crc, belt_real_t value) {
    return belt_snapshot_crc(crc, &value, sizeof value);
}

static uint32_t crc_of_count(uint32_t crc, uint32_t value) {
    return belt_snapshot_crc(crc, &value, sizeof value);
}

/** CRC of every field but the set-point; of fields, as the gaps between them may hold anything. */
static uint32_t crc_of_config(const belt_config_t *config) {
    const belt_real_t reals[] = {
        config->belt_length,      config->processing_time, config->speed_window,
        config->congestion_scale, config->connectivity,    config->service_rate_max,
        config->service_time,     config->level_capacity,  config->rework_rate,
        config->nominal_flux_max, config->slope,           config->period,
        config->inlet_flux_max,   config->estimator_time,  config->flux_rate_max,
        config->substitute_flux,  config->level_step_max,  config->transfer_time};
    const uint32_t counts[] = {config->loss_count,          (uint32_t)config->slope_kind,
                               config->node_count,          (uint32_t)config->prediction,
                               (uint32_t)config->estimator, config->sample_periods,
                               config->hold_periods,        config->recovery_samples};
    uint32_t crc = 0;
    for (size_t i = 0; i < sizeof reals / sizeof reals[0]; ++i) {
        crc = crc_of_real(crc, reals[i]);
    }
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; ++i) {
        crc = crc_of_count(crc, counts[i]);
    }
    for (uint32_t i = 0; i < config->loss_count; ++i) {
        crc = crc_of_real(crc, config->loss_rate[i]);
    }
    return crc;
}

static uint32_t crc_of_slot(const belt_snapshot_t *slot) {
    return belt_snapshot_crc(0, slot, offsetof(belt_snapshot_t, crc));
}

static bool is_valid(const belt_snapshot_t *slot, uint32_t configuration) {
    return (slot->layout == BELT_SNAPSHOT_LAYOUT) && (slot->size == sizeof *slot) &&
           (slot->configuration == configuration) && (slot->crc == crc_of_slot(slot));
}

/** Index of the newer valid slot; 2 if there is none. */
static uint32_t newest(const belt_snapshot_t slots[2], uint32_t configuration) {
    const bool first = is_valid(&slots[0], configuration);
    const bool second = is_valid(&slots[1], configuration);
    if (first && second) {
        /* Sequences wrap: the newer one is less than half a turn ahead. */
        return ((slots[1].sequence - slots[0].sequence) < 0x80000000u) ? 1u : 0u;
    }
    return first ? 0u : (second ? 1u : 2u);
}

belt_status_t belt_snapshot_take(const belt_controller_t *controller, belt_snapshot_t slots[2]) {
    BELT_ASSERT((controller != NULL) && (slots != NULL));
    if ((controller == NULL) || (slots == NULL) || !belt_is_running(controller)) {
        return BELT_NO_SNAPSHOT;
    }
    const uint32_t configuration = crc_of_config(&controller->config);
    const uint32_t last = newest(slots, configuration);
    belt_snapshot_t *slot = &slots[(last == 0u) ? 1u : 0u];
    memset(slot, 0, sizeof *slot);
    slot->layout = BELT_SNAPSHOT_LAYOUT;
    slot->size = sizeof *slot;
    slot->sequence = (last < 2u) ? slots[last].sequence + 1u : 1u;
    slot->configuration = configuration;
    slot->level_setpoint = controller->config.level_setpoint;
    memcpy(slot->state, (const unsigned char *)controller + STATE_BEGIN, BELT_STATE_SIZE);
    slot->crc = crc_of_slot(slot);
    return BELT_OK;
}

/** What outlives a long stop is carried over into a controller that begins anew. */
static belt_status_t begin_anew(belt_controller_t *controller) {
    const belt_supervisor_t supervisor = controller->supervisor;
    const belt_real_t disturbance = controller->model.estimator.disturbance;
    (void)belt_init(controller, &controller->config);
    (void)belt_set_mode(controller, supervisor.requested);
    (void)belt_set_manual_flux(controller, supervisor.manual_flux);
    controller->model.estimator.disturbance = disturbance;
    controller->short_history = controller->model.history.length;
    return BELT_SNAPSHOT_OLD;
}

/** Takes on what a valid slot says. False when no controller can have written it: then nothing is left
 * to go on with. */
static bool adopt(belt_controller_t *controller, const belt_config_t *config,
                  const belt_snapshot_t *slot) {
    belt_config_t restored = *config;
    restored.level_setpoint = slot->level_setpoint;
    if (belt_init(controller, &restored) != BELT_OK) {
        return false;
    }
    unsigned char *state = (unsigned char *)controller + STATE_BEGIN;
    /* What is derived of the history is not taken from a slot. */
    const bool is_ours = memcmp(slot->state, state, offsetof(belt_level_history_t, base)) == 0;
    memcpy(state, slot->state, BELT_STATE_SIZE);
    if (!is_ours || !belt_is_running(controller)) {
        controller->state = 0;
        return false;
    }
    return true;
}

belt_status_t belt_snapshot_restore(belt_controller_t *controller, const belt_config_t *config,
                                    const belt_snapshot_t slots[2], uint32_t down_periods) {
    const bool is_usable = (controller != NULL) && (config != NULL) && (slots != NULL);
    BELT_ASSERT(is_usable);
    if (!is_usable) {
        return BELT_MISUSE;
    }
    const belt_status_t status = belt_config_check(config, NULL);
    if (status != BELT_OK) {
        return status;
    }
    const uint32_t index = newest(slots, crc_of_config(config));
    if ((index > 1u) || !adopt(controller, config, &slots[index])) {
        return BELT_NO_SNAPSHOT;
    }
    if (down_periods >= BELT_CATCH_UP_PERIODS) { /* the next step has its own period besides */
        return begin_anew(controller);
    }
    controller->gate.owed_periods = down_periods;
    if (down_periods >= controller->model.history.whole) {
        controller->short_history = controller->model.history.length;
    }
    return BELT_OK;
}
