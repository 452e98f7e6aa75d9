/* SPDX-License-Identifier: MIT */
/*
 * types.h - the number type, the capacities and the status codes that all of belt shares.
 *
 * A build may set, the same for the library and for everybody who includes its headers:
 *   BELT_REAL_IS_DOUBLE    1: numbers are double; left out or 0: float (the product)
 *   BELT_NODE_CAPACITY     greatest node_count a configuration may ask for
 *   BELT_WINDOW_CAPACITY   levels kept; a window of speed_window needs speed_window/period + 2
 *   BELT_LOSS_CAPACITY     greatest number of values in a loss profile
 *   BELT_ASSERT(claim)     what happens when the caller breaks a contract; left out: nothing
 */
#ifndef BELT_TYPES_H
#define BELT_TYPES_H

#include <float.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __FAST_MATH__
#error "belt: -ffast-math removes the checks for NaN and changes the bits; compile without it"
#endif
#if defined(__FINITE_MATH_ONLY__) && (__FINITE_MATH_ONLY__ > 0)
#error "belt: -ffinite-math-only removes the checks for NaN; compile without it"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "belt: -funsafe-math-optimizations and its parts change the bits; compile without them"
#endif

#ifndef BELT_REAL_IS_DOUBLE
#define BELT_REAL_IS_DOUBLE 0
#endif
#ifndef BELT_NODE_CAPACITY
#define BELT_NODE_CAPACITY 20
#endif
#ifndef BELT_WINDOW_CAPACITY
#define BELT_WINDOW_CAPACITY 402
#endif
#ifndef BELT_LOSS_CAPACITY
#define BELT_LOSS_CAPACITY 8
#endif
#ifndef BELT_ASSERT
#define BELT_ASSERT(claim) ((void)0)
#endif

#if BELT_NODE_CAPACITY < 4 || BELT_NODE_CAPACITY > 1024
#error "belt: BELT_NODE_CAPACITY must lie in 4 ... 1024"
#endif
#if BELT_WINDOW_CAPACITY < 4 || BELT_WINDOW_CAPACITY > 16384
#error "belt: BELT_WINDOW_CAPACITY must lie in 4 ... 16384"
#endif
#if BELT_LOSS_CAPACITY < 1 || BELT_LOSS_CAPACITY > 1024
#error "belt: BELT_LOSS_CAPACITY must lie in 1 ... 1024"
#endif

/* The number, and integers of the same width: quanta hold levels exactly, words hold powers of 2. */
#if BELT_REAL_IS_DOUBLE
typedef double belt_real_t;
typedef int64_t belt_quanta_t;
typedef uint64_t belt_word_t;
#define BELT_REAL_MAX DBL_MAX
#define BELT_REAL_EPSILON DBL_EPSILON
#define BELT_QUANTA_BITS 62
#else
typedef float belt_real_t;
typedef int32_t belt_quanta_t;
typedef uint32_t belt_word_t;
#define BELT_REAL_MAX FLT_MAX
#define BELT_REAL_EPSILON FLT_EPSILON
#define BELT_QUANTA_BITS 30
#endif

#define BELT_STATIC_ASSERT(name, claim) typedef char belt_assert_##name[(claim) ? 1 : -1]

BELT_STATIC_ASSERT(quanta_are_as_wide_as_reals, sizeof(belt_quanta_t) == sizeof(belt_real_t));
BELT_STATIC_ASSERT(words_are_as_wide_as_reals, sizeof(belt_word_t) == sizeof(belt_real_t));
BELT_STATIC_ASSERT(float_is_binary, FLT_RADIX == 2 && FLT_MANT_DIG == 24);
BELT_STATIC_ASSERT(double_is_binary, DBL_MANT_DIG == 53);

/** A number written so that it has the type belt_real_t: BELT_REAL(0.5). */
#define BELT_REAL(number) ((belt_real_t)(number))
#define BELT_HALF BELT_REAL(0.5)

/** A number kept within its limits; one that is none (NaN) is the lower limit. */
static inline belt_real_t belt_within(belt_real_t lower, belt_real_t value, belt_real_t upper) {
    const belt_real_t not_less = (value > lower) ? value : lower;
    return (not_less < upper) ? not_less : upper;
}

/**
 * What a call says. Codes from BELT_BELT_LENGTH to BELT_TRANSFER_TIME are the rules of a
 * configuration, in the order in which they are checked; each is also a bit of the mask of broken
 * rules, BELT_RULE_BIT(code). belt_config_rule() gives value and limits of each.
 */
