/* SPDX-License-Identifier: MIT */
#include "integrity.h"

#include <string.h>

#if defined(__GNUC__)
/* A word that may look at any object: a load each, where memcpy from bytes takes four on a processor
 * that must not read across words. */
typedef uint32_t __attribute__((may_alias)) any_word_t;
static inline uint32_t word_at(const unsigned char *bytes, size_t index) {
    return ((const any_word_t *)(const void *)bytes)[index];
}
#else
static inline uint32_t word_at(const unsigned char *bytes, size_t index) {
    uint32_t word;
    memcpy(&word, bytes + index * sizeof word, sizeof word);
    return word;
}
#endif

uint32_t belt_integrity_sum(const void *block, size_t size) {
    const unsigned char *bytes = block;
    uint32_t sum = 0;
    size_t left = size / sizeof sum;
    for (; left >= 4u; left -= 4u) { /* four a turn: the loop then costs less than the sum */
        sum += word_at(bytes, 0u) + word_at(bytes, 1u) + word_at(bytes, 2u) + word_at(bytes, 3u);
        bytes += 4u * sizeof sum;
    }
    for (; left > 0u; --left) {
        sum += word_at(bytes, 0u);
        bytes += sizeof sum;
    }
    return sum;
}
