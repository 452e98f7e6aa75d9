/* SPDX-License-Identifier: MIT */
/* reals.h - the number type of the build under test: its neighbours, its bits, its rounding. */
#ifndef TESTS_UNIT_REALS_H
#define TESTS_UNIT_REALS_H

#include "belt/types.h"

#include <math.h>
#include <string.h>

/** Spacing of numbers at 1: a rounding of a number x changes it by at most EPSILON*|x|/2. */
#define EPSILON ((double)BELT_REAL_EPSILON)

/** The neighbour of `from` on the way to `towards`. */
static inline belt_real_t real_next(belt_real_t from, belt_real_t towards) {
#if BELT_REAL_IS_DOUBLE
    return nextafter(from, towards);
#else
    return nextafterf(from, towards);
#endif
}

static inline belt_real_t real_from_bits(uint64_t bits) {
    const belt_word_t word = (belt_word_t)bits;
    belt_real_t real;
    memcpy(&real, &word, sizeof real);
    return real;
}

static inline belt_word_t real_bits(belt_real_t real) {
    belt_word_t word;
    memcpy(&word, &real, sizeof word);
    return word;
}

/** xorshift64 (Marsaglia): the tests' only randomness; the state is the seed, not 0. */
static inline uint64_t random_bits(uint64_t *state) {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/** A random number in [0, 1), a multiple of 2^-24: exact in float too. */
static inline belt_real_t random_share(uint64_t *state) {
    return (belt_real_t)(random_bits(state) >> 40) / (belt_real_t)(1u << 24);
}

#endif
