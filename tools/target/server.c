/* SPDX-License-Identifier: MIT */
/*
 * server.c - a controller that others call from outside: reads calls from the file `request` in the
 * folder it (or its emulator) runs in, and writes a reply to each into the file `reply`. Ends where the
 * requests end. Exit 0 done, 1 a message was none, or a file could not be opened.
 */
#include <string.h>

#include "belt/snapshot.h"
#include "channel.h"

/* A board with too little memory has none; then no snapshot is taken. */
#ifndef SERVER_SLOTS
#define SERVER_SLOTS 2
#endif

/* What the memory holds after a power cut is anything: here this. */
#define MEMORY_AFTER_A_CUT 0xA5

static belt_controller_t controller;
static belt_config_t config;
static belt_command_t command; /* the last step's */
static belt_real_t profile[BELT_NODE_CAPACITY + 1];
static exchange_message_t message;
#if SERVER_SLOTS
static belt_snapshot_t slots[2];
#endif

/* Kept in one piece, so that what a step takes is counted from its call to its return. */
__attribute__((noinline)) belt_status_t server_step(const belt_measurement_t *measurement,
                                                    belt_command_t *answer);

#ifdef SERVER_COUNTS
#include "server_counts.h"

belt_status_t server_step(const belt_measurement_t *measurement, belt_command_t *answer) {
    server_before_step();
    const belt_status_t status = belt_step(&controller, measurement, answer);
    server_after_step();
    return status;
}
#else
belt_status_t server_step(const belt_measurement_t *measurement, belt_command_t *answer) {
    return belt_step(&controller, measurement, answer);
}
#endif

static belt_status_t step(exchange_t *call) {
    belt_measurement_t measurement;
    exchange_measurement(call, &measurement, profile, config.node_count);
    return server_step(&measurement, &command);
}

#if SERVER_SLOTS
static belt_status_t take(void) {
    (void)belt_snapshot_take(&controller, slots);
    return BELT_OK;
}

static belt_status_t restore(uint32_t down_periods) {
    memset(&controller, MEMORY_AFTER_A_CUT, sizeof controller);
    return belt_snapshot_restore(&controller, &config, slots, down_periods);
}
#else
static belt_status_t take(void) {
    return BELT_MISUSE;
}

static belt_status_t restore(uint32_t down_periods) {
    (void)down_periods;
    return BELT_MISUSE;
}
#endif

/** Makes the call in the message; its status. */
static belt_status_t answer(exchange_t *call) {
    belt_real_t number = BELT_REAL(0);
    uint32_t word = 0;
    switch ((exchange_call_t)message.what) {
        case EXCHANGE_INIT: exchange_config(call, &config); return belt_init(&controller, &config);
        case EXCHANGE_STEP: return step(call);
        case EXCHANGE_SETPOINT:
            exchange_real(call, &number);
            return belt_set_setpoint(&controller, number);
        case EXCHANGE_MODE:
            exchange_word(call, &word);
            return belt_set_mode(&controller, (belt_mode_t)word);
        case EXCHANGE_MANUAL_FLUX:
            exchange_real(call, &number);
            return belt_set_manual_flux(&controller, number);
        case EXCHANGE_TAKE: return take();
        case EXCHANGE_RESTORE: exchange_word(call, &word); return restore(word);
    }
    call->is_sound = false;
    return BELT_MISUSE;
}

int main(void) {
#ifdef SERVER_COUNTS
    server_before_step(); /* the first count is that of nothing */
    server_after_step();
#endif
    const int requests = channel_open("request", false);
    const int replies = channel_open("reply", true);
    bool is_well = (requests >= 0) && (replies >= 0);
    while (is_well && channel_receive(requests, &message)) {
        exchange_t call = exchange_read(&message);
        const belt_status_t status = answer(&call);
        is_well = exchange_end(&call);
        exchange_t reply = exchange_write(&message, (uint32_t)status);
        exchange_state(&reply, &controller, &command);
        is_well = is_well && exchange_end(&reply) && channel_send(replies, &message);
    }
    return is_well ? 0 : 1;
}
