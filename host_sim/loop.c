/* SPDX-License-Identifier: MIT */
#include "loop.h"

#include <math.h>
#include <string.h>

#include "equilibrium.h"
#include "model.h"
#include "plant.h"

/** Places at which rows carry the plant's density. */
#define DENSITY_COUNT 101
/** A balance error beyond this share of all parts fed is a fault of the plant. */
#define BALANCE_SHARE 1e-3

/** Both sides, and what stands between them. */
typedef struct {
    const scenario_t *scenario;
    plant_t plant;
    belt_controller_t controller;
    belt_real_t profile[BELT_NODE_CAPACITY + 1];
    double scratch[BELT_NODE_CAPACITY + 1];
    double density[DENSITY_COUNT];
    double open_loop_flux;
    size_t setpoints_done;
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

/** What the controller may see of the plant in period `k`. */
static void measure(loop_t *loop, size_t k, belt_measurement_t *measurement) {
    const scenario_t *scenario = loop->scenario;
    const size_t count = (size_t)scenario->controller.node_count + 1;
    const plant_t *plant = &loop->plant;
    memset(measurement, 0, sizeof *measurement);
    measurement->present = BELT_HAS_LEVEL;
    measurement->level = model_real(plant->level);
    measurement->sample_count = (uint32_t)k;
    measurement->elapsed_ticks = 1;
    measurement->density = loop->profile;
    if (k > 0) {
        measurement->present |= BELT_HAS_APPLIED_FLUX;
        measurement->applied_flux = model_real(plant->applied_flux);
    }
    if (scenario->controller.outlet_flux == OUTLET_MEASURED) {
        measurement->present |= BELT_HAS_OUTLET_FLUX;
        measurement->outlet_flux = model_real(plant_outlet_flux(plant));
    }
    if (scenario->controller.density == DENSITY_MEASURED) {
        measurement->present |= BELT_HAS_DENSITY;
        plant_profile(plant, loop->scratch, count);
        for (size_t i = 0; i < count; ++i) {
            loop->profile[i] = model_real(loop->scratch[i]);
        }
    } else if (k == 0) {
        /* What the controller is told to believe of the belt at the start. */
        measurement->present |= BELT_HAS_DENSITY;
        for (size_t i = 0; i < count; ++i) {
            const double place = (double)i / (double)(count - 1);
            loop->profile[i] =
                model_real(profile_at(&scenario->initial.observer_density, place, 1.0));
        }
    }
}

/** Set-points that are due in period `k`. False when one is refused. */
static bool change_setpoint(loop_t *loop, size_t k, FILE *messages) {
    const scenario_t *scenario = loop->scenario;
    while (loop->setpoints_done < scenario->run.setpoint_count) {
        const double due =
            scenario->run.setpoint_times[loop->setpoints_done] / scenario->controller.period;
        if ((double)k < due - 1e-6) {
            break;
        }
        const double level = scenario->run.setpoint_levels[loop->setpoints_done];
        if (model_refuses_setpoint(scenario, loop->setpoints_done, messages) ||
            (belt_set_setpoint(&loop->controller, model_real(level)) != BELT_OK)) {
            return false;
        }
        loop->open_loop_flux = equilibrium_of(&scenario->line, level).inlet_flux;
        loop->setpoints_done += 1;
    }
    return true;
}

/** The command of the law that the scenario asks for. */
static double command_of(const loop_t *loop, const belt_command_t *command) {
    const belt_controller_t *controller = &loop->controller;
    const belt_real_t limit = controller->config.inlet_flux_max;
    switch (loop->scenario->controller.law) {
        case LAW_UNCOMPENSATED:
            return (double)belt_command_limit(
                belt_nominal_law_flux(&controller->law, controller->present.level), limit);
        case LAW_OPEN_LOOP:
            return (double)belt_command_limit(model_real(loop->open_loop_flux), limit);
        case LAW_PREDICTOR:
        case LAW_FROZEN: break;
    }
    return (double)command->inlet_flux;
}

static loop_row_t observe(const loop_t *loop, size_t k, double command) {
    const plant_t *plant = &loop->plant;
    const belt_prediction_t *prediction = &loop->controller.prediction;
    loop_row_t row;
    row.time = (double)k * loop->scenario->controller.period;
    row.buffer_level = plant->level;
    row.level_setpoint = (double)loop->controller.config.level_setpoint;
    row.inlet_flux = command;
    row.congestion = plant->congestion;
    row.transport_speed = plant_speed(plant);
    row.outlet_flux = plant_outlet_flux(plant);
    row.predicted_level = (double)prediction->inlet_level;
    row.arrival_time = row.time + (double)prediction->inlet_arrival;
    row.survival = (double)prediction->inlet_survival;
    return row;
}

/** Says what is wrong with a row, if anything: neither side may leave its own limits. */
static bool row_is_sound(const loop_t *loop, const loop_row_t *row, double balance_error,
                         FILE *messages) {
    const plant_t *plant = &loop->plant;
    const double capacity = plant->setup.line->level_capacity;
    const double parts = plant->parts_at_start + plant->account.fed + plant->account.reworked;
    const char *fault = NULL;
    if (!(row->inlet_flux >= 0.0) ||
        !(row->inlet_flux <= loop->scenario->controller.inlet_flux_max)) {
        fault = "the command left its limits";
    } else if (!(row->buffer_level >= -1e-9 * capacity) || !(row->buffer_level <= capacity)) {
        fault = "the plant's level left its limits: raise plant.substeps";
    } else if (!(fabs(balance_error) <= BALANCE_SHARE * parts + 1e-12 * capacity)) {
        fault = "the plant's parts do not balance: raise plant.substeps or plant.node_count";
    }
    if (fault != NULL) {
        fprintf(messages,
                "%s: self-check at %.9g s: %s (inlet_flux %.9g, buffer_level %.9g, balance "
                "error %.3g)\n",
                loop->scenario->name, row->time, fault, row->inlet_flux, row->buffer_level,
                balance_error);
    }
    return fault == NULL;
}

static loop_status_t run_periods(loop_t *loop, const loop_sink_t *sink, FILE *messages,
                                 loop_totals_t *totals) {
    const double periods = loop->scenario->run.duration / loop->scenario->controller.period;
    const size_t last = (size_t)floor(periods + 0.5);
    for (size_t k = 0; k <= last; ++k) {
        belt_measurement_t measurement;
        belt_command_t command;
        if (!change_setpoint(loop, k, messages)) {
            return LOOP_CONFIG_REFUSED;
        }
        measure(loop, k, &measurement);
        const belt_status_t status = belt_step(&loop->controller, &measurement, &command);
        if (status != BELT_OK) {
            fprintf(
                messages, "%s: self-check at period %zu: the controller says %s (error bits %#x)\n",
                loop->scenario->name, k, belt_status_name(status), (unsigned)command.error_bits);
            return LOOP_SELF_CHECK;
        }
        const double flux = command_of(loop, &command);
        const loop_row_t row = observe(loop, k, flux);
        totals->steps = k + 1;
        totals->spilled = loop->plant.account.spilled;
        totals->balance_error = plant_balance_error(&loop->plant);
        if (!row_is_sound(loop, &row, totals->balance_error, messages)) {
            return LOOP_SELF_CHECK;
        }
        if (sink->wants_density) {
            plant_profile(&loop->plant, loop->density, DENSITY_COUNT);
        }
        if (!sink->take(sink->context, &row, loop->density, DENSITY_COUNT)) {
            return LOOP_STOPPED;
        }
        if (k < last) {
            plant_advance(&loop->plant, flux);
        }
    }
    return LOOP_DONE;
}

loop_status_t loop_run(const scenario_t *scenario, const loop_sink_t *sink, FILE *messages,
                       loop_totals_t *totals) {
    static loop_t loop; /* one run at a time: too large for the stack */
    const loop_totals_t nothing = {0.0, 0.0, 0};
    belt_config_t config;
    memset(&loop, 0, sizeof loop);
    *totals = nothing;
    loop.scenario = scenario;
    model_config(scenario, &config);
    if (belt_init(&loop.controller, &config) != BELT_OK) {
        model_print_refusals(&config, scenario->name, messages);
        return LOOP_CONFIG_REFUSED;
    }
    loop.open_loop_flux = equilibrium_of(&scenario->line, scenario->law.level_setpoint).inlet_flux;
    if (!create_plant(&loop)) {
        fprintf(messages, "not enough memory for the plant\n");
        return LOOP_NO_MEMORY;
    }
    const loop_status_t status = run_periods(&loop, sink, messages, totals);
    plant_destroy(&loop.plant);
    return status;
}
