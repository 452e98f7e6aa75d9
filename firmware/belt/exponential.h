/* SPDX-License-Identifier: MIT */
/*
 * exponential.h - the one transcendental function of the step, without libm, so that every target
 * computes the same bits.
 */
#ifndef BELT_EXPONENTIAL_H
#define BELT_EXPONENTIAL_H

#include "types.h"

/**
 * exp(x) - 1 for x <= 0; accurate for tiny x too, where exp(x) - 1 would cancel.
 *
 * Error: at most 2 units in the last place of the result (float and double; tested against libm).
 * Range: any x; a positive x or NaN is taken as 0, and where exp(x) no longer shows beside 1 the
 * result is -1. Cost: about 40 instructions and one division, no branch on the value but the two
 * clamps.
 */
belt_real_t belt_expm1(belt_real_t x);

#endif
