/* SPDX-License-Identifier: MIT */
/*
 * remote.c - the calls of belt.h and snapshot.h, answered by a controller elsewhere: the simulator
 * linked with this file instead of the library's own belt.c and snapshot.c has its controller at the
 * other end of two pipes, `request` and `reply`, in the folder that BELT_REMOTE names. Both directions
 * are also kept there, as `requests` and `replies`.
 *
 * The belt_controller_t on this side computes nothing. Of it, the trace shows what the replies bring.
 */
#define _POSIX_C_SOURCE 200809L
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "belt/snapshot.h"
#include "channel.h"

/* The exit code when the other side has no room for this scenario. */
#define NO_ROOM 3

typedef struct {
    int requests;
    int replies;
    int kept_requests;
    int kept_replies;
    bool is_open;
} remote_t;

static remote_t remote;
static exchange_message_t message;
static belt_real_t profile[BELT_NODE_CAPACITY + 1];

static void fail(const char *what) {
    (void)fflush(stdout);
    fprintf(stderr, "remote controller: %s\n", what);
    _exit(1);
}

static int open_in_folder(const char *name, bool is_written) {
    const char *const folder = getenv("BELT_REMOTE");
    char path[4096];
    if (folder == NULL) {
        fail("BELT_REMOTE names no folder");
    }
    if ((size_t)snprintf(path, sizeof path, "%s/%s", folder, name) >= sizeof path) {
        fail("the folder's name is too long");
    }
    const int channel = channel_open(path, is_written);
    if (channel < 0) {
        fail("a file in its folder cannot be opened");
    }
    return channel;
}

static void open_once(void) {
    if (!remote.is_open) {
        (void)signal(SIGPIPE, SIG_IGN);
        remote.kept_requests = open_in_folder("requests", true);
        remote.kept_replies = open_in_folder("replies", true);
        remote.requests = open_in_folder("request", true);
        remote.replies = open_in_folder("reply", false);
        remote.is_open = true;
    }
}

/** Sends the call, waits for the reply. */
static belt_status_t call(exchange_t *exchange) {
    open_once();
    if (!exchange_end(exchange)) {
        fail("a call does not fit a message");
    }
    if (!channel_send(remote.requests, &message) || !channel_send(remote.kept_requests, &message)) {
        fail("a call was not taken");
    }
    if (!channel_receive(remote.replies, &message) ||
        !channel_send(remote.kept_replies, &message)) {
        fail("no reply came");
    }
    return (belt_status_t)message.what;
}

/** Takes over what the reply says of the controller. */
static belt_status_t adopt(belt_controller_t *controller, belt_status_t status) {
    exchange_t reply = exchange_read(&message);
    const belt_real_t before = controller->config.level_setpoint;
    exchange_state(&reply, controller, &controller->command);
    if (!exchange_end(&reply)) {
        fail("a reply was not of the length of this configuration");
    }
    const belt_real_t now = controller->config.level_setpoint;
    if ((now < before) || (now > before)) {
        belt_nominal_law_init(&controller->law, &controller->config);
    }
    return status;
}

/** What this side derives by itself: it judges the run by it, and compares laws with it. */
static void derive(belt_controller_t *controller, const belt_config_t *config) {
    controller->config = *config;
    belt_nominal_law_init(&controller->law, config);
    belt_line_init(&controller->model.line, config);
}

belt_status_t belt_init(belt_controller_t *controller, const belt_config_t *config) {
    belt_config_t sent = *config;
    const belt_status_t here = belt_config_check(config, NULL);
    if (here != BELT_OK) {
        return here; /* it gets no line at all: the message is the same without */
    }
    exchange_t exchange = exchange_write(&message, EXCHANGE_INIT);
    exchange_config(&exchange, &sent);
    const belt_status_t status = call(&exchange);
    if ((status == BELT_NODE_COUNT) || (status == BELT_WINDOW_LONG) ||
        (status == BELT_LOSS_COUNT)) {
        fprintf(stderr, "remote controller: no room: %s\n", belt_status_name(status));
        _exit(NO_ROOM);
    }
    if (status != BELT_OK) {
        return status;
    }
    memset(controller, 0, sizeof *controller);
    derive(controller, config);
    return adopt(controller, status);
}

belt_status_t belt_step(belt_controller_t *controller, const belt_measurement_t *measurement,
                        belt_command_t *command) {
    belt_measurement_t sent = *measurement;
    exchange_t exchange = exchange_write(&message, EXCHANGE_STEP);
    exchange_measurement(&exchange, &sent, profile, controller->config.node_count);
    const belt_status_t status = adopt(controller, call(&exchange));
    *command = controller->command;
    return status;
}

belt_status_t belt_set_setpoint(belt_controller_t *controller, belt_real_t level_setpoint) {
    exchange_t exchange = exchange_write(&message, EXCHANGE_SETPOINT);
    exchange_real(&exchange, &level_setpoint);
    return adopt(controller, call(&exchange));
}

belt_status_t belt_set_mode(belt_controller_t *controller, belt_mode_t mode) {
    exchange_t exchange = exchange_write(&message, EXCHANGE_MODE);
    uint32_t word = (uint32_t)mode;
    exchange_word(&exchange, &word);
    return adopt(controller, call(&exchange));
}

belt_status_t belt_set_manual_flux(belt_controller_t *controller, belt_real_t inlet_flux) {
    exchange_t exchange = exchange_write(&message, EXCHANGE_MANUAL_FLUX);
    exchange_real(&exchange, &inlet_flux);
    return adopt(controller, call(&exchange));
}

/* What `check` asks of the controller's memory, which is the other side's. */
bool belt_is_running(const belt_controller_t *controller) {
    (void)controller;
    return false;
}

/* The slots are the other side's. */
belt_status_t belt_snapshot_take(const belt_controller_t *controller, belt_snapshot_t slots[2]) {
    (void)controller;
    (void)slots;
    exchange_t exchange = exchange_write(&message, EXCHANGE_TAKE);
    if (call(&exchange) != BELT_OK) {
        fail("the target has no memory for snapshots");
    }
    return BELT_OK;
}

belt_status_t belt_snapshot_restore(belt_controller_t *controller, const belt_config_t *config,
                                    const belt_snapshot_t slots[2], uint32_t down_periods) {
    (void)slots;
    exchange_t exchange = exchange_write(&message, EXCHANGE_RESTORE);
    exchange_word(&exchange, &down_periods);
    const belt_status_t status = call(&exchange);
    if ((status != BELT_OK) && (status != BELT_SNAPSHOT_OLD)) {
        return status;
    }
    memset(controller, 0, sizeof *controller);
    derive(controller, config);
    return adopt(controller, status);
}
