/* SPDX-License-Identifier: MIT */
#include "chance.h"

static uint64_t splitmix(uint64_t *state) {
    *state += UINT64_C(0x9E3779B97F4A7C15);
    uint64_t mixed = *state;
    mixed = (mixed ^ (mixed >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    mixed = (mixed ^ (mixed >> 27)) * UINT64_C(0x94D049BB133111EB);
    return mixed ^ (mixed >> 31);
}

static uint64_t rotated(uint64_t word, unsigned places) {
    return (word << places) | (word >> (64u - places));
}

void chance_begin(chance_t *self, uint32_t seed, uint32_t stream) {
    uint64_t state = ((uint64_t)stream << 32) + seed;
    for (unsigned i = 0; i < 4; ++i) {
        self->state[i] = splitmix(&state);
    }
}

uint64_t chance_bits(chance_t *self) {
    uint64_t *const state = self->state;
    const uint64_t result = rotated(state[1] * 5u, 7) * 9u;
    const uint64_t shifted = state[1] << 17;
    state[2] ^= state[0];
    state[3] ^= state[1];
    state[1] ^= state[2];
    state[0] ^= state[3];
    state[2] ^= shifted;
    state[3] = rotated(state[3], 45);
    return result;
}

double chance_share(chance_t *self) {
    return (double)(chance_bits(self) >> 11) * 0x1p-53;
}

/* Von Neumann's comparisons: numbers are drawn as long as each is below the one before, the first
 * below `exponent`. Exactly n come with a probability of exponent^n/n! - exponent^(n + 1)/(n + 1)!, an
 * even number therefore with exp(-exponent). */
bool chance_exponential(chance_t *self, double exponent) {
    bool is_even = true;
    double before = exponent;
    for (double drawn = chance_share(self); drawn < before; drawn = chance_share(self)) {
        before = drawn;
        is_even = !is_even;
    }
    return is_even;
}

static bool happens_each_time(chance_t *self, unsigned times, double exponent) {
    bool happens = true;
    for (unsigned i = 0; (i < times) && happens; ++i) {
        happens = chance_exponential(self, exponent);
    }
    return happens;
}

/* Algorithm N of Karney, "Sampling exactly from the normal distribution", ACM TOMS 42, 2016: whole and
 * broken part of the size are proposed apart, and accepted by events of known probability. */
double chance_normal(chance_t *self) {
    for (;;) {
        unsigned whole = 0;
        while (chance_exponential(self, 0.5)) {
            ++whole;
        }
        if ((whole > 1) && !happens_each_time(self, whole * (whole - 1), 0.5)) {
            continue;
        }
        const double part = chance_share(self);
        const double exponent = part * (2.0 * whole + part) / (2.0 * whole + 2.0);
        if (happens_each_time(self, whole + 1, exponent)) {
            const double size = (double)whole + part;
            return (chance_bits(self) >> 63 != 0u) ? -size : size;
        }
    }
}
