/* SPDX-License-Identifier: MIT */
#include "integrity.h"

#include <string.h>

uint32_t belt_integrity_sum(const void *block, size_t size) {
    const unsigned char *bytes = block;
    uint32_t sum = 0;
    size_t done = 0;
    for (; done + 4u * sizeof sum <= size; done += 4u * sizeof sum) {
        uint32_t word[4]; /* four a turn: the loop itself then costs less than the sum */
        memcpy(word, bytes + done, sizeof word);
        sum += word[0] + word[1] + word[2] + word[3];
    }
    for (; done < size; done += sizeof sum) {
        uint32_t word;
        memcpy(&word, bytes + done, sizeof word);
        sum += word;
    }
    return sum;
}
