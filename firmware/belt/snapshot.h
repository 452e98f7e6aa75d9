/* SPDX-License-Identifier: MIT */
/*
 * snapshot.h - a warm restart: what the controller knows, kept over a power cut.
 *
 *     static belt_snapshot_t slots[2];              // in memory that survives
 *     now and then, after a step:  belt_snapshot_take(&controller, slots);
 *     at start-up:                 status = belt_snapshot_restore(&controller, &config, slots, down);
 *     if (status == BELT_NO_SNAPSHOT) status = belt_init(&controller, &config);
 *
 * There are two slots, and always the older is overwritten: wherever the power goes while one is
 * written, the other is whole. A slot counts only if its layout and size are this build's, its
 * configuration (but for the set-point) is the one given, and its CRC-32 holds. The CRC finds torn
 * writes and flipped bits; it does not prove who wrote the slot.
 *
 * What a stop invalidates: after a stop of fewer than BELT_CATCH_UP_PERIODS the next step makes up for it,
 * with the flux applied as measured, or else the last command. After a longer one nobody knows what
 * lies on the belt or how full the buffer was: set-point, mode asked for, manual flux and disturbance
 * are kept, the belt counts as empty unless the first measurement brings a density profile, and
 * the first level fills the history. BELT_ERROR_HISTORY_SHORT is set until a whole speed_window has
 * been seen again.
 *
 * Cost: take and restore compute up to three CRCs of a slot, about 30 instructions a byte: for a slow
 * task, between two steps. Memory: a slot is as large as the controller's state.
 */
#ifndef BELT_SNAPSHOT_H
#define BELT_SNAPSHOT_H

#include "belt.h"

/** Changes whenever the meaning of a slot's bytes does. */
#define BELT_SNAPSHOT_LAYOUT 2u

/** Bytes of the controller that are its state. */
#define BELT_STATE_SIZE                                                                            \
    (offsetof(belt_controller_t, trusted) - offsetof(belt_controller_t, model.history))

typedef struct {
    uint32_t layout;        /**< BELT_SNAPSHOT_LAYOUT. */
    uint32_t size;          /**< of the whole slot in bytes: the build's capacities and number. */
    uint32_t sequence;      /**< one more with each snapshot; may wrap. */
    uint32_t configuration; /**< CRC-32 of the configuration but for the set-point. */
    belt_real_t level_setpoint; /**< [parts]. */
    unsigned char state[BELT_STATE_SIZE];
    uint32_t crc; /**< CRC-32 of all bytes before. */
} belt_snapshot_t;

/** CRC-32 (reflected, polynomial 0xEDB88320, as in IEEE 802.3) of some bytes, going on from `crc`;
 * begin with 0. */
uint32_t belt_snapshot_crc(uint32_t crc, const void *bytes, size_t size);

/** Writes into the older slot what `controller` knows, between two steps. A controller that is not
 * running (belt_init not passed, no level yet, BELT_CORRUPT, a changed configuration) is not written:
 * the slots stay. Returns BELT_OK, or BELT_NO_SNAPSHOT where nothing was written. */
belt_status_t belt_snapshot_take(const belt_controller_t *controller, belt_snapshot_t slots[2]);

/**
 * Starts a controller from the newer of the valid slots. `down_periods` is the number of control
 * periods since the step after which the snapshot was taken, the next step's own not counted: those
 * it still made before the power went, too. The set-point is the snapshot's, whatever the
 * configuration says; the command begins at the last one. Returns
 *   BELT_OK            it goes on; with down_periods 0 to the bit as if nothing had been;
 *   BELT_SNAPSHOT_OLD  it goes on with what a long stop leaves;
 *   BELT_NO_SNAPSHOT   no slot is valid: the controller is as it was; or one is, by its CRC, and yet
 *                      holds what no controller writes: the controller then is to be initialised;
 *   BELT_MISUSE, or the broken rule's code of the configuration: the controller is as it was.
 */
belt_status_t belt_snapshot_restore(belt_controller_t *controller, const belt_config_t *config,
                                    const belt_snapshot_t slots[2], uint32_t down_periods);

#endif
