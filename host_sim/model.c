/* SPDX-License-Identifier: MIT */
#include "model.h"

#include <math.h>
#include <string.h>

#include "schedule.h"

/** What a rule speaks of, as the scenario's reader knows it, and why there is such a rule. */
typedef struct {
    belt_status_t code;
    const char *value;
    const char *reason;
} rule_text_t;

static const rule_text_t rule_texts[] = {
    {BELT_BELT_LENGTH, "line.belt_length", "a dimension"},
    {BELT_PROCESSING_TIME, "line.processing_time", "a dimension"},
    {BELT_SPEED_WINDOW, "line.speed_window", "a dimension"},
    {BELT_CONGESTION_SCALE, "line.congestion_scale", "a dimension"},
    {BELT_CONNECTIVITY, "line.connectivity", "a share of what leaves the belt"},
    {BELT_SERVICE_RATE_MAX, "line.service_rate_max", "a dimension"},
    {BELT_SERVICE_TIME, "line.service_time", "a dimension"},
    {BELT_LEVEL_CAPACITY, "line.level_capacity", "a dimension"},
    {BELT_REWORK_RATE, "line.rework_rate", "a rate"},
    {BELT_LOSS_COUNT, "values in line.loss_rate", "BELT_LOSS_CAPACITY of this build"},
    {BELT_LOSS_RATE, "line.loss_rate greatest in size", "a rate, below 0 of growth"},
    {BELT_NODE_COUNT, "controller.node_count", "BELT_NODE_CAPACITY of this build"},
    {BELT_PERIOD, "controller.period", "a dimension"},
    {BELT_PERIOD_PER_NODE, "controller.period",
     "an empty line moves at most one node spacing a period: "
     "processing_time*belt_length/node_count"},
    {BELT_WINDOW_SHORT, "line.speed_window", "at least one period"},
    {BELT_WINDOW_LONG, "speed_window/period + 2", "BELT_WINDOW_CAPACITY of this build"},
    {BELT_DEAD_TIME, "longest dead time/period", "arrival times keep their resolution"},
    {BELT_LOSS_EXPONENT, "mean size of loss_rate*longest dead time",
     "exponent of 1/survival: beyond it feeding more is no remedy"},
    {BELT_LOSS_PER_NODE, "greatest size of loss_rate*longest dead time/node_count",
     "loss in one cell: raise node_count"},
    {BELT_REWORK_PER_NODE, "rework_rate*belt_length*longest dead time/node_count",
     "rework in one cell: raise node_count"},
    {BELT_REWORK_GAIN, "rework_rate*belt_length*longest dead time*growth/2",
     "share of what leaves that comes back, losses left aside: beyond 1 the belt fills by itself"},
    {BELT_SERVICE_PER_NODE, "longest dead time/node_count/service_time",
     "the buffer changes little while a cell passes: raise node_count"},
    {BELT_CONGESTION_PER_NODE,
     "level_capacity*processing_time*belt_length/(congestion_scale*node_count)",
     "the speed changes little while a cell passes: raise node_count"},
    {BELT_NOMINAL_FLUX_MAX, "law.nominal_flux_max",
     "min(level_capacity/service_time, service_rate_max)/connectivity"},
    {BELT_LEVEL_SETPOINT, "law.level_setpoint",
     "below connectivity*nominal_flux_max*service_time, or the law cannot raise the level"},
    {BELT_SLOPE_KIND, "kind of slope", "margin or absolute"},
    {BELT_SETPOINT_SLOPE, "setpoint slope S", "above Smin, or a gain has no positive root"},
    {BELT_PERIOD_PER_SLOPE, "connectivity*S*period",
     "the period is short enough for the slope of the law"},
    {BELT_INLET_FLUX_MAX, "controller.inlet_flux_max", "a limit above 0"},
    {BELT_PREDICTION_KIND, "kind of prediction", "predictor or frozen"},
    {BELT_ESTIMATOR_KIND, "kind of estimator", "off or on"},
    {BELT_ESTIMATOR_TIME, "controller.estimator_time", "at least the time between two samples"},
    {BELT_FLUX_RATE_MAX, "controller.flux_rate_max", "left out (0), or a dimension"},
    {BELT_SUBSTITUTE_FLUX, "controller.substitute_flux",
     "a flux that the valve and a sound line can pass"},
    {BELT_LEVEL_STEP_MAX, "controller.level_step_max", "left out (0), or a dimension"},
    {BELT_TRANSFER_TIME, "controller.transfer_time", "left out (0), or a dimension"},
};

