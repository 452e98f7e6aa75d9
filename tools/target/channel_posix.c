/* SPDX-License-Identifier: MIT */
#define _POSIX_C_SOURCE 200809L
#include "channel_port.h"

#include <fcntl.h>
#include <unistd.h>

int channel_port_open(const char *name, bool is_written) {
    return is_written ? open(name, O_WRONLY | O_CREAT | O_TRUNC, 0666) : open(name, O_RDONLY);
}

size_t channel_port_read(int channel, void *bytes, size_t size) {
    const ssize_t got = read(channel, bytes, size);
    return (got > 0) ? (size_t)got : 0;
}

bool channel_port_write(int channel, const void *bytes, size_t size) {
    return write(channel, bytes, size) == (ssize_t)size;
}
