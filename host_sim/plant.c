/* SPDX-License-Identifier: MIT */
#include "plant.h"

#include <math.h>

double plant_service(const plant_t *plant, double level) {
    return line_service(plant->setup.line, level, plant->service_rate_max);
}

bool plant_create(plant_t *plant, const plant_setup_t *setup, const scheme_t *scheme) {
    const plant_account_t nothing = {0};
    plant->setup = *setup;
    plant->scheme = scheme;
    plant->step = setup->period / (double)setup->substeps;
    plant->level = setup->buffer_level;
    plant->applied_flux = 0.0;
    plant->disturbance = 0.0;
    plant->service_rate_max = setup->line->service_rate_max;
    plant->account = nothing;
    if (!speed_window_create(&plant->window, setup->line->speed_window, plant->step,
                             setup->buffer_level)) {
        return false;
    }
    if (!scheme->create(&plant->belt, plant)) {
        speed_window_destroy(&plant->window);
        return false;
    }
    plant->congestion = speed_window_congestion(&plant->window);
    plant->parts_at_start = setup->buffer_level + scheme->content(plant->belt, plant);
    return true;
}

void plant_destroy(plant_t *plant) {
    plant->scheme->destroy(plant->belt);
    speed_window_destroy(&plant->window);
}

void plant_serve(plant_t *plant, double left, double middle) {
    const line_t *line = plant->setup.line;
    const double served = plant->step * plant_service(plant, middle);
    const double undisturbed = plant->level + line->connectivity * left - served;
    const double disturbed = fmax(plant->step * plant->disturbance, -fmax(undisturbed, 0.0));
    const double level = undisturbed + disturbed;
    plant->account.diverted += (1.0 - line->connectivity) * left;
    plant->account.served += served;
    plant->account.disturbed += disturbed;
    plant->account.spilled += fmax(level - line->level_capacity, 0.0);
    plant->level = fmin(level, line->level_capacity);
    speed_window_push(&plant->window, plant->level);
    plant->congestion = speed_window_congestion(&plant->window);
}

void plant_advance(plant_t *plant, double command) {
    plant->applied_flux = fmin(command, plant->setup.inlet_flux_max);
    for (size_t i = 0; i < plant->setup.substeps; ++i) {
        plant->scheme->advance(plant->belt, plant, plant->applied_flux, i == 0);
        plant->account.fed += plant->applied_flux * plant->step;
    }
}

void plant_disturb(plant_t *plant, double flow) {
    plant->disturbance = flow;
}

void plant_change_service(plant_t *plant, double rate) {
    plant->service_rate_max = rate;
}

double plant_speed(const plant_t *plant) {
    return line_speed(plant->setup.line, plant->congestion);
}

double plant_outlet_flux(const plant_t *plant) {
    return plant_speed(plant) * plant->scheme->outlet_density(plant->belt, plant);
}

void plant_profile(const plant_t *plant, double *density, size_t count) {
    plant->scheme->profile(plant->belt, plant, density, count);
    for (size_t i = 0; i < count; ++i) {
        density[i] = fmax(density[i], 0.0); /* an emptied belt, but for rounding */
    }
}

double plant_balance_error(const plant_t *plant) {
    const plant_account_t *account = &plant->account;
    const double in = plant->parts_at_start + account->fed + account->reworked + account->disturbed;
    const double out = account->served + account->spilled + account->diverted + account->lost;
    return in - out - plant->level - plant->scheme->content(plant->belt, plant);
}
