/* SPDX-License-Identifier: MIT */
#include "config.h"

#include "exponential.h"
#include "line_laws.h"

static belt_real_t least(belt_real_t a, belt_real_t b) {
    return (a < b) ? a : b;
}

static belt_real_t size_of(belt_real_t value) {
    return (value < BELT_REAL(0)) ? -value : value;
}

/** The loss rate that is greatest in size, or the first that is no number. */
static belt_real_t worst_loss_rate(const belt_config_t *config) {
    belt_real_t worst = BELT_REAL(0);
    for (uint16_t i = 0; (i < config->loss_count) && (i < BELT_LOSS_CAPACITY); ++i) {
        const belt_real_t rate = config->loss_rate[i];
        if (!(size_of(rate) <= size_of(worst))) {
            worst = rate;
        }
        if (!(rate <= BELT_REAL_MAX)) {
            break;
        }
    }
    return worst;
}

/** Mean along the belt of the loss rate, or of its size, by the trapezoids of the table. */
static belt_real_t mean_loss(const belt_config_t *config, bool of_size) {
    const belt_real_t *rate = config->loss_rate;
    if (config->loss_count <= 1) {
        return of_size ? size_of(rate[0]) : rate[0];
    }
    belt_real_t sum = BELT_REAL(0);
    for (uint16_t i = 0; (i + 1 < config->loss_count) && (i + 1 < BELT_LOSS_CAPACITY); ++i) {
        const belt_real_t left = of_size ? size_of(rate[i]) : rate[i];
        const belt_real_t right = of_size ? size_of(rate[i + 1]) : rate[i + 1];
        sum += BELT_HALF * (left + right);
    }
    return sum / BELT_REAL(config->loss_count - 1);
}

belt_real_t belt_config_loss_mean(const belt_config_t *config) {
    return mean_loss(config, false);
}

belt_real_t belt_config_setpoint_flux(const belt_config_t *config) {
    return belt_law_service(config->level_setpoint, BELT_REAL(1) / config->service_time,
                            config->service_rate_max) /
           config->connectivity;
}

belt_real_t belt_config_slope_min(const belt_config_t *config) {
    const belt_real_t flux = belt_config_setpoint_flux(config);
    const belt_real_t rising = (config->nominal_flux_max - flux) / config->level_setpoint;
    const belt_real_t falling = flux / (config->level_capacity - config->level_setpoint);
    return (rising > falling) ? rising : falling;
}

belt_real_t belt_config_slope(const belt_config_t *config) {
    return (config->slope_kind == BELT_SLOPE_ABSOLUTE)
               ? config->slope
               : belt_config_slope_min(config) + config->slope;
}

belt_real_t belt_config_slowdown_max(const belt_config_t *config) {
    return BELT_REAL(1) + config->speed_window * config->level_capacity / config->congestion_scale;
}

belt_real_t belt_config_dead_time_max(const belt_config_t *config) {
    return config->processing_time * config->belt_length * belt_config_slowdown_max(config);
}

belt_real_t belt_config_loss_exponent(const belt_config_t *config) {
    return mean_loss(config, true) * belt_config_dead_time_max(config);
}

/** Greatest growth on the way, as an exponent: of the mean size what is not loss, and half of that. */
static belt_real_t growth_exponent(const belt_config_t *config) {
    return BELT_HALF * (mean_loss(config, true) - belt_config_loss_mean(config)) *
           belt_config_dead_time_max(config);
}

uint32_t belt_config_sample_periods(const belt_config_t *config) {
    return (config->sample_periods > 0u) ? config->sample_periods : 1u;
}

belt_real_t belt_config_estimator_time(const belt_config_t *config) {
    const bool is_left_0 =
        (config->estimator_time >= BELT_REAL(0)) && (config->estimator_time <= BELT_REAL(0));
    return is_left_0 ? BELT_REAL(0.74) * config->processing_time * config->belt_length
                     : config->estimator_time;
}

belt_real_t belt_config_flux_bound(const belt_config_t *config) {
    const belt_real_t survival = BELT_REAL(1) + belt_expm1(-belt_config_loss_exponent(config));
    return BELT_REAL(10) * config->nominal_flux_max * belt_config_slowdown_max(config) / survival;
}

belt_real_t belt_config_density_bound(const belt_config_t *config) {
    return belt_config_flux_bound(config) * config->processing_time *
           belt_config_slowdown_max(config);
}

