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

#define AT(member) offsetof(scenario_t, member)

#define NUMBER(section, name, member, fallback, range)                                             \
    {section, name, KEY_NUMBER, AT(member), 0, fallback, &(range), NULL}
#define COUNT(section, name, member, fallback, range)                                              \
    {section, name, KEY_COUNT, AT(member), 0, fallback, &(range), NULL}
#define WORD(section, name, member, fallback, words)                                               \
    {section, name, KEY_WORD, AT(member), 0, fallback, &ANY, words}
#define LIST(section, name, member, count, fallback, range)                                        \
    {section, name, KEY_LIST, AT(member), AT(count), fallback, &(range), NULL}

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
        LIST(section, "loss_rate", line.loss_rate.value, line.loss_rate.count, fallback("1"),      \
             NOT_NEGATIVE)
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

    WORD("plant", "scheme", plant.scheme, "characteristics", "characteristics upwind"),
    COUNT("plant", "node_count", plant.node_count, NULL, PLANT_NODES),
    COUNT("plant", "substeps", plant.substeps, NULL, SUBSTEPS),
    NUMBER("plant", "inlet_flux_max", plant.inlet_flux_max, NULL, POSITIVE),
    LINE_KEYS("plant", plant.line, LEFT_OUT),

    NUMBER("initial", "buffer_level", initial.buffer_level, "0", NOT_NEGATIVE),
    LIST("initial", "density", initial.density.value, initial.density.count, "0", NOT_NEGATIVE),
    LIST("initial", "observer_density", initial.observer_density.value,
         initial.observer_density.count, "0", NOT_NEGATIVE),

    NUMBER("run", "duration", run.duration, "10", POSITIVE),
    LIST("run", "setpoint_times", run.setpoint_times, run.setpoint_count, NULL, NOT_NEGATIVE),
    LIST("run", "setpoint_levels", run.setpoint_levels, run.setpoint_count, NULL, ANY),
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
