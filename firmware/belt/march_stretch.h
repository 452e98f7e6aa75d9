/* SPDX-License-Identifier: MIT */
/*
 * march_stretch.h - a stretch of belt, one cell or two, passes the outlet: what leaves is found by
 * survival and rework, then level, time and congestion take a step. Any stretch, any line.
 */
#ifndef BELT_MARCH_STRETCH_H
#define BELT_MARCH_STRETCH_H

#include "prediction.h"

/** A stretch: one cell, or two behind each other; of the second one the width may be 0. */
typedef struct {
    belt_real_t density[2]; /**< of each cell now [parts/m]. */
    belt_real_t width[2];   /**< [spacings]. */
} belt_stretch_t;

/** Passes one stretch. */
void belt_march_stretch(belt_prediction_t *prediction, const belt_model_t *model,
                        const belt_stretch_t *stretch);

/** Takes survival and rework on to the inlet, behind the last stretch. */
void belt_march_to_inlet(belt_prediction_t *prediction, const belt_model_t *model);

#endif
