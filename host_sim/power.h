/* SPDX-License-Identifier: MIT */
/*
 * power.h - snapshots of the controller in a memory that outlives a power cut, and the restart from
 * them.
 *
 * A snapshot is taken behind a step, the first one at once and then every snapshot_period; behind the
 * run's last cut none are, since nobody would read them. A clock that goes on without power tells how
 * long the controller was down.
 */
#ifndef HOST_SIM_POWER_H
#define HOST_SIM_POWER_H

#include <stdbool.h>
#include <stddef.h>

#include "belt/belt.h"
#include "belt/snapshot.h"
#include "scenario.h"

typedef struct {
    belt_snapshot_t slots[2];
    size_t interval; /**< periods between two snapshots; 0: none are taken. */
    size_t due;      /**< period from which on the next one is taken. */
    size_t end;      /**< period from which on none is. */
    size_t last;     /**< period of the last one. */
} power_t;

/** No snapshot yet. */
void power_begin(power_t *self, const scenario_t *scenario);

/** Behind the step of period `index`: takes a snapshot when one is due. */
void power_keep(power_t *self, const belt_controller_t *controller, size_t index);

/** Before the first step after a cut, in period `index`: whatever the memory holds, the controller is
 * restored from the newest snapshot or, when there is none, initialised. False when the controller
 * refuses both. */
bool power_restart(power_t *self, belt_controller_t *controller, const belt_config_t *config,
                   size_t index);

#endif
