/* SPDX-License-Identifier: MIT */
#include "plant.h"

#include <math.h>

double line_speed(const line_t *line, double congestion) {
    return 1.0 / (line->processing_time * (1.0 + congestion / line->congestion_scale));
}

double line_service(const line_t *line, double level) {
    return fmin(level / line->service_time, line->service_rate_max);
}

bool plant_create(plant_t *plant, const plant_setup_t *setup) {
    const plant_account_t nothing = {0};
    plant->setup = *setup;
    plant->step = setup->period / (double)setup->substeps;
    plant->level = setup->buffer_level;
    plant->applied_flux = 0.0;
    plant->parts_at_start = setup->buffer_level;
    plant->account = nothing;
    if (!speed_window_create(&plant->window, setup->line->speed_window, plant->step,
                             setup->buffer_level)) {
        return false;
    }
    plant->congestion = speed_window_congestion(&plant->window);
    return true;
}

void plant_destroy(plant_t *plant) {
    speed_window_destroy(&plant->window);
}

void plant_serve(plant_t *plant, double left, double middle) {
    const line_t *line = plant->setup.line;
    const double served = plant->step * line_service(line, middle);
    const double level = plant->level + line->connectivity * left - served;
    plant->account.diverted += (1.0 - line->connectivity) * left;
    plant->account.served += served;
    plant->account.spilled += fmax(level - line->level_capacity, 0.0);
    plant->level = fmin(level, line->level_capacity);
    speed_window_push(&plant->window, plant->level);
    plant->congestion = speed_window_congestion(&plant->window);
}

void plant_advance(plant_t *plant, const scheme_t *scheme, void *belt, double command) {
    plant->applied_flux = fmin(command, plant->setup.inlet_flux_max);
    for (size_t i = 0; i < plant->setup.substeps; ++i) {
        scheme->advance(belt, plant, plant->applied_flux, i == 0);
        plant->account.fed += plant->applied_flux * plant->step;
    }
}

double plant_balance_error(const plant_t *plant, const scheme_t *scheme, const void *belt) {
    const plant_account_t *account = &plant->account;
    const double in = plant->parts_at_start + account->fed + account->reworked;
    const double out = account->served + account->spilled + account->diverted + account->lost;
    return in - out - plant->level - scheme->content(belt, plant);
}