belt_real_t model_real(double value) {
    if (value > (double)BELT_REAL_MAX) {
        return BELT_REAL_MAX;
    }
    return (value < -(double)BELT_REAL_MAX) ? -BELT_REAL_MAX : (belt_real_t)value;
}

static uint16_t model_count(long count) {
    return (uint16_t)((count < 0) ? 0 : (count > UINT16_MAX) ? UINT16_MAX : count);
}

/** `duration` in whole periods; 0, the controller's own rule, where it is left out. */
static uint16_t model_periods(const scenario_t *scenario, double duration) {
    const double period = scenario->controller.period;
    return (duration > 0.0) ? model_count((long)schedule_periods(duration, period)) : 0;
}

/** What keeps the controller alone with a line. */
static void supervision_config(const scenario_t *scenario, belt_config_t *config) {
    config->estimator =
        (scenario->controller.estimator == ESTIMATOR_ON) ? BELT_ESTIMATOR_ON : BELT_ESTIMATOR_OFF;
    config->estimator_time = model_real(scenario->controller.estimator_time);
    config->flux_rate_max = model_real(scenario->controller.flux_rate_max);
    config->substitute_flux = model_real(scenario->controller.substitute_flux);
    config->level_step_max = model_real(scenario->controller.level_step_max);
    config->transfer_time = model_real(scenario->controller.transfer_time);
    config->sample_periods = model_periods(scenario, scenario->controller.level_sample_time);
    config->hold_periods = model_periods(scenario, scenario->controller.hold_time);
    config->recovery_samples = model_count(scenario->controller.recovery_samples);
}

void model_config(const scenario_t *scenario, belt_config_t *config) {
    const belt_config_t empty = {0};
    const line_t *line = &scenario->line;
    *config = empty;
    config->belt_length = model_real(line->belt_length);
    config->processing_time = model_real(line->processing_time);
    config->speed_window = model_real(line->speed_window);
    config->congestion_scale = model_real(line->congestion_scale);
    config->connectivity = model_real(line->connectivity);
    config->service_rate_max = model_real(line->service_rate_max);
    config->service_time = model_real(line->service_time);
    config->level_capacity = model_real(line->level_capacity);
    config->rework_rate = model_real(line->rework_rate);
    config->loss_count = (uint16_t)line->loss_rate.count;
    for (size_t i = 0; (i < line->loss_rate.count) && (i < BELT_LOSS_CAPACITY); ++i) {
        config->loss_rate[i] = model_real(line->loss_rate.value[i]);
    }
    config->level_setpoint = model_real(scenario->law.level_setpoint);
    config->nominal_flux_max = model_real(scenario->law.nominal_flux_max);
    config->slope_kind = scenario->law.slope_is_absolute ? BELT_SLOPE_ABSOLUTE : BELT_SLOPE_MARGIN;
    config->slope = model_real(scenario->law.slope);
    config->node_count = model_count(scenario->controller.node_count);
    config->period = model_real(scenario->controller.period);
    config->inlet_flux_max = model_real(scenario->controller.inlet_flux_max);
    config->prediction =
        (scenario->controller.law == LAW_FROZEN) ? BELT_HOLD_CONGESTION : BELT_PREDICT_CONGESTION;
    supervision_config(scenario, config);
}

static bool has_lower(const belt_rule_t *rule) {
    return rule->lower > -BELT_REAL_MAX;
}

static bool has_upper(const belt_rule_t *rule) {
    return rule->upper < BELT_REAL_MAX;
}