typedef enum {
    BELT_OK = 0,

    /* Rules of the line. */
    BELT_BELT_LENGTH,      /**< belt_length is a number in its range. */
    BELT_PROCESSING_TIME,  /**< processing_time is a number in its range. */
    BELT_SPEED_WINDOW,     /**< speed_window is a number in its range. */
    BELT_CONGESTION_SCALE, /**< congestion_scale is a number in its range. */
    BELT_CONNECTIVITY,     /**< BELT_DIMENSION_MIN <= connectivity <= 1. */
    BELT_SERVICE_RATE_MAX, /**< service_rate_max is a number in its range. */
    BELT_SERVICE_TIME,     /**< service_time is a number in its range. */
    BELT_LEVEL_CAPACITY,   /**< level_capacity is a number in its range. */
    BELT_REWORK_RATE,      /**< 0 <= rework_rate, a number. */
    BELT_LOSS_COUNT,       /**< 1 <= loss_count <= BELT_LOSS_CAPACITY. */
    BELT_LOSS_RATE,        /**< every loss_rate is a number in its range. */

    /* Rules of the discretisation. */
    BELT_NODE_COUNT,      /**< 4 <= node_count <= BELT_NODE_CAPACITY. */
    BELT_PERIOD,          /**< period is a number in its range. */
    BELT_PERIOD_PER_NODE, /**< at full speed material passes at most one node spacing a period. */
    BELT_WINDOW_SHORT,    /**< speed_window is at least one period. */
    BELT_WINDOW_LONG,     /**< speed_window/period + 2 <= BELT_WINDOW_CAPACITY. */
    BELT_DEAD_TIME,       /**< the longest dead time is at most BELT_DEAD_TIME_PERIODS periods. */
    BELT_LOSS_EXPONENT,   /**< survival and 1/survival stay below exp(BELT_LOSS_EXPONENT_MAX). */
    BELT_LOSS_PER_NODE,   /**< loss while passing one node spacing is small: raise node_count. */
    BELT_REWORK_PER_NODE, /**< rework while passing one spacing is small: raise node_count. */
    BELT_REWORK_GAIN,     /**< less comes back than has left, or the line itself runs away. */
    BELT_SERVICE_PER_NODE, /**< the buffer changes little while one spacing passes: raise node_count. */
    BELT_CONGESTION_PER_NODE, /**< so does the speed: raise node_count. */

    /* Rules of the law. */
    BELT_NOMINAL_FLUX_MAX, /**< BELT_DIMENSION_MIN <= nominal_flux_max <= min(Qmax/service_time,
                                  mu)/alpha. */
    BELT_LEVEL_SETPOINT,   /**< 0 < level_setpoint < alpha Bmax service_time. */
    BELT_SLOPE_KIND,       /**< slope_kind is one of its words. */
    BELT_SETPOINT_SLOPE,   /**< S > Smin, strictly. */
    BELT_PERIOD_PER_SLOPE, /**< alpha S period <= 1/2: the period is short enough for the slope. */
    BELT_INLET_FLUX_MAX,   /**< inlet_flux_max > 0. */
    BELT_PREDICTION_KIND,  /**< prediction is one of its words. */

    /* Rules of estimator and supervisor; each field may be left 0. */
    BELT_ESTIMATOR_KIND,  /**< estimator is one of its words. */
    BELT_ESTIMATOR_TIME,  /**< estimator_time is at least the time between two samples. */
    BELT_FLUX_RATE_MAX,   /**< flux_rate_max is a number in its range. */
    BELT_SUBSTITUTE_FLUX, /**< 0 <= substitute_flux <= inlet_flux_max, flux bound. */
    BELT_LEVEL_STEP_MAX,  /**< level_step_max is a number in its range. */
    BELT_TRANSFER_TIME,   /**< transfer_time is a number in its range. */

    /* Not rules. */
    BELT_MISUSE,         /**< a null pointer, or a step before a successful init. */
    BELT_NO_LEVEL,       /**< no level has been trusted yet: the law cannot begin. */
    BELT_INPUT_REJECTED, /**< an input was not trusted: command.error_bits say which. */
    BELT_PERIODS_MISSED, /**< steps came late, twice or after a stop: see error_bits. */
    BELT_LINE_DEVIATES,  /**< valve or line do not do what they are told: see command.error_bits. */
    BELT_CORRUPT,        /**< the controller's own memory has changed: start it anew. */
    BELT_UNKNOWN_MODE,   /**< a mode nobody can ask for; the old request stands. */
    BELT_NOT_MANUAL,     /**< a manual flux while manual was not asked for; nothing changed. */
    BELT_MANUAL_FLUX,    /**< a manual flux that is no number within its limits. */
    BELT_NO_SNAPSHOT,    /**< no slot holds a whole snapshot of this build and configuration. */
    BELT_SNAPSHOT_OLD    /**< restored in part: the stop was too long for history and belt. */
} belt_status_t;

#define BELT_RULE_FIRST BELT_BELT_LENGTH
#define BELT_RULE_LAST BELT_TRANSFER_TIME
#define BELT_RULE_BIT(code) ((uint64_t)1 << (unsigned)(code))

BELT_STATIC_ASSERT(rules_fit_a_mask, BELT_RULE_LAST < 64);

/** Name of a status as it stands in this header, for messages; never null. */
const char *belt_status_name(belt_status_t status);

#endif
