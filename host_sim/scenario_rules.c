/* SPDX-License-Identifier: MIT */
#include "scenario_rules.h"

#include "schedule.h"

/* The controller counts these in 16 bits. */
#define PERIODS_MAX 65535

/* Lists that belong together. */
static const struct {
    const char *section;
    const char *times;
    const char *values;
    size_t offset; /* of the times in scenario_t */
} SCHEDULES[] = {
    {"run", "setpoint_times", "setpoint_levels", offsetof(scenario_t, run.setpoints.times)},
    {"run", "mode_times", "mode_values", offsetof(scenario_t, run.modes.times)},
    {"run", "manual_times", "manual_values", offsetof(scenario_t, run.manual.times)},
    {"plant", "disturbance_times", "disturbance_values",
     offsetof(scenario_t, plant.disturbance.times)},
    {"plant", "service_times", "service_values", offsetof(scenario_t, plant.service.times)},
};

static bool times_ascend(const double *times, size_t count, const scenario_entry_t *entry,
                         const scenario_place_t *place) {
    for (size_t index = 1; index < count; index++) {
        if (times[index] <= times[index - 1]) {
            scenario_complain(place, entry, "%.17g after %.17g; times must ascend", times[index],
                              times[index - 1]);
            return false;
        }
    }
    return true;
}

static bool schedules_are_sound(const scenario_t *scenario, const size_t *list_count,
                                const scenario_place_t *place) {
    for (size_t index = 0; index < sizeof SCHEDULES / sizeof SCHEDULES[0]; index++) {
        const char *const section = SCHEDULES[index].section;
        const size_t times = list_count[scenario_key_find(section, SCHEDULES[index].times)];
        const size_t values = list_count[scenario_key_find(section, SCHEDULES[index].values)];
        const scenario_entry_t entry = {section, SCHEDULES[index].times, NULL};
        if (times != values) {
            scenario_complain(place, &entry, "%zu values, but %s has %zu; must be as many", times,
                              SCHEDULES[index].values, values);
            return false;
        }
        const char *const member = (const char *)scenario + SCHEDULES[index].offset;
        if (!times_ascend((const double *)(const void *)member, times, &entry, place)) {
            return false;
        }
    }
    return true;
}

static bool start_is_sound(const scenario_t *scenario, const scenario_place_t *place) {
    if (scenario->initial.buffer_level > scenario->plant.line.level_capacity) {
        const scenario_entry_t entry = {"initial", "buffer_level", NULL};
        scenario_complain(place, &entry, "%.17g must be at most the plant's level_capacity %.17g",
                          scenario->initial.buffer_level, scenario->plant.line.level_capacity);
        return false;
    }
    if (scenario->run.duration / scenario->controller.period > SCENARIO_STEPS_MAX) {
        const scenario_entry_t entry = {"run", "duration", NULL};
        scenario_complain(place, &entry, "%.17g is more than %g periods of %.17g",
                          scenario->run.duration, SCENARIO_STEPS_MAX, scenario->controller.period);
        return false;
    }
    return true;
}

static bool is_counted(const scenario_t *scenario, const char *key, double duration,
                       const scenario_place_t *place) {
    const double period = scenario->controller.period;
    const bool fits = duration / period <= PERIODS_MAX;
    if (!fits) {
        const scenario_entry_t entry = {"controller", key, NULL};
        scenario_complain(place, &entry, "%.17g is more than %d periods of %.17g", duration,
                          PERIODS_MAX, period);
    }
    return fits;
}

/* The mode that the operator has asked for when a time has come. */
static scenario_mode_t mode_at(const scenario_t *scenario, double time) {
    scenario_mode_t mode = MODE_AUTOMATIC;
    for (size_t index = 0; index < scenario->run.modes.count; index++) {
        mode = scenario->run.modes.times[index] <= time ? scenario->run.modes.words[index] : mode;
    }
    return mode;
}

static bool flux_is_within(const scenario_t *scenario, const char *key, double flux,
                           const scenario_place_t *place) {
    const bool is_within = flux <= scenario->controller.inlet_flux_max;
    if (!is_within) {
        const scenario_entry_t entry = {"run", key, NULL};
        scenario_complain(place, &entry, "%.17g must be at most controller.inlet_flux_max %.17g",
                          flux, scenario->controller.inlet_flux_max);
    }
    return is_within;
}

static bool operator_is_sound(const scenario_t *scenario, const scenario_place_t *place) {
    const schedule_t *const manual = &scenario->run.manual;
    const scenario_law_t law = scenario->controller.law;
    if (scenario->run.modes.count > 0 && law != LAW_PREDICTOR && law != LAW_FROZEN) {
        const scenario_entry_t entry = {"run", "mode_times", NULL};
        scenario_complain(place, &entry, "controller.law must be predictor or frozen");
        return false;
    }
    for (size_t index = 0; index < manual->count; index++) {
        if (mode_at(scenario, manual->times[index]) != MODE_MANUAL) {
            const scenario_entry_t entry = {"run", "manual_times", NULL};
            scenario_complain(place, &entry, "at %.17g the mode must be manual",
                              manual->times[index]);
            return false;
        }
        if (!flux_is_within(scenario, "manual_values", manual->values[index], place)) {
            return false;
        }
    }
    return flux_is_within(scenario, "manual_flux", scenario->run.manual_flux, place);
}

/* What keeps a fault from meaning anything in this scenario, NULL when nothing does. */
static const char *why_senseless(const scenario_t *scenario, const fault_t *fault) {
    if (fault->signal == FAULT_ON_OUTLET_FLUX &&
        scenario->controller.outlet_flux == OUTLET_MODELLED) {
        return "controller.outlet_flux must be measured for a fault of outlet_flux";
    }
    if (fault->signal == FAULT_ON_DENSITY && scenario->controller.density == DENSITY_OBSERVED) {
        return "controller.density must be measured for a fault of density";
    }
    if (fault->word == FAULT_DELAYED &&
        fault->value / scenario->controller.period > FAULT_DELAY_PERIODS) {
        return "a delay must be at most 10000 periods";
    }
    return NULL;
}

static bool faults_are_sound(const scenario_t *scenario, const scenario_place_t *place) {
    for (size_t index = 0; index < scenario->run.fault_count; index++) {
        const char *const reason = why_senseless(scenario, &scenario->run.faults[index]);
        if (reason != NULL) {
            const scenario_entry_t entry = {"run", "faults", NULL};
            scenario_complain(place, &entry, "fault %zu: %s", index + 1, reason);
            return false;
        }
    }
    return true;
}

bool scenario_rules_hold(const scenario_t *scenario, const size_t list_count[SCENARIO_KEY_CAPACITY],
                         const scenario_place_t *place) {
    return start_is_sound(scenario, place) && schedules_are_sound(scenario, list_count, place) &&
           is_counted(scenario, "hold_time", scenario->controller.hold_time, place) &&
           is_counted(scenario, "level_sample_time", scenario->controller.level_sample_time,
                      place) &&
           operator_is_sound(scenario, place) && faults_are_sound(scenario, place);
}
