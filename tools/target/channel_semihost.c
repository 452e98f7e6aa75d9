/* SPDX-License-Identifier: MIT */
#include <semihost.h>

#include "channel_port.h"

int channel_port_open(const char *name, bool is_written) {
    return sys_semihost_open(name, is_written ? SH_OPEN_W_B : SH_OPEN_R_B);
}

/* Semihosting says how many bytes are left. */
size_t channel_port_read(int channel, void *bytes, size_t size) {
    const size_t left = sys_semihost_read(channel, bytes, size);
    return (left <= size) ? size - left : 0;
}

bool channel_port_write(int channel, const void *bytes, size_t size) {
    return sys_semihost_write(channel, bytes, size) == 0;
}
