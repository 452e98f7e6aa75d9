/* SPDX-License-Identifier: MIT */
#include "integrity.h"

#include <string.h>

#if defined(__GNUC__)
/* A word that may look at any object: a load each, where memcpy from bytes takes four on a processor
 * that must not read across words. */
typedef uint32_t __attribute__((may_alias)) any_word_t;
static inline uint32_t word_at(const void *block, size_t index) {
    return ((const any_word_t *)block)[index];
}
#else
static inline uint32_t word_at(const void *block, size_t index) {
    uint32_t word;
    memcpy(&word, (const unsigned char *)block + index * sizeof word, sizeof word);
    return word;
}
#endif

uint32_t belt_integrity_sum(const void *block, size_t size) {
    const size_t words = size / sizeof(uint32_t);
    uint32_t sum = 0;
    size_t i = 0;
    for (; i + 4u <= words; i += 4u) { /* four a turn: the loop then costs less than the sum */
        sum += word_at(block, i) + word_at(block, i + 1u) + word_at(block, i + 2u) +
               word_at(block, i + 3u);
    }
    for (; i < words; ++i) {
        sum += word_at(block, i);
    }
    return sum;
}
