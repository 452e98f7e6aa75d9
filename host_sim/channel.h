/* SPDX-License-Identifier: MIT */
/*
 * channel.h - one signal on its way, past the faults that the scenario lays on it.
 *
 * A signal is one number or, for a density profile, several. Each fault is a station of its own with
 * its own memory and stream of chance; the signal passes them in the order stated, once a period.
 */
#ifndef HOST_SIM_CHANNEL_H
#define HOST_SIM_CHANNEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "chance.h"
#include "fault.h"

/** What is under way in one period. */
typedef struct {
    double *value;   /**< as many as the channel is wide. */
    bool is_present; /**< false: nothing arrives, and the rest means nothing. */
    bool is_garbage; /**< the numbers are random bits, to be read as the receiver's numbers. */
    uint32_t sample_count; /**< goes up with each new sample. */
} signal_t;

/** One fault and what it remembers. */
typedef struct {
    const fault_t *fault;
    chance_t chance;
    signal_t *kept;    /**< delayed: a ring of the newest; else one: what went on last. */
    double *numbers;   /**< room for the values of all that is kept. */
    size_t kept_count; /**< signals in `kept`. */
    size_t taken;      /**< periods passed, which is where the ring stands. */
    size_t delivered;  /**< delayed: the period whose signal went on last. */
    bool has_kept;     /**< false until something has passed. */
} station_t;

typedef struct {
    size_t width; /**< numbers in the signal. */
    double period;
    station_t station[FAULT_CAPACITY];
    size_t station_count;
} channel_t;

/** The faults on one signal. */
typedef struct {
    const fault_t *faults; /**< all of the run's, must outlive the channel. */
    size_t count;
    fault_signal_t signal;
    uint32_t seed;
    double period; /**< [s]. */
} channel_setup_t;

/** Prepares a channel for signals of `width` numbers. False when memory lacks; destroy it all the
 * same. */
bool channel_create(channel_t *self, const channel_setup_t *setup, size_t width);

void channel_destroy(channel_t *self);

/** Passes the signal of period `index` through, in place. Once each period, in order. */
void channel_pass(channel_t *self, size_t index, signal_t *signal);

/** Makes every station's memory this signal, as if nothing else had passed before. */
void channel_settle(channel_t *self, const signal_t *signal);

#endif
