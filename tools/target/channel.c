/* SPDX-License-Identifier: MIT */
#include "channel.h"

#include "channel_port.h"

#define HEAD (2u * sizeof(uint32_t))

int channel_open(const char *name, bool is_written) {
    return channel_port_open(name, is_written);
}

/** All of `size` bytes, in as many pieces as they come in. */
static bool receive(int channel, unsigned char *bytes, size_t size) {
    size_t got = 0;
    while (got < size) {
        const size_t more = channel_port_read(channel, bytes + got, size - got);
        if (more == 0) {
            return false;
        }
        got += more;
    }
    return true;
}

bool channel_receive(int channel, exchange_message_t *message) {
    unsigned char *const bytes = (unsigned char *)message;
    return receive(channel, bytes, HEAD) && (message->count <= EXCHANGE_CAPACITY) &&
           receive(channel, bytes + HEAD, message->count * sizeof(uint32_t));
}

bool channel_send(int channel, const exchange_message_t *message) {
    return channel_port_write(channel, message, HEAD + message->count * sizeof(uint32_t));
}
