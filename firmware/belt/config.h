/* SPDX-License-Identifier: MIT */
/*
 * config.h - what the user states about the line and the law, and the rules it must keep.
 *
 * Units: length in m, time in s, amounts in parts. Any other consistent set does as well; then
 * every field is stated in it, congestion_scale and service_time too.
 *
 * Cost: a check reads the whole configuration a few times; about 60 bytes of stack. It belongs to
 * start-up, not to the control task.
 */
#ifndef BELT_CONFIG_H
#define BELT_CONFIG_H

#include "types.h"

/** Every positive dimension lies between these, so that no product of them overflows. */
#define BELT_DIMENSION_MIN BELT_REAL(1e-6)
#define BELT_DIMENSION_MAX BELT_REAL(1e6)
/** Longest dead time in periods: arrival times keep a thousandth of a period in float32. */
#define BELT_DEAD_TIME_PERIODS 8192
/** Greatest loss exponent: 1/survival <= exp(10) = 22026, where feeding more is no remedy. */
#define BELT_LOSS_EXPONENT_MAX BELT_REAL(10)
/** Greatest loss and rework while passing one node spacing: the march is of second order in them. */
#define BELT_CHANGE_PER_NODE_MAX BELT_REAL(0.25)
/** Greatest share of service_time that one node spacing takes: the march steps over two. */
#define BELT_SERVICE_PER_NODE_MAX BELT_REAL(0.5)
/** Greatest share of the density leaving that rework puts back, losses left aside: at 1 the belt
 * fills by itself. */
#define BELT_REWORK_GAIN_MAX BELT_REAL(0.9)
/** Greatest alpha S period: from 1 on the held command overshoots the law it samples. */
#define BELT_SLOPE_PERIODS_MAX BELT_HALF
/** inlet_flux_max of an actuator without a limit. */
#define BELT_NO_FLUX_LIMIT BELT_REAL_MAX
/** Greatest number of periods a step can make up for; beyond it the belt is lost from sight. */
#define BELT_CATCH_UP_PERIODS 100u

typedef enum {
    BELT_SLOPE_MARGIN,  /**< slope is what S exceeds Smin by, anew at each set-point. */
    BELT_SLOPE_ABSOLUTE /**< slope is S itself. */
} belt_slope_kind_t;

typedef enum {
    BELT_PREDICT_CONGESTION, /**< the paper's predictor: the speed of the march follows the level. */
    BELT_HOLD_CONGESTION     /**< a march at the present speed, for comparison: misses the changing
                                  dead time. */
} belt_prediction_kind_t;

typedef enum {
    BELT_ESTIMATOR_OFF, /**< the paper's law: the level is what was measured, the model is exact. */
    BELT_ESTIMATOR_ON /**< level and disturbance are estimated: noise is filtered, and any constant
                             error of the model ends at the set-point. */
} belt_estimator_kind_t;

typedef struct {
    /* The line. Ranges: BELT_DIMENSION_MIN ... BELT_DIMENSION_MAX unless said otherwise. */
    belt_real_t belt_length;      /**< D: from outlet to inlet [m]. */
    belt_real_t processing_time;  /**< P: time a metre takes on an uncongested line [s/m]. */
    belt_real_t speed_window;     /**< tau: how far back the level counts for the speed [s]. */
    belt_real_t congestion_scale; /**< congestion at which the speed is halved [parts s]; 1 in the
                                       paper. */
    belt_real_t connectivity;     /**< alpha: share of the outlet flux that reaches the buffer,
                                       BELT_DIMENSION_MIN ... 1. */
    belt_real_t service_rate_max; /**< mu: greatest rate of service [parts/s]. */
    belt_real_t service_time;   /**< service is level/service_time up to mu [s]; 1 in the paper. */
    belt_real_t level_capacity; /**< Qmax: parts that the buffer holds. */
    belt_real_t rework_rate;    /**< A: of the density v leaving, A (D - x) v comes back at x each
                                       second [1/(m s)], 0 ... BELT_DIMENSION_MAX. */
    belt_real_t loss_rate[BELT_LOSS_CAPACITY]; /**< C(x): share lost in a second [1/s], below
                                       0 what grows by itself, at most BELT_DIMENSION_MAX in size;
                                       equally spaced from outlet (first) to inlet (last), linear
                                       between. */
    uint16_t loss_count;                       /**< values in loss_rate; 1: the loss is uniform. */

    /* The law. */
    belt_real_t level_setpoint;   /**< Q*: 0 < Q* < alpha Bmax service_time [parts]. */
    belt_real_t nominal_flux_max; /**< Bmax: greatest nominal flux, <= min(Qmax/service_time,
                                       mu)/alpha [parts/s]. Bounds the law, not the command. */
    belt_slope_kind_t slope_kind; /**< what `slope` is. */
    belt_real_t slope;            /**< S, or S - Smin [1/s]; S > Smin and alpha S period <= 1/2. */

    /* The controller. */
    uint16_t node_count; /**< cells along the belt, 4 ... BELT_NODE_CAPACITY; 20 is plenty. */
    belt_real_t period;  /**< time between steps [s]; <= P D/node_count. */
    belt_real_t inlet_flux_max; /**< greatest command [parts/s], > 0; BELT_NO_FLUX_LIMIT if none. */
    belt_prediction_kind_t prediction; /**< BELT_PREDICT_CONGESTION, but for comparisons. */

    /* What keeps it alone with a line. Left 0, each has its default. */
    belt_estimator_kind_t estimator; /**< default: off. */
    belt_real_t estimator_time; /**< time constant of the estimator [s], >= sample_periods periods;
                                     default: belt_config_estimator_time()'s rule. */
    belt_real_t
        flux_rate_max; /**< greatest change of the command [parts/s^2]; default: no limit. */
    belt_real_t substitute_flux; /**< fed while no level is to be had, 0 ... inlet_flux_max and
                                      belt_config_flux_bound() [parts/s]; default: nothing. */
    belt_real_t level_step_max;  /**< greatest change between two samples that is believed at once
                                      [parts]; default: a quarter of level_capacity. */
    belt_real_t transfer_time; /**< time constant with which the command goes over from one mode to
                                    another [s]; default: a quarter of the empty line's dead time. */
    uint16_t
        sample_periods;    /**< a new sample of the level is due every so many periods, rounded up;
                                    default: 1. */
    uint16_t hold_periods; /**< so long the law goes on without a good level before the
                                    substitute takes over [periods]; default: half the empty line's
                                    dead time. */
    uint16_t
        recovery_samples; /**< good samples in a row that end hold and substitute; default: 10. */
} belt_config_t;

