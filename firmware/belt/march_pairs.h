/* SPDX-License-Identifier: MIT */
/*
 * march_pairs.h - the stretches of two whole cells on a plain line: the loop in which the step spends its
 * time. march_stretch.h does the same for any stretch, at more cost.
 */
#ifndef BELT_MARCH_PAIRS_H
#define BELT_MARCH_PAIRS_H

#include "prediction.h"

/** Plain line: passes pairs of whole cells, from ring index `cell` on; returns that of the cell behind
 * them. */
uint32_t belt_march_plain_pairs(belt_prediction_t *prediction, const belt_model_t *model,
                                uint32_t cell, uint32_t pairs);

#endif
