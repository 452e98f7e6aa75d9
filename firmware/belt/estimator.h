/* SPDX-License-Identifier: MIT */
/*
 * estimator.h - level and one lumped disturbance, from the measured level and the model's outlet flux.
 *
 * The buffer's model has one more flow, constant and unknown:
 *
 *     Q' = alpha*phi + disturbance - service(Q)
 *
 * In it ends up whatever the model has wrong: connectivity, losses, service, a leak. The difference
 * between measured and expected level, filtered, corrects both states. The gains are those that would
 * give the error of a buffer without service two time constants equal to estimator_time (critically
 * damped) and a third, which keeps the noise of single samples from the command, of a fiftieth of it.
 * Service draws the two apart: with estimator_time T and service_time s the slower one tends to
 * T^2/s + 2T. The march then runs with the disturbance and the law feeds disturbance/alpha less. At rest
 * alpha*phi + disturbance = service(Q) and phi = u(Q*, Q) - disturbance/alpha, so Q = Q*: any constant
 * error of the model ends there, while the buffer serves less than mu, no flux is at its limit, and the
 * belt is the observer's own. A measured outlet flux or density, or the measured applied flux of a weak
 * valve, takes part of the error out of the estimator's sight and leaves up to 3 % of the set-point
 * (docs/ROBUSTNESS.md).
 *
 * phi must be the model's, not the measured outlet flux: what the model has wrong in it belongs into
 * the disturbance as well.
 *
 * One number to tune: estimator_time. Shorter follows faster, but lets noise and a wrong dead time
 * through; below some ten sample times it chatters. The rule, belt_config_estimator_time(), takes it from the dead time of the empty line.
 *
 * Cost: about 60 instructions a period.
 */
#ifndef BELT_ESTIMATOR_H
#define BELT_ESTIMATOR_H

#include "line_model.h"

/** Numbers derived from the configuration. */
typedef struct {
    uint32_t is_on;          /**< 0: level and disturbance are not estimated. */
    belt_real_t filter;      /**< share of a new difference that is taken on, (0, 1]. */
    belt_real_t level;       /**< level per filtered difference, (0, 1]. */
    belt_real_t disturbance; /**< disturbance per filtered difference [1/s]. */
    belt_real_t
        disturbance_max; /**< greatest amount that is believed: what the law can make up for,
                                      alpha Bmax [parts/s]. */
} belt_estimator_gains_t;

typedef struct {
    belt_real_t level;       /**< Q, estimated, in [0, level_capacity] [parts]. */
    belt_real_t difference;  /**< measured less expected level, filtered [parts]. */
    belt_real_t disturbance; /**< flow into the buffer that the model does not know [parts/s]. */
} belt_estimator_t;

/** Gains for a checked configuration. Two exponentials. */
void belt_estimator_gains_init(belt_estimator_gains_t *gains, const belt_config_t *config);

/** Starts at a level; the disturbance stays as it is, 0 at first. */
void belt_estimator_begin(belt_estimator_t *estimator, belt_real_t level);

/** What the level will be `duration` later [s] if `outlet_flux` leaves the belt [parts/s]. */
void belt_estimator_expect(belt_estimator_t *estimator, const belt_line_t *line,
                           belt_real_t outlet_flux, belt_real_t duration);

/** Corrects both by a measured level [parts]. */
void belt_estimator_correct(belt_estimator_t *estimator, const belt_estimator_gains_t *gains,
                            const belt_line_t *line, belt_real_t level);

/** True while the disturbance is at its limit. */
bool belt_estimator_is_at_limit(const belt_estimator_t *estimator,
                                const belt_estimator_gains_t *gains);

#endif