/** One rule: `value` must lie between the limits; an open limit may not be touched. A side without
 * limit has -BELT_REAL_MAX or BELT_REAL_MAX there. Limits can themselves be NaN or senseless when an
 * earlier rule is broken. */
typedef struct {
    belt_real_t value;
    belt_real_t lower;
    belt_real_t upper;
    bool lower_open;
    bool upper_open;
} belt_rule_t;

/** Value and limits of one rule, BELT_RULE_FIRST <= code <= BELT_RULE_LAST, in the units of the
 * configuration. */
belt_rule_t belt_config_rule(const belt_config_t *config, belt_status_t code);

/** True when the value is a number within the limits. False for every NaN. */
bool belt_rule_holds(const belt_rule_t *rule);

/** BELT_OK, or the first broken rule. *broken (may be null) gets a bit for every broken one. */
belt_status_t belt_config_check(const belt_config_t *config, uint64_t *broken);

/** Smin(Q*), eq:smin: below it a gain has no positive root [1/s]. */
belt_real_t belt_config_slope_min(const belt_config_t *config);

/** S at the configuration's set-point [1/s]. */
belt_real_t belt_config_slope(const belt_config_t *config);

/** Q* / (alpha service_time): the flux that holds the set-point once it arrives [parts/s]. */
belt_real_t belt_config_setpoint_flux(const belt_config_t *config);

/** 1 + tau Qmax/congestion_scale: how many times slower the fullest line is than the empty one. */
belt_real_t belt_config_slowdown_max(const belt_config_t *config);

/** Mean of C(x) along the belt: trapezoids between the equally spaced values [1/s]. */
belt_real_t belt_config_loss_mean(const belt_config_t *config);

/** Mean of |C(x)| along the belt (between two values of either sign no less than that) times the
 * longest dead time: 1/survival and survival stay below its exponential. */
belt_real_t belt_config_loss_exponent(const belt_config_t *config);

/** A flux that no sound line can pass: ten times the greatest that the law can ask for, all losses
 * made up for and the line at its slowest when it arrives [parts/s]. */
belt_real_t belt_config_flux_bound(const belt_config_t *config);

/** The density of that flux at the slowest speed; rework, which at most makes ten of one, stays below
 * it too [parts/m]. */
belt_real_t belt_config_density_bound(const belt_config_t *config);

/** sample_periods, or its default where it is 0. */
uint32_t belt_config_sample_periods(const belt_config_t *config);

/** estimator_time, or where it is 0 by the rule: 0.74 times the dead time of the empty line, P D. At
 * that a dead time that the model has 20 % wrong does not oscillate, and no more is asked of noise:
 * docs/ROBUSTNESS.md has the map [s]. */
belt_real_t belt_config_estimator_time(const belt_config_t *config);

/** P D (1 + tau Qmax/congestion_scale): dead time of the fullest line [s]. */
belt_real_t belt_config_dead_time_max(const belt_config_t *config);

#endif
