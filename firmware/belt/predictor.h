/* SPDX-License-Identifier: MIT */
/*
 * predictor.h - the march along the belt, from the outlet to the last part fed.
 *
 * At each place x it answers, for the moment at which the material now at x reaches the outlet: what
 * will the buffer hold (p1), which density will leave (p2), how congested will the line be (p3), and
 * when (sigma)? In the paper (MF3)-(MF7), (C1)-(C3), with the speed written as its inverse:
 *
 *     sigma_x = slowness(p3)
 *     p1_x    = alpha*p2 + (disturbance - service(p1))*slowness(p3)
 *     p3_x    = (p1 - level at sigma - speed_window)*slowness(p3)
 *     p2      = survival*density + rework picked up on the way
 *
 * Level, time and congestion take one step for a pair of cells (march_step.h), survival and rework one
 * for each cell. The terms of a step are those of third order; the whole is of second, with a small
 * constant: what leaves is taken by cells, and the window's end is looked at in a stretch's middle. Where
 * the density jumps within every pair it is of first (0.06/node_count of what such a saw brings).
 * Pairs are pairs of material, so that the prediction changes smoothly while the belt moves on. The
 * window of p3 slides out of the recorded levels into the predicted ones once sigma - speed_window lies
 * in the future.
 *
 * Cost: a plain line about 95 instructions a cell, some 800 for the ends and the rest; a loss profile
 * twice as many, and some 25 for each two stretches (node_count^2/8 of them). Stack: 200 bytes.
 */
#ifndef BELT_PREDICTOR_H
#define BELT_PREDICTOR_H

#include "prediction.h"

/** Marches over the line as the model has it. Whether the speed follows the predicted congestion says
 * line.crowding. */
void belt_predictor_march(belt_prediction_t *prediction, const belt_model_t *model);

#endif
