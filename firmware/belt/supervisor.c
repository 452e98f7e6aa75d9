/* SPDX-License-Identifier: MIT */
#include "supervisor.h"

typedef struct {
    uint8_t to;       /**< belt_mode_t. */
    uint8_t transfer; /**< belt_transfer_kind_t. */
} transition_t;

#define TRANSITION(from, event, to, transfer)                                                      \
    [BELT_MODE_##from][BELT_EVENT_##event] = {BELT_MODE_##to, BELT_TRANSFER_##transfer},
static const transition_t transitions[BELT_MODE_COUNT][BELT_EVENT_COUNT] = {
    BELT_TRANSITIONS(TRANSITION)};

void belt_supervisor_init(belt_supervisor_t *supervisor) {
    supervisor->requested = BELT_MODE_AUTOMATIC;
    supervisor->manual_flux = BELT_REAL(0);
    supervisor->bump = BELT_REAL(0);
}

belt_event_t belt_supervisor_event(const belt_supervisor_t *supervisor,
                                   belt_level_health_t health) {
    if (supervisor->requested == BELT_MODE_AUTOMATIC) {
        switch (health) {
            case BELT_LEVEL_TRUSTED: return BELT_EVENT_TRUSTED;
            case BELT_LEVEL_DOUBTED: return BELT_EVENT_DOUBTED;
            case BELT_LEVEL_LOST: break;
        }
        return BELT_EVENT_LOST;
    }
    return (supervisor->requested == BELT_MODE_MANUAL) ? BELT_EVENT_MANUAL : BELT_EVENT_OFF;
}

/** The mode's own command, before limits [parts/s]. */
static belt_real_t own_flux(const belt_supervisor_t *supervisor, const belt_limits_t *limits,
                            belt_mode_t mode, belt_real_t law_flux) {
    switch (mode) {
        case BELT_MODE_MANUAL: return supervisor->manual_flux;
        case BELT_MODE_AUTOMATIC:
        case BELT_MODE_HOLD: return law_flux;
        case BELT_MODE_SUBSTITUTE: return limits->substitute_flux;
        default: return BELT_REAL(0); /* off */
    }
}

/** What is left of a bump a period later. */
static belt_real_t fading(belt_real_t bump, const belt_limits_t *limits) {
    const bool is_seen = (bump > limits->bump_min) || (bump < -limits->bump_min);
    return is_seen ? bump * limits->transfer_kept : BELT_REAL(0);
}

void belt_supervisor_decide(belt_supervisor_t *supervisor, belt_command_t *command,
                            const belt_limits_t *limits, belt_event_t event, belt_real_t law_flux) {
    const transition_t transition = transitions[command->mode][event];
    const belt_mode_t mode = (belt_mode_t)transition.to;
    const belt_real_t last = command->inlet_flux;
    const belt_real_t own =
        belt_command_limit(own_flux(supervisor, limits, mode, law_flux), limits->inlet_flux_max);
    switch ((belt_transfer_kind_t)transition.transfer) {
        case BELT_TRANSFER_NONE: supervisor->bump = fading(supervisor->bump, limits); break;
        case BELT_TRANSFER_AT_ONCE: supervisor->bump = BELT_REAL(0); break;
        default: supervisor->bump = last - own; break; /* bumpless */
    }
    const belt_real_t gradual = belt_within(last - limits->flux_step_max, own + supervisor->bump,
                                            last + limits->flux_step_max);
    command->mode = mode;
    command->inlet_flux = belt_command_limit(gradual, limits->inlet_flux_max);
}
