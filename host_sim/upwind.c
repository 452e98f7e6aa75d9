/* SPDX-License-Identifier: MIT */
/*
 * upwind.c - the paper's own scheme (Section 5): first-order upwind differences on a fixed grid,
 * forward Euler in time. It smears every jump; it is here to show what the paper computed.
 */
#include <stdlib.h>

#include "plant.h"

typedef struct {
    size_t cells;
    double dx;
    double *loss; /**< C at the nodes [1/s]. */
    double
        density[]; /**< at the nodes, outlet first [parts/m]: cells + 1, and the losses behind. */
} upwind_t;

static bool create(void **belt, const plant_t *plant) {
    const line_t *line = plant->setup.line;
    const size_t nodes = plant->setup.node_count + 1;
    upwind_t *self = malloc(sizeof *self + 2 * nodes * sizeof self->density[0]);
    if (self == NULL) {
        return false;
    }
    self->cells = plant->setup.node_count;
    self->dx = line->belt_length / (double)self->cells;
    self->loss = self->density + nodes;
    for (size_t i = 0; i < nodes; ++i) {
        const double x = (double)i * self->dx;
        self->loss[i] = profile_at(&line->loss_rate, x, line->belt_length);
        self->density[i] = profile_at(plant->setup.density, x, line->belt_length);
    }
    *belt = self;
    return true;
}

static void destroy(void *belt) {
    free(belt);
}

static double outlet_density(const void *belt, const plant_t *plant) {
    (void)plant;
    const upwind_t *self = belt;
    return self->density[0];
}

static void advance(void *belt, plant_t *plant, double flux, bool fresh) {
    (void)fresh;
    upwind_t *self = belt;
    const line_t *line = plant->setup.line;
    const double dt = plant->step;
    const double speed = line_speed(line, plant->congestion);
    const double left = self->density[0];
    self->density[self->cells] = flux / speed;
    for (size_t i = 0; i < self->cells; ++i) {
        const double x = (double)i * self->dx;
        const double moved = speed * (self->density[i + 1] - self->density[i]) / self->dx;
        const double reworked = line_rework(line, x, left);
        const double lost = self->loss[i] * self->density[i];
        plant->account.reworked += dt * self->dx * reworked;
        plant->account.lost += dt * self->dx * lost;
        self->density[i] += dt * (moved + reworked - lost);
    }
    plant_serve(plant, dt * speed * left, plant->level);
}

static void profile(const void *belt, const plant_t *plant, double *density, size_t count) {
    (void)plant;
    const upwind_t *self = belt;
    for (size_t i = 0; i < count; ++i) {
        const double place = (double)i * (double)self->cells / (double)(count - 1);
        const size_t node = (place < (double)self->cells) ? (size_t)place : self->cells - 1;
        const double share = place - (double)node;
        density[i] = self->density[node] + share * (self->density[node + 1] - self->density[node]);
    }
}

/** The inlet node belongs to the boundary: each other node stands for one cell. */
static double content(const void *belt, const plant_t *plant) {
    (void)plant;
    const upwind_t *self = belt;
    double sum = 0.0;
    for (size_t i = 0; i < self->cells; ++i) {
        sum += self->density[i];
    }
    return sum * self->dx;
}

const scheme_t scheme_upwind = {create, destroy, advance, outlet_density, profile, content};
