/* SPDX-License-Identifier: MIT */
/*
 * internal_model.h - the line as the controller knows it: its constants, its past, what lies on it and what
 * disturbs it, taken on from period to period.
 */
#ifndef BELT_INTERNAL_MODEL_H
#define BELT_INTERNAL_MODEL_H

#include "estimator.h"
#include "level_history.h"
#include "measurement.h"
#include "observer.h"

/** The line at this moment, beside the density along the belt. */
typedef struct {
    belt_real_t level;       /**< Q(t) [parts]. */
    belt_real_t congestion;  /**< R(t) [parts s]. */
    belt_real_t disturbance; /**< flow into the buffer that the model does not know [parts/s]. */
    belt_real_t disturbance_flux; /**< the outlet flux that would make it, disturbance/alpha. */
} belt_present_t;

typedef struct {
    /* Constants, from the configuration. */
    belt_line_t line;                       /**< the line in the units of the march; first. */
    belt_estimator_gains_t estimator_gains; /**< and whether there is one. */

    /* State, period by period. */
    belt_level_history_t history; /**< levels of the last speed_window. */
    belt_observer_t observer;     /**< density along the belt. */
    belt_estimator_t estimator;   /**< level and disturbance. */
    belt_present_t present;       /**< Q(t), R(t), disturbance. */
} belt_model_t;

/** An empty line, for a checked configuration. */
void belt_model_init(belt_model_t *model, const belt_config_t *config);

/** The first level, for the whole window before it; what is said to lie on the belt [parts/m]. */
void belt_model_begin(belt_model_t *model, const belt_trusted_t *trusted,
                      const belt_real_t *density);

/** Belt, level and history follow the line over all periods since the last step: one on time, more
 * after late or lost steps, then in stretches of at most `longest` periods, in which the belt moves
 * no more than a node spacing. O(node_count) a stretch. */
void belt_model_follow(belt_model_t *model, const belt_trusted_t *trusted,
                       const belt_real_t *density, uint32_t longest);

#endif