int model_print_rules(const belt_config_t *config, FILE *out) {
    int broken = 0;
    for (size_t i = 0; i < sizeof rule_texts / sizeof rule_texts[0]; ++i) {
        const rule_text_t *text = &rule_texts[i];
        const belt_rule_t rule = belt_config_rule(config, text->code);
        const bool holds = belt_rule_holds(&rule);
        const double value = (double)rule.value;
        const double below = has_lower(&rule) ? value - (double)rule.lower : (double)INFINITY;
        const double above = has_upper(&rule) ? (double)rule.upper - value : (double)INFINITY;
        broken += holds ? 0 : 1;
        fprintf(out, "  %-6s %-21s margin %-9.3g %s = %.6g in %c%.6g, %.6g%c: %s\n",
                holds ? "holds" : "BROKEN", belt_status_name(text->code), fmin(below, above),
                text->value, value, rule.lower_open ? '(' : '[',
                has_lower(&rule) ? (double)rule.lower : -(double)INFINITY,
                has_upper(&rule) ? (double)rule.upper : (double)INFINITY,
                rule.upper_open ? ')' : ']', text->reason);
    }
    return broken;
}

void model_print_refusals(const belt_config_t *config, const char *name, FILE *messages) {
    for (size_t i = 0; i < sizeof rule_texts / sizeof rule_texts[0]; ++i) {
        const rule_text_t *text = &rule_texts[i];
        const belt_rule_t rule = belt_config_rule(config, text->code);
        if (belt_rule_holds(&rule)) {
            continue;
        }
        fprintf(messages, "%s: %s = %.9g", name, text->value, (double)rule.value);
        const char *and = ", must be";
        if (has_lower(&rule)) {
            fprintf(messages, "%s %s %.9g", and, rule.lower_open ? "above" : "at least",
                    (double)rule.lower);
            and= " and";
        }
        if (has_upper(&rule)) {
            fprintf(messages, "%s %s %.9g", and, rule.upper_open ? "below" : "at most",
                    (double)rule.upper);
        }
        fprintf(messages, " (%s: %s)\n", belt_status_name(text->code), text->reason);
    }
}

bool model_refuses_setpoint(const scenario_t *scenario, size_t index, FILE *messages) {
    belt_config_t config;
    char name[256];
    model_config(scenario, &config);
    config.level_setpoint = model_real(scenario->run.setpoints.values[index]);
    if (belt_config_check(&config, NULL) == BELT_OK) {
        return false;
    }
    (void)snprintf(name, sizeof name, "%s: run.setpoint_levels, at %.9g s", scenario->name,
                   scenario->run.setpoints.times[index]);
    model_print_refusals(&config, name, messages);
    return true;
}

/** Whether plant and controller are told the same line. */
static bool plant_is_the_line(const scenario_t *scenario) {
    return memcmp(&scenario->line, &scenario->plant.line, sizeof scenario->line) == 0;
}

static bool expects_trouble(const scenario_t *scenario) {
    const scenario_law_t law = scenario->controller.law;
    const double limit = scenario->plant.inlet_flux_max;
    return (law == LAW_UNCOMPENSATED) || (law == LAW_OPEN_LOOP) ||
           (scenario->run.fault_count > 0) || (scenario->plant.level_noise > 0.0) ||
           (scenario->plant.level_quantum > 0.0) || (scenario->plant.disturbance.count > 0) ||
           (scenario->plant.service.count > 0) || !plant_is_the_line(scenario) ||
           (limit < scenario->controller.inlet_flux_max) ||
           (scenario->controller.level_sample_time < scenario->plant.level_sample_time);
}

bool model_expects(const scenario_t *scenario, belt_status_t status) {
    switch (status) {
        case BELT_OK: return true;
        case BELT_NO_LEVEL:
        case BELT_INPUT_REJECTED:
        case BELT_PERIODS_MISSED:
        case BELT_LINE_DEVIATES: return expects_trouble(scenario);
        default: break;
    }
    return false;
}
