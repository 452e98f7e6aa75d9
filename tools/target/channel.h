/* SPDX-License-Identifier: MIT */
/*
 * channel.h - files that messages come from and go to: on the PC by POSIX, on an emulated board by
 * semihosting, which lets it open the PC's files in the folder the emulator runs in. A pipe with a name
 * is such a file.
 */
#ifndef TARGET_CHANNEL_H
#define TARGET_CHANNEL_H

#include "exchange.h"

/** Opens a file to read or to write; waits for the other end of a pipe. Negative: it cannot. */
int channel_open(const char *name, bool is_written);

/** The next message; false at the end of the file, or where it holds no message. */
bool channel_receive(int channel, exchange_message_t *message);

bool channel_send(int channel, const exchange_message_t *message);

#endif
