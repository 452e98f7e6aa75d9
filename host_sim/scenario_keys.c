/* SPDX-License-Identifier: MIT */
#include "scenario_keys.h"

#include <math.h>
#include <string.h>

#include "scenario.h"

/* The ranges keep the simulator from dividing by zero and counting without end; what the controller
 * asks of its numbers is its own rule, which `belt_sim check` reports. */
static const scenario_range_t ANY = {-(double)INFINITY, (double)INFINITY, true};
static const scenario_range_t POSITIVE = {0.0, (double)INFINITY, false};
static const scenario_range_t NOT_NEGATIVE = {0.0, (double)INFINITY, true};
static const scenario_range_t SHARE = {0.0, 1.0, false};
static const scenario_range_t CONTROLLER_NODES = {1.0, 10000.0, true};
static const scenario_range_t PLANT_NODES = {1.0, 100000.0, true};
static const scenario_range_t SUBSTEPS = {1.0, 10000.0, true};
static const scenario_range_t SEEDS = {0.0, 4294967295.0, true};
static const scenario_range_t SAMPLES = {1.0, 65535.0, true};

#define AT(member) offsetof(scenario_t, member)

#define NUMBER(section, name, member, fallback, range)                                             \
    {section, name, KEY_NUMBER, AT(member), 0, fallback, &(range), NULL}
#define COUNT(section, name, member, fallback, range)                                              \
    {section, name, KEY_COUNT, AT(member), 0, fallback, &(range), NULL}
#define WORD(section, name, member, fallback, words)                                               \
    {section, name, KEY_WORD, AT(member), 0, fallback, &ANY, words}
#define LIST(section, name, member, count, fallback, range)                                        \
    {section, name, KEY_LIST, AT(member), AT(count), fallback, &(range), NULL}

#define WORDS(section, name, member, count, words)                                                 \
    {section, name, KEY_WORDS, AT(member), AT(count), NULL, &ANY, words}
#define FAULTS(section, name, member, count)                                                       \
    {section, name, KEY_FAULTS, AT(member), AT(count), NULL, &ANY, NULL}

/* The keys of [line] stand once and are laid out twice: for the model, and for the plant, whose
 * rows have no default because a key left out there is the model's. */
#define LINE_KEYS(section, line, fallback)                                                         \
    NUMBER(section, "belt_length", line.belt_length, fallback("2"), POSITIVE),                     \
        NUMBER(section, "processing_time", line.processing_time, fallback("0.25"), POSITIVE),      \
        NUMBER(section, "speed_window", line.speed_window, fallback("0.2"), POSITIVE),             \
        NUMBER(section, "congestion_scale", line.congestion_scale, fallback("1"), POSITIVE),       \
        NUMBER(section, "connectivity", line.connectivity, fallback("0.5"), SHARE),                \
        NUMBER(section, "service_rate_max", line.service_rate_max, fallback("0.8"), POSITIVE),     \
        NUMBER(section, "service_time", line.service_time, fallback("1"), POSITIVE),               \
        NUMBER(section, "level_capacity", line.level_capacity, fallback("1"), POSITIVE),           \
        NUMBER(section, "rework_rate", line.rework_rate, fallback("0.1"), NOT_NEGATIVE),           \
        LIST(section, "loss_rate", line.loss_rate.value, line.loss_rate.count, fallback("1"), ANY)
#define STATED(text) text
#define LEFT_OUT(text) NULL

