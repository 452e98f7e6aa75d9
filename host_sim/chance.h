/* SPDX-License-Identifier: MIT */
/*
 * chance.h - the simulator's only randomness: seeded, and the same bits on every machine.
 *
 * xoshiro256** (Blackman and Vigna, "Scrambled linear pseudorandom number generators", ACM TOMS 47,
 * 2021), its state filled by splitmix64. Whoever needs chance has a stream of his own, so that a
 * second fault does not change what the first one does. No function of libm is called.
 */
#ifndef HOST_SIM_CHANCE_H
#define HOST_SIM_CHANCE_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    uint64_t state[4];
} chance_t;

/** Starts one stream of a seed: splitmix64 from seed + stream*2^32 gives the state. */
void chance_begin(chance_t *self, uint32_t seed, uint32_t stream);

/** 64 random bits. */
uint64_t chance_bits(chance_t *self);

/** A multiple of 2^-53, uniform in [0, 1). */
double chance_share(chance_t *self);

/** True with a probability of exp(-exponent), 0 <= exponent <= 1. */
bool chance_exponential(chance_t *self, double exponent);

/** A deviate of the normal distribution with mean 0 and standard deviation 1. */
double chance_normal(chance_t *self);

#endif
