/* SPDX-License-Identifier: MIT */
/*
 * fuzz_input.h - what every harness does with the bytes it is given, and how it says that a claim
 * does not hold.
 *
 * Bytes are read from front to back; behind the last one come zeros, so that every input means
 * something and a shorter one is a simpler one.
 */
#ifndef TESTS_FUZZ_INPUT_H
#define TESTS_FUZZ_INPUT_H

#include "belt/types.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/** Stops at a claim that does not hold; libFuzzer then keeps the input. */
#define FUZZ_CHECK(claim)                                                                          \
    do {                                                                                           \
        if (!(claim)) {                                                                            \
            (void)fprintf(stderr, "%s:%d: does not hold: %s\n", __FILE__, __LINE__, #claim);       \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

/** What libFuzzer calls: once at the start, and for every input. */
int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct {
    const uint8_t *next;
    size_t left;
} fuzz_input_t;

static inline uint8_t fuzz_byte(fuzz_input_t *input) {
    if (input->left == 0) {
        return 0;
    }
    --input->left;
    return *input->next++;
}

/** Fills memory with the input's next bytes. */
static inline void fuzz_bytes(fuzz_input_t *input, void *memory, size_t size) {
    const size_t there = (size < input->left) ? size : input->left;
    memset(memory, 0, size);
    memcpy(memory, input->next, there);
    input->next += there;
    input->left -= there;
}

static inline uint32_t fuzz_word(fuzz_input_t *input) {
    uint32_t word;
    fuzz_bytes(input, &word, sizeof word);
    return word;
}

/** A number: mostly one byte, from -scale to 1.5 scale in coarse steps; the awkward ones; or any
 * bits. */
static inline belt_real_t fuzz_real(fuzz_input_t *input, belt_real_t scale) {
    const belt_real_t zero = BELT_REAL(0);
    const uint8_t kind = fuzz_byte(input);
    if (kind < 0xC0u) {
        return scale * (belt_real_t)kind / BELT_REAL(0x80);
    }
    if (kind < 0xD0u) {
        return scale * (BELT_REAL(0xBF) - (belt_real_t)kind) / BELT_REAL(16);
    }
    switch (kind) {
        case 0xD0u: return -zero;
        case 0xD1u: return zero / zero;
        case 0xD2u: return BELT_REAL_MAX * BELT_REAL(2);
        case 0xD3u: return -BELT_REAL_MAX * BELT_REAL(2);
        case 0xD4u: return BELT_REAL_MAX;
        case 0xD5u: return -BELT_REAL_MAX;
        case 0xD6u: return BELT_REAL(FLT_MIN);
        case 0xD7u: return BELT_REAL(FLT_MIN) * BELT_REAL_EPSILON; /* the least subnormal */
        case 0xD8u: return -BELT_REAL(FLT_MIN) * BELT_REAL_EPSILON;
        case 0xD9u: return scale * (BELT_REAL(1) + BELT_REAL_EPSILON);
        case 0xDAu: return scale * (BELT_REAL(1) - BELT_REAL_EPSILON);
        default: break;
    }
    belt_real_t any;
    fuzz_bytes(input, &any, sizeof any);
    return any;
}

#endif
