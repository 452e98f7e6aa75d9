/* SPDX-License-Identifier: MIT */
#include "loop.h"

#include <math.h>
#include <string.h>

#include "model.h"
#include "operator.h"
#include "plant.h"
#include "power.h"
#include "reception.h"
#include "rivals.h"
#include "self_check.h"
#include "sensors.h"
#include "surroundings.h"
#include "task.h"
#include "valve.h"

/** Places at which rows carry the plant's density. */
#define DENSITY_COUNT 101
/** Places in a cell at which the plant's density is taken to compare it with the observer's. */
#define PLACES_PER_CELL 64

/** Both sides, and what stands between them. */
typedef struct {
    const scenario_t *scenario;
    plant_t plant;
    surroundings_t surroundings;
    sensors_t sensors;
    readings_t readings;
    reception_t reception;
    task_t task;
    operator_t panel;
    belt_config_t config;
    belt_controller_t controller;
    power_t power;
    rivals_t rivals;
    belt_command_t command; /**< the last step's. */
    double inlet_flux;      /**< what the scenario's law feeds, in force [parts/s]. */
    valve_t valve;
    self_check_t self_check;
    size_t steps;
    double scratch[BELT_NODE_CAPACITY * PLACES_PER_CELL + 2];
    double density[DENSITY_COUNT];
} loop_t;

static bool create_plant(loop_t *loop) {
    const scenario_t *scenario = loop->scenario;
    const plant_setup_t setup = {
        &scenario->plant.line,
        scenario->controller.period,
        (size_t)scenario->plant.substeps,
        (size_t)scenario->plant.node_count,
        scenario->plant.inlet_flux_max,
        scenario->initial.buffer_level,
        &scenario->initial.density,
    };
    return plant_create(&loop->plant, &setup,
                        (scenario->plant.scheme == SCHEME_UPWIND) ? &scheme_upwind
                                                                  : &scheme_characteristics);
}

/** Integral of a profile up to a place, from its integrals up to whole places. */
static double integral_to(const double *integral, double place) {
    const size_t whole = (size_t)place;
    return integral[whole] + (place - (double)whole) * (integral[whole + 1] - integral[whole]);
}

/** Greatest difference between a whole cell's density and the plant's mean over the same stretch:
 * means, because a cell knows no more of what lies in it [parts/m]. */
static double observer_error(loop_t *loop) {
    const belt_observer_t *observer = &loop->controller.model.observer;
    const belt_line_t *line = &loop->controller.model.line;
    const size_t count = (size_t)line->node_count * PLACES_PER_CELL + 1;
    double *const integral = loop->scratch;
    plant_profile(&loop->plant, integral, count);
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) { /* trapezoids between the places */
        const double density = integral[i];
        integral[i] = sum;
        sum += 0.5 * (density + ((i + 1 < count) ? integral[i + 1] : 0.0));
    }
    double greatest = 0.0;
    for (uint32_t i = 1; i < line->node_count; ++i) {
        const double from = ((double)i - (double)observer->gone) * PLACES_PER_CELL;
        const double mean =
            (integral_to(integral, from + PLACES_PER_CELL) - integral_to(integral, from)) /
            PLACES_PER_CELL;
        const uint32_t cell = belt_observer_behind(line, observer->outlet, i);
        greatest = fmax(greatest, fabs((double)observer->density[cell] - mean));
    }
    return greatest;
}

static loop_row_t observe(loop_t *loop, size_t k, bool wants_observer) {
    const plant_t *plant = &loop->plant;
    const belt_controller_t *controller = &loop->controller;
    const belt_prediction_t *prediction = &controller->prediction;
    const signal_t *level = &loop->readings.level;
    loop_row_t row;
    row.time = (double)k * loop->scenario->controller.period;
    row.buffer_level = plant->level;
    row.level_setpoint = (double)controller->config.level_setpoint;
    row.inlet_flux = loop->inlet_flux;
    row.congestion = plant->congestion;
    row.transport_speed = plant_speed(plant);
    row.outlet_flux = plant_outlet_flux(plant);
    row.predicted_level = (double)prediction->inlet.level;
    row.arrival_time = row.time + (double)prediction->inlet.arrival;
    row.survival = (double)prediction->inlet_survival;
    row.level_measured = level->is_present ? (double)reception_number(level, 0) : (double)NAN;
    row.applied_flux = plant->applied_flux;
    row.disturbance = (double)controller->model.estimator.disturbance;
    row.mode = (double)loop->command.mode;
    row.error_bits = (double)loop->command.error_bits;
    row.level_estimate = (double)controller->model.present.level;
    row.level_quality = (double)controller->gate.level_quality;
    row.observer_error = wants_observer ? observer_error(loop) : 0.0;
    return row;
}

/** The controller starts again from its snapshot, and the operator says again what is in force. */
static loop_status_t restart(loop_t *loop, size_t k, FILE *messages) {
    if (!power_restart(&loop->power, &loop->controller, &loop->config, k)) {
        fprintf(messages, "%s: self-check at period %zu: the controller does not start again\n",
                loop->scenario->name, k);
        return LOOP_SELF_CHECK;
    }
    loop->self_check.inlet_flux_before = (double)loop->controller.command.inlet_flux;
    return operator_repeat(&loop->panel, &loop->controller, messages) ? LOOP_DONE : LOOP_SELF_CHECK;
}

