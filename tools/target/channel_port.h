/* SPDX-License-Identifier: MIT */
/*
 * channel_port.h - what differs from the PC to the emulated board; for channel.c.
 */
#ifndef TARGET_CHANNEL_PORT_H
#define TARGET_CHANNEL_PORT_H

#include <stdbool.h>
#include <stddef.h>

int channel_port_open(const char *name, bool is_written);

/** Up to `size` bytes; returns how many, 0 at the end or on an error. */
size_t channel_port_read(int channel, void *bytes, size_t size);

bool channel_port_write(int channel, const void *bytes, size_t size);

#endif
