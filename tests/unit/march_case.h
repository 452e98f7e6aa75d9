/* SPDX-License-Identifier: MIT */
/* march_case.h - a march that stands at the outlet: nothing on the belt, the window empty, no level. */
#ifndef TESTS_UNIT_MARCH_CASE_H
#define TESTS_UNIT_MARCH_CASE_H

#include "belt/march_step.h"

#include <string.h>

#include "paper_case.h"
#include "reals.h"
#include "unity.h"

static belt_config_t config;
static belt_model_t model;
static belt_prediction_t prediction;

static inline void begin(void) {
    memset(&model, 0, sizeof model);
    memset(&prediction, 0, sizeof prediction);
    belt_line_init(&model.line, &config);
    belt_level_history_init(&model.history, &config); /* every level 0 */
    belt_observer_init(&model.observer);
    prediction.inlet.carried.survival = BELT_REAL(1);
    prediction.inlet.pace = belt_march_pace(&model.line, BELT_REAL(0));
}

#endif