/** The control task, once. */
static loop_status_t step(loop_t *loop, size_t k, uint32_t elapsed_ticks, FILE *messages) {
    if (!operator_speak(&loop->panel, &loop->controller, k, messages)) {
        return LOOP_CONFIG_REFUSED;
    }
    reception_take(&loop->reception, loop->scenario, &loop->readings, elapsed_ticks,
                   loop->steps == 0);
    const belt_status_t status =
        belt_step(&loop->controller, &loop->reception.measurement, &loop->command);
    if (!model_expects(loop->scenario, status)) {
        fprintf(messages,
                "%s: self-check at period %zu: the controller says %s (error bits %#lx)\n",
                loop->scenario->name, k, belt_status_name(status),
                (unsigned long)loop->command.error_bits);
        return LOOP_SELF_CHECK;
    }
    power_keep(&loop->power, &loop->controller, k);
    loop->inlet_flux =
        rivals_flux(&loop->rivals, &loop->controller, &loop->command, loop->panel.level_setpoint);
    loop->steps += 1;
    return LOOP_DONE;
}

/** Looks at the row, and hands it on. */
static loop_status_t report(loop_t *loop, size_t k, const loop_sink_t *sink, FILE *messages,
                            loop_totals_t *totals) {
    const plant_t *plant = &loop->plant;
    const plant_account_t *account = &plant->account;
    const double parts =
        plant->parts_at_start + account->fed + account->reworked + fabs(account->disturbed);
    const loop_row_t row = observe(loop, k, sink->wants_observer);
    totals->steps = loop->steps;
    totals->spilled = account->spilled;
    totals->disturbed = account->disturbed;
    totals->balance_error = plant_balance_error(plant);
    if (!self_check_passes(&loop->self_check, &row, parts, totals->balance_error, messages)) {
        return LOOP_SELF_CHECK;
    }
    if (sink->wants_density) {
        plant_profile(plant, loop->density, DENSITY_COUNT);
    }
    return sink->take(sink->context, &row, loop->density, DENSITY_COUNT) ? LOOP_DONE : LOOP_STOPPED;
}

static loop_status_t run_periods(loop_t *loop, const loop_sink_t *sink, FILE *messages,
                                 loop_totals_t *totals) {
    const double periods = loop->scenario->run.duration / loop->scenario->controller.period;
    const size_t last = (size_t)floor(periods + 0.5);
    loop_status_t status = LOOP_DONE;
    for (size_t k = 0; (k <= last) && (status == LOOP_DONE); ++k) {
        const task_period_t period = task_next(&loop->task, k);
        surroundings_change(&loop->surroundings, &loop->plant, k);
        loop->readings = sensors_read(&loop->sensors, &loop->plant, k);
        if (period.restarts) {
            status = restart(loop, k, messages);
        }
        if (period.steps && (status == LOOP_DONE)) {
            status = step(loop, k, period.elapsed_ticks, messages);
        }
        if (status == LOOP_DONE) {
            status = report(loop, k, sink, messages, totals);
        }
        if (k < last) {
            plant_advance(&loop->plant, period.has_power
                                            ? valve_obey(&loop->valve, k, loop->inlet_flux)
                                            : valve_close(&loop->valve));
        }
    }
    return status;
}

static void begin(loop_t *loop, const scenario_t *scenario) {
    memset(loop, 0, sizeof *loop);
    loop->scenario = scenario;
    model_config(scenario, &loop->config);
    surroundings_begin(&loop->surroundings, scenario);
    rivals_begin(&loop->rivals, scenario);
    task_begin(&loop->task, scenario);
    operator_begin(&loop->panel, scenario);
    power_begin(&loop->power, scenario);
}

static void begin_self_check(loop_t *loop) {
    const double rate = (double)loop->config.flux_rate_max;
    const bool has_rate = (rate > 0.0) && rivals_are_out(loop->scenario);
    const self_check_t self_check = {
        loop->scenario->name,
        (double)loop->config.inlet_flux_max,
        has_rate ? rate * (double)loop->config.period : (double)INFINITY,
        (double)BELT_REAL_EPSILON,
        loop->scenario->plant.line.level_capacity,
        0.0,
    };
    loop->self_check = self_check;
}

loop_status_t loop_run(const scenario_t *scenario, const loop_sink_t *sink, FILE *messages,
                       loop_totals_t *totals) {
    static loop_t loop; /* one run at a time: too large for the stack */
    const loop_totals_t nothing = {0};
    *totals = nothing;
    begin(&loop, scenario);
    if (belt_init(&loop.controller, &loop.config) != BELT_OK) {
        model_print_refusals(&loop.config, scenario->name, messages);
        return LOOP_CONFIG_REFUSED;
    }
    begin_self_check(&loop);
    loop_status_t status = LOOP_NO_MEMORY;
    if (create_plant(&loop)) {
        if (sensors_create(&loop.sensors, scenario) && valve_create(&loop.valve, scenario)) {
            status = run_periods(&loop, sink, messages, totals);
        } else {
            fprintf(messages, "not enough memory for the sensors\n");
        }
        plant_destroy(&loop.plant);
    } else {
        fprintf(messages, "not enough memory for the plant\n");
    }
    valve_destroy(&loop.valve);
    sensors_destroy(&loop.sensors);
    return status;
}
