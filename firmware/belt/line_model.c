/* SPDX-License-Identifier: MIT */
#include "line_model.h"

#if BELT_LOSS_CAPACITY > 1
static bool is_uniform(const belt_config_t *config) {
    for (uint32_t i = 1; i < config->loss_count; ++i) {
        if ((config->loss_rate[i] > config->loss_rate[0]) ||
            (config->loss_rate[i] < config->loss_rate[0])) {
            return false;
        }
    }
    return true;
}

/** Integral of C from the outlet to x [m/s], exact for the linear pieces of the table. */
static belt_real_t loss_up_to(const belt_config_t *config, belt_real_t x) {
    if (config->loss_count <= 1) {
        return config->loss_rate[0] * x;
    }
    const belt_real_t width = config->belt_length / BELT_REAL(config->loss_count - 1);
    belt_real_t integral = BELT_REAL(0);
    belt_real_t rest = x;
    for (uint32_t i = 0; (i + 1 < config->loss_count) && (rest > BELT_REAL(0)); ++i) {
        const belt_real_t reach = (rest < width) ? rest : width;
        const belt_real_t left = config->loss_rate[i];
        const belt_real_t rise = (config->loss_rate[i + 1] - left) / width;
        integral += reach * (left + BELT_HALF * rise * reach);
        rest -= width;
    }
    return integral;
}
#else
static bool is_uniform(const belt_config_t *config) {
    (void)config;
    return true;
}
#endif

#if (BELT_LOSS_CAPACITY == 1) && BELT_LINE_HAS_TABLES
static belt_real_t loss_up_to(const belt_config_t *config, belt_real_t x) {
    return config->loss_rate[0] * x;
}
#endif

#if BELT_LINE_HAS_TABLES
#ifdef BELT_LINE_LAWS
static void fill_rework(belt_line_t *line, const belt_config_t *config) {
    const uint32_t nodes = config->node_count;
    for (uint32_t i = 0; i <= nodes; ++i) {
        const belt_real_t x =
            belt_within(BELT_REAL(0), line->spacing * (belt_real_t)i, config->belt_length);
        line->rework[i] = belt_law_rework(x, config->belt_length, config->rework_rate);
    }
    line->rework[nodes + 1u] = line->rework[nodes];
}
#else
static void fill_rework(belt_line_t *line, const belt_config_t *config) {
    (void)line;
    (void)config;
}
#endif

static void fill_tables(belt_line_t *line, const belt_config_t *config) {
    const uint32_t nodes = config->node_count;
    line->loss_sum[0] = BELT_REAL(0);
    for (uint32_t i = 0; i < nodes; ++i) {
        const belt_real_t inner = loss_up_to(config, line->spacing * (belt_real_t)i);
        const belt_real_t outer = loss_up_to(config, line->spacing * (belt_real_t)(i + 1u));
        line->loss[i] =
            line->loss_is_uniform ? config->loss_rate[0] : (outer - inner) / line->spacing;
        line->loss_sum[i + 1] = line->loss_sum[i] + line->loss[i];
    }
    line->loss[nodes] = line->loss[nodes - 1u];
    fill_rework(line, config);
}
#else
static void fill_tables(belt_line_t *line, const belt_config_t *config) {
    (void)line;
    (void)config;
}
#endif

void belt_line_init(belt_line_t *line, const belt_config_t *config) {
    const belt_real_t nodes = BELT_REAL(config->node_count);
    line->spacing = config->belt_length / nodes;
    line->slowness_empty = config->processing_time;
    line->slowness_slope = config->processing_time / config->congestion_scale;
    line->service_rate = BELT_REAL(1) / config->service_time;
    line->service_rate_max = config->service_rate_max;
    line->connectivity = config->connectivity;
    line->gain = config->connectivity * line->spacing;
    line->crowding = (config->prediction == BELT_HOLD_CONGESTION) ? BELT_REAL(0) : BELT_REAL(1);
    line->level_capacity = config->level_capacity;
    line->rework_at_outlet = config->rework_rate * config->belt_length;
    line->rework_per_spacing = line->rework_at_outlet / nodes;
    line->flux_bound = belt_config_flux_bound(config);
    line->density_bound = belt_config_density_bound(config);
    line->node_count = config->node_count;
    line->cell_slots = (config->node_count + 2u) & ~1u;
    line->loss_is_uniform = is_uniform(config);
    line->loss_mean = belt_config_loss_mean(config);
    fill_tables(line, config);
}
