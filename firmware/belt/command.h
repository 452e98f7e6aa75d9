/* SPDX-License-Identifier: MIT */
/*
 * command.h - the last interval closed with the law and solved for the inlet flux (MF1).
 *
 * The command is held for a period, so it is aimed at the middle of the hold: what will the buffer
 * hold when the material fed half a period from now arrives? On that last interval, which is not
 * yet on the belt, the law itself says what will arrive. Then (MF1) is the march's own last node,
 * solved for the density that must be fed:
 *
 *     inlet_flux = (slowness(arrival)*(u(Q*, p1) - disturbance/alpha) - rework)
 *                  /(survival*slowness(feeding))
 *
 * Cost: two evaluations of the law, three divisions.
 */
#ifndef BELT_COMMAND_H
#define BELT_COMMAND_H

#include "modes.h"
#include "nominal_law.h"
#include "predictor.h"

/** What the step hands to the plant. */
typedef struct {
    belt_real_t inlet_flux; /**< U: flux to feed until the next step, always finite and within
                                 0 ... inlet_flux_max [parts/s]. */
    belt_mode_t mode;       /**< who is in command. */
    uint32_t error_bits;    /**< BELT_ERROR_... of measurement.h: what was wrong in this step. */
} belt_command_t;

/** Flux within [0, limit]; anything that is no number is 0 [parts/s]. */
belt_real_t belt_command_limit(belt_real_t flux, belt_real_t limit);

/** The law with the disturbance taken off: the flux that, with it, acts on the buffer as u(Q*, Q)
 * would, as long as that is no less than nothing [parts/s]. */
static inline belt_real_t belt_command_wanted(const belt_nominal_law_t *law,
                                              const belt_present_t *present, belt_real_t level) {
    const belt_real_t flux = belt_nominal_law_flux(law, level) - present->disturbance_flux;
    return (flux > BELT_REAL(0)) ? flux : BELT_REAL(0);
}

/** The inlet flux that lets the nominal law act at the outlet (MF1), before limits [parts/s]. */
belt_real_t belt_command_solve(const belt_prediction_t *prediction, const belt_model_t *model,
                               const belt_nominal_law_t *law);

#endif
