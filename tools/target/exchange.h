/* SPDX-License-Identifier: MIT */
/*
 * exchange.h - the calls of belt.h and snapshot.h as messages between two programs.
 *
 * A message is words of 32 bits, the lowest byte first: what it is (a call, or the status that a call
 * returned), how many words follow, those words. Numbers are float32, bit for bit. A call is followed
 * by its reply, whose words are all that the trace of a run shows of the controller.
 *
 * Each list of fields stands here once: the same function writes a message and reads it.
 */
#ifndef TARGET_EXCHANGE_H
#define TARGET_EXCHANGE_H

#include "belt/belt.h"

#if BELT_REAL_IS_DOUBLE
#error "the exchange speaks float32"
#endif

typedef enum {
    EXCHANGE_INIT = 1,
    EXCHANGE_STEP,
    EXCHANGE_SETPOINT,
    EXCHANGE_MODE,
    EXCHANGE_MANUAL_FLUX,
    EXCHANGE_TAKE,   /**< a snapshot, into the target's own slots. */
    EXCHANGE_RESTORE /**< from them, after the controller's memory has been overwritten. */
} exchange_call_t;

/** The longest message: a reply with the observer's three rings, or a configuration. */
#define EXCHANGE_CAPACITY (3 * BELT_CELL_CAPACITY + BELT_LOSS_CAPACITY + 64)

typedef struct {
    uint32_t what;
    uint32_t count;
    uint32_t word[EXCHANGE_CAPACITY];
} exchange_message_t;

/** A message on its way: written from its start, or read from there. */
typedef struct {
    exchange_message_t *message;
    uint32_t at;
    bool is_written;
    bool is_sound; /**< false once it was too short or too long. */
} exchange_t;

exchange_t exchange_write(exchange_message_t *message, uint32_t what);
exchange_t exchange_read(exchange_message_t *message);

/** Ends it: the message has its length, or was read to its end. Returns whether all is well. */
bool exchange_end(exchange_t *exchange);

void exchange_word(exchange_t *exchange, uint32_t *value);
void exchange_real(exchange_t *exchange, belt_real_t *value);
void exchange_config(exchange_t *exchange, belt_config_t *config);

/** `profile` has room for BELT_NODE_CAPACITY + 1 densities; a measurement that is read points to it. */
void exchange_measurement(exchange_t *exchange, belt_measurement_t *measurement,
                          belt_real_t *profile, uint32_t node_count);

/** The last step's command, and what a trace shows of the controller's state. The line must be derived on
 * both sides. */
void exchange_state(exchange_t *exchange, belt_controller_t *controller, belt_command_t *command);

#endif