static belt_rule_t closed(belt_real_t lower, belt_real_t value, belt_real_t upper) {
    const belt_rule_t rule = {value, lower, upper, false, false};
    return rule;
}

static belt_rule_t dimension(belt_real_t value) {
    return closed(BELT_DIMENSION_MIN, value, BELT_DIMENSION_MAX);
}

static belt_rule_t at_most(belt_real_t value, belt_real_t upper) {
    return closed(-BELT_REAL_MAX, value, upper);
}

static belt_rule_t above(belt_real_t lower, belt_real_t value) {
    belt_rule_t rule = closed(lower, value, BELT_REAL_MAX);
    rule.lower_open = true;
    return rule;
}

static belt_rule_t line_rule(const belt_config_t *config, belt_status_t code) {
    switch (code) {
        case BELT_BELT_LENGTH: return dimension(config->belt_length);
        case BELT_PROCESSING_TIME: return dimension(config->processing_time);
        case BELT_SPEED_WINDOW: return dimension(config->speed_window);
        case BELT_CONGESTION_SCALE: return dimension(config->congestion_scale);
        case BELT_CONNECTIVITY:
            return closed(BELT_DIMENSION_MIN, config->connectivity, BELT_REAL(1));
        case BELT_SERVICE_RATE_MAX: return dimension(config->service_rate_max);
        case BELT_SERVICE_TIME: return dimension(config->service_time);
        case BELT_LEVEL_CAPACITY: return dimension(config->level_capacity);
        case BELT_REWORK_RATE: return closed(BELT_REAL(0), config->rework_rate, BELT_DIMENSION_MAX);
        case BELT_LOSS_COUNT:
            return closed(BELT_REAL(1), BELT_REAL(config->loss_count),
                          BELT_REAL(BELT_LOSS_CAPACITY));
        default: return closed(-BELT_DIMENSION_MAX, worst_loss_rate(config), BELT_DIMENSION_MAX);
    }
}

static belt_rule_t discretisation_rule(const belt_config_t *config, belt_status_t code) {
    const belt_real_t nodes = BELT_REAL(config->node_count);
    const belt_real_t dwell_max = belt_config_dead_time_max(config) / nodes;
    switch (code) {
        case BELT_NODE_COUNT: return closed(BELT_REAL(4), nodes, BELT_REAL(BELT_NODE_CAPACITY));
        case BELT_PERIOD: return dimension(config->period);
        case BELT_PERIOD_PER_NODE:
            return at_most(config->period, config->processing_time * config->belt_length / nodes);
        case BELT_WINDOW_SHORT: return closed(config->period, config->speed_window, BELT_REAL_MAX);
        case BELT_WINDOW_LONG:
            return at_most(config->speed_window / config->period + BELT_REAL(2),
                           BELT_REAL(BELT_WINDOW_CAPACITY));
        case BELT_DEAD_TIME:
            return at_most(belt_config_dead_time_max(config) / config->period,
                           BELT_REAL(BELT_DEAD_TIME_PERIODS));
        case BELT_LOSS_EXPONENT:
            return at_most(belt_config_loss_exponent(config), BELT_LOSS_EXPONENT_MAX);
        case BELT_LOSS_PER_NODE:
            return at_most(size_of(worst_loss_rate(config)) * dwell_max, BELT_CHANGE_PER_NODE_MAX);
        case BELT_REWORK_PER_NODE:
            return at_most(config->rework_rate * config->belt_length * dwell_max,
                           BELT_CHANGE_PER_NODE_MAX);
        case BELT_REWORK_GAIN: /* A*(D - x) over the belt at its slowest, with what it grows by */
            return at_most(BELT_HALF * config->rework_rate * config->belt_length *
                               belt_config_dead_time_max(config) /
                               (BELT_REAL(1) + belt_expm1(-growth_exponent(config))),
                           BELT_REWORK_GAIN_MAX);
        case BELT_SERVICE_PER_NODE:
            return at_most(dwell_max / config->service_time, BELT_SERVICE_PER_NODE_MAX);
        default: /* slowness gained on one spacing over slowness, with a full buffer */
            return at_most(config->level_capacity * config->processing_time * config->belt_length /
                               (config->congestion_scale * nodes),
                           BELT_CHANGE_PER_NODE_MAX);
    }
}