static const scenario_key_t KEYS[] = {
    LINE_KEYS("line", line, STATED),

    NUMBER("law", "level_setpoint", law.level_setpoint, "0.3", ANY),
    NUMBER("law", "nominal_flux_max", law.nominal_flux_max, "1.2", ANY),
    NUMBER("law", "slope_margin", law.slope, "20", ANY),
    NUMBER("law", "setpoint_slope", law.slope, NULL, ANY),

    WORD("controller", "law", controller.law, "predictor",
         "predictor frozen uncompensated open_loop"),
    WORD("controller", "density", controller.density, "observed", "observed measured"),
    WORD("controller", "outlet_flux", controller.outlet_flux, "modelled", "modelled measured"),
    COUNT("controller", "node_count", controller.node_count, "20", CONTROLLER_NODES),
    NUMBER("controller", "period", controller.period, "0.0025", POSITIVE),
    NUMBER("controller", "inlet_flux_max", controller.inlet_flux_max, NULL, POSITIVE),

    WORD("controller", "estimator", controller.estimator, "off", "off on"),
    NUMBER("controller", "estimator_time", controller.estimator_time, NULL, POSITIVE),
    NUMBER("controller", "flux_rate_max", controller.flux_rate_max, NULL, POSITIVE),
    NUMBER("controller", "substitute_flux", controller.substitute_flux, "0", NOT_NEGATIVE),
    NUMBER("controller", "level_step_max", controller.level_step_max, NULL, POSITIVE),
    NUMBER("controller", "transfer_time", controller.transfer_time, NULL, POSITIVE),
    NUMBER("controller", "level_sample_time", controller.level_sample_time, NULL, POSITIVE),
    NUMBER("controller", "hold_time", controller.hold_time, NULL, POSITIVE),
    COUNT("controller", "recovery_samples", controller.recovery_samples, NULL, SAMPLES),

    WORD("plant", "scheme", plant.scheme, "characteristics", "characteristics upwind"),
    COUNT("plant", "node_count", plant.node_count, NULL, PLANT_NODES),
    COUNT("plant", "substeps", plant.substeps, NULL, SUBSTEPS),
    NUMBER("plant", "inlet_flux_max", plant.inlet_flux_max, NULL, POSITIVE),
    NUMBER("plant", "level_noise", plant.level_noise, "0", NOT_NEGATIVE),
    NUMBER("plant", "level_quantum", plant.level_quantum, "0", NOT_NEGATIVE),
    NUMBER("plant", "level_sample_time", plant.level_sample_time, "0", NOT_NEGATIVE),
    COUNT("plant", "seed", plant.seed, "1", SEEDS),
    LIST("plant", "disturbance_times", plant.disturbance.times, plant.disturbance.count, NULL,
         NOT_NEGATIVE),
    LIST("plant", "disturbance_values", plant.disturbance.values, plant.disturbance.count, NULL,
         ANY),
    LIST("plant", "service_times", plant.service.times, plant.service.count, NULL, NOT_NEGATIVE),
    LIST("plant", "service_values", plant.service.values, plant.service.count, NULL, NOT_NEGATIVE),
    LINE_KEYS("plant", plant.line, LEFT_OUT),

    NUMBER("initial", "buffer_level", initial.buffer_level, "0", NOT_NEGATIVE),
    LIST("initial", "density", initial.density.value, initial.density.count, "0", NOT_NEGATIVE),
    LIST("initial", "observer_density", initial.observer_density.value,
         initial.observer_density.count, "0", NOT_NEGATIVE),

    NUMBER("run", "duration", run.duration, "10", POSITIVE),
    LIST("run", "setpoint_times", run.setpoints.times, run.setpoints.count, NULL, NOT_NEGATIVE),
    LIST("run", "setpoint_levels", run.setpoints.values, run.setpoints.count, NULL, ANY),
    LIST("run", "mode_times", run.modes.times, run.modes.count, NULL, NOT_NEGATIVE),
    WORDS("run", "mode_values", run.modes.words, run.modes.count, "off manual automatic"),
    NUMBER("run", "manual_flux", run.manual_flux, NULL, NOT_NEGATIVE),
    LIST("run", "manual_times", run.manual.times, run.manual.count, NULL, NOT_NEGATIVE),
    LIST("run", "manual_values", run.manual.values, run.manual.count, NULL, NOT_NEGATIVE),
    NUMBER("run", "snapshot_period", run.snapshot_period, NULL, POSITIVE),
    FAULTS("run", "faults", run.faults, run.fault_count),
};

#define ROWS (sizeof KEYS / sizeof KEYS[0])
typedef char static_assert_rows_fit_capacity[ROWS <= SCENARIO_KEY_CAPACITY ? 1 : -1];

size_t scenario_key_count(void) {
    return ROWS;
}

const scenario_key_t *scenario_key_at(size_t index) {
    return &KEYS[index];
}

size_t scenario_key_find(const char *section, const char *name) {
    size_t index = 0;
    while (index < ROWS &&
           (strcmp(KEYS[index].section, section) != 0 || strcmp(KEYS[index].name, name) != 0)) {
        index++;
    }
    return index;
}

size_t scenario_section_find(const char *section, size_t length) {
    size_t index = 0;
    while (index < ROWS && (strlen(KEYS[index].section) != length ||
                            memcmp(KEYS[index].section, section, length) != 0)) {
        index++;
    }
    return index;
}
