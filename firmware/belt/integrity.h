/* SPDX-License-Identifier: MIT */
/*
 * integrity.h - has the controller's own memory changed?
 *
 * A flipped bit in a number of the belt is a wrong measurement and leaves with the material. One in a
 * count, an index or a limit could lead a loop out of its array or the valve out of its range; such
 * words are summed when they are written and again before they are used.
 *
 * Cost: 2 to 3 instructions a word.
 */
#ifndef BELT_INTEGRITY_H
#define BELT_INTEGRITY_H

#include "types.h"

/** Sum of the 32-bit words of a block; any one changed bit changes it. The block is aligned as a word is,
 * `size` a multiple of 4. */
uint32_t belt_integrity_sum(const void *block, size_t size);

#endif