static belt_rule_t law_rule(const belt_config_t *config, belt_status_t code) {
    switch (code) {
        case BELT_NOMINAL_FLUX_MAX:
            return closed(
                BELT_DIMENSION_MIN, config->nominal_flux_max,
                least(config->level_capacity / config->service_time, config->service_rate_max) /
                    config->connectivity);
        case BELT_LEVEL_SETPOINT: {
            belt_rule_t rule = above(BELT_REAL(0), config->level_setpoint);
            /* A few roundings below alpha*Bmax*service_time, so that the flux stays below Bmax. */
            rule.upper = (BELT_REAL(1) - BELT_REAL(8) * BELT_REAL_EPSILON) * config->connectivity *
                         config->nominal_flux_max * config->service_time;
            rule.upper_open = true;
            return rule;
        }
        case BELT_SLOPE_KIND:
            return closed(BELT_REAL(BELT_SLOPE_MARGIN), BELT_REAL(config->slope_kind),
                          BELT_REAL(BELT_SLOPE_ABSOLUTE));
        case BELT_SETPOINT_SLOPE:
            return above(belt_config_slope_min(config), belt_config_slope(config));
        case BELT_PERIOD_PER_SLOPE:
            return at_most(config->connectivity * belt_config_slope(config) * config->period,
                           BELT_SLOPE_PERIODS_MAX);
        case BELT_INLET_FLUX_MAX: return above(BELT_REAL(0), config->inlet_flux_max);
        default:
            return closed(BELT_REAL(BELT_PREDICT_CONGESTION), BELT_REAL(config->prediction),
                          BELT_REAL(BELT_HOLD_CONGESTION));
    }
}

static belt_rule_t supervisor_rule(const belt_config_t *config, belt_status_t code) {
    switch (code) {
        case BELT_ESTIMATOR_KIND:
            return closed(BELT_REAL(BELT_ESTIMATOR_OFF), BELT_REAL(config->estimator),
                          BELT_REAL(BELT_ESTIMATOR_ON));
        case BELT_ESTIMATOR_TIME: {
            belt_rule_t rule =
                closed(config->period * BELT_REAL(belt_config_sample_periods(config)),
                       belt_config_estimator_time(config), BELT_DIMENSION_MAX);
            /* Off, only a number is asked for. */
            rule.lower = (config->estimator == BELT_ESTIMATOR_ON) ? rule.lower : BELT_REAL(0);
            return rule;
        }
        case BELT_FLUX_RATE_MAX:
            return closed(BELT_REAL(0), config->flux_rate_max, BELT_DIMENSION_MAX);
        case BELT_SUBSTITUTE_FLUX:
            return closed(BELT_REAL(0), config->substitute_flux,
                          least(config->inlet_flux_max, belt_config_flux_bound(config)));
        case BELT_LEVEL_STEP_MAX:
            return closed(BELT_REAL(0), config->level_step_max, BELT_DIMENSION_MAX);
        default: return closed(BELT_REAL(0), config->transfer_time, BELT_DIMENSION_MAX);
    }
}

belt_rule_t belt_config_rule(const belt_config_t *config, belt_status_t code) {
    BELT_ASSERT(config != NULL);
    BELT_ASSERT((code >= BELT_RULE_FIRST) && (code <= BELT_RULE_LAST));
    if (code <= BELT_LOSS_RATE) {
        return line_rule(config, code);
    }
    if (code <= BELT_CONGESTION_PER_NODE) {
        return discretisation_rule(config, code);
    }
    return (code <= BELT_PREDICTION_KIND) ? law_rule(config, code) : supervisor_rule(config, code);
}

bool belt_rule_holds(const belt_rule_t *rule) {
    const bool high_enough =
        rule->lower_open ? (rule->value > rule->lower) : (rule->value >= rule->lower);
    const bool low_enough =
        rule->upper_open ? (rule->value < rule->upper) : (rule->value <= rule->upper);
    return high_enough && low_enough;
}

belt_status_t belt_config_check(const belt_config_t *config, uint64_t *broken) {
    BELT_ASSERT(config != NULL);
    belt_status_t first = BELT_OK;
    uint64_t mask = 0;
    for (int code = (int)BELT_RULE_FIRST; code <= (int)BELT_RULE_LAST; ++code) {
        const belt_rule_t rule = belt_config_rule(config, (belt_status_t)code);
        if (!belt_rule_holds(&rule)) {
            mask |= BELT_RULE_BIT(code);
            first = (first == BELT_OK) ? (belt_status_t)code : first;
        }
    }
    if (broken != NULL) {
        *broken = mask;
    }
    return first;
}
