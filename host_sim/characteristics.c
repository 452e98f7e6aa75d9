/* SPDX-License-Identifier: MIT */
/*
 * characteristics.c - the belt as the material sees it.
 *
 * Material is followed in parcels. A parcel's two edges carry their own densities, linear between
 * them, so that a jump of the flux is a jump between two parcels and stays one for ever. Edges are
 * known by `travel`, the distance the belt had moved when they were fed; the place of an edge is
 * D - (belt's travel - its own). A new parcel begins with each control period, where the flux may
 * jump, and where one has grown to belt_length/node_count. Second order in the plant step.
 */
#include <math.h>
#include <stdlib.h>

#include "plant.h"

typedef struct {
    double travel; /**< belt's travel when the parcel's older edge was fed [m]. */
    double older;  /**< density at the older edge, towards the outlet [parts/m]. */
    double newer;  /**< density at the newer edge [parts/m]. */
} parcel_t;

typedef struct {
    double travel;      /**< how far the belt has moved [m]. */
    double parcel_size; /**< greatest length of a parcel [m]. */
    size_t first;       /**< ring index of the parcel that is leaving. */
    size_t count;       /**< parcels on the belt. */
    size_t capacity;
    parcel_t parcel[];
} characteristics_t;

static parcel_t *parcel_at(characteristics_t *self, size_t index) {
    return &self->parcel[(self->first + index) % self->capacity];
}

static const parcel_t *seen_at(const characteristics_t *self, size_t index) {
    return &self->parcel[(self->first + index) % self->capacity];
}

/** Places closer than this share of the belt are the same: the same line in other units must not
 * round to another side of an edge. */
#define SAME_PLACE 1e-9

/** Travel of a parcel's newer edge: the next one's older edge, or what is being fed now. */
static double newer_travel(const characteristics_t *self, size_t index) {
    return (index + 1 < self->count) ? seen_at(self, index + 1)->travel : self->travel;
}

static double density_in(const parcel_t *parcel, double end, double travel) {
    const double length = end - parcel->travel;
    return (length > 0.0) ? parcel->older +
                                (parcel->newer - parcel->older) * (travel - parcel->travel) / length
                          : parcel->newer;
}

static void begin_parcel(characteristics_t *self, double density) {
    const parcel_t fresh = {self->travel, density, density};
    *parcel_at(self, self->count) = fresh;
    self->count += 1;
}

static bool create(void **belt, const plant_t *plant) {
    const line_t *line = plant->setup.line;
    const size_t nodes = plant->setup.node_count;
    const double slowest = 1.0 / line_speed(line, line->speed_window * line->level_capacity);
    const double periods = line->belt_length * slowest / plant->setup.period;
    const size_t capacity = 2 * nodes + (size_t)periods + 2 * plant->setup.substeps + 16;
    characteristics_t *self = malloc(sizeof *self + capacity * sizeof self->parcel[0]);
    if (self == NULL) {
        return false;
    }
    self->parcel_size = line->belt_length / (double)nodes;
    self->first = 0;
    self->count = 0;
    self->capacity = capacity;
    for (size_t i = 0; i < nodes; ++i) {
        const double x = (double)i * self->parcel_size;
        self->travel = x - line->belt_length;
        begin_parcel(self, profile_at(plant->setup.density, x, line->belt_length));
        parcel_at(self, i)->newer =
            profile_at(plant->setup.density, x + self->parcel_size, line->belt_length);
    }
    self->travel = 0.0;
    *belt = self;
    return true;
}

static void destroy(void *belt) {
    free(belt);
}

/** Integral of the density over the stretch that leaves next, `reach` long [parts]. */
static double next_to_leave(const characteristics_t *self, double outlet, double reach) {
    double sum = 0.0;
    double from = outlet;
    for (size_t i = 0; (i < self->count) && (from < outlet + reach); ++i) {
        const parcel_t *parcel = seen_at(self, i);
        const double end = newer_travel(self, i);
        const double to = fmin(end, outlet + reach);
        if (to > from) {
            sum += (to - from) * density_in(parcel, end, 0.5 * (from + to));
            from = to;
        }
    }
    return sum;
}

/** Loss and rework of one edge over one step, the loss by the trapezoid rule in time. */
static double aged(double density, double loss, double gain) {
    return ((1.0 - 0.5 * loss) * density + gain) / (1.0 + 0.5 * loss);
}

/** Ages every edge; returns what was lost on the belt as it lies in the middle of the step, what is
 * fed in this step included [parts]. `left` is the mean density leaving. */
static double age_parcels(characteristics_t *self, const plant_t *plant, double reach,
                          double left) {
    const line_t *line = plant->setup.line;
    const double outlet = self->travel - line->belt_length;
    const double ahead = 0.5 * reach;
    const double dt = plant->step;
    double lost = 0.0;
    double place = fmax(seen_at(self, 0)->travel - outlet - ahead, 0.0);
    double loss = dt * profile_at(&line->loss_rate, place, line->belt_length);
    for (size_t i = 0; i < self->count; ++i) {
        parcel_t *parcel = parcel_at(self, i);
        const double older = parcel->older;
        parcel->older = aged(older, loss, dt * line_rework(line, place, left));
        const double lost_older = loss * 0.5 * (older + parcel->older);
        const double end = fmax(newer_travel(self, i) - outlet - ahead, 0.0);
        loss = dt * profile_at(&line->loss_rate, end, line->belt_length);
        const double newer = parcel->newer;
        parcel->newer = aged(newer, loss, dt * line_rework(line, end, left));
        lost += 0.5 * (end - place) * (lost_older + loss * 0.5 * (newer + parcel->newer));
        place = end;
    }
    return lost + ahead * loss * parcel_at(self, self->count - 1)->newer;
}

static void drop_what_left(characteristics_t *self, double outlet) {
    const double same = SAME_PLACE * (self->travel - outlet);
    while ((self->count > 1) && (newer_travel(self, 0) <= outlet + same)) {
        self->first = (self->first + 1) % self->capacity;
        self->count -= 1;
    }
}

static void advance(void *belt, plant_t *plant, double flux, bool fresh) {
    characteristics_t *self = belt;
    const line_t *line = plant->setup.line;
    const double dt = plant->step;
    const double grown = self->travel - seen_at(self, self->count - 1)->travel;
    if (fresh || (grown >= self->parcel_size * (1.0 - SAME_PLACE))) {
        begin_parcel(self, flux / line_speed(line, plant->congestion));
    }
    const double rising = plant->level - speed_window_tail(&plant->window);
    const double reach = dt * line_speed(line, plant->congestion + 0.5 * dt * rising);

    const double outlet = self->travel - line->belt_length;
    const double before = next_to_leave(self, outlet, reach) / reach;
    const double loss = profile_at(&line->loss_rate, 0.0, line->belt_length);
    const double left = before + 0.5 * dt * (line_rework(line, 0.0, before) - loss * before);

    plant->account.lost += age_parcels(self, plant, reach, left);
    plant->account.reworked += dt * line_rework_of_belt(line, left);
    self->travel += reach;
    const double inflow = line->connectivity * left * reach + dt * plant->disturbance;
    const double middle = plant->level + 0.5 * (inflow - dt * plant_service(plant, plant->level));
    plant_serve(plant, left * reach, fmax(middle, 0.0));
    parcel_at(self, self->count - 1)->newer = flux / line_speed(line, plant->congestion);
    drop_what_left(self, self->travel - line->belt_length);
}

static double outlet_density(const void *belt, const plant_t *plant) {
    const characteristics_t *self = belt;
    return density_in(seen_at(self, 0), newer_travel(self, 0),
                      self->travel - plant->setup.line->belt_length);
}

static void profile(const void *belt, const plant_t *plant, double *density, size_t count) {
    const characteristics_t *self = belt;
    const double outlet = self->travel - plant->setup.line->belt_length;
    size_t index = 0;
    for (size_t i = 0; i < count; ++i) {
        const double place = (double)i / (double)(count - 1) * plant->setup.line->belt_length;
        const double travel = fmin(outlet + place, self->travel);
        while ((index + 1 < self->count) && (newer_travel(self, index) <= travel)) {
            ++index;
        }
        density[i] = density_in(seen_at(self, index), newer_travel(self, index), travel);
    }
}

static double content(const void *belt, const plant_t *plant) {
    const characteristics_t *self = belt;
    const double length = plant->setup.line->belt_length;
    return next_to_leave(self, self->travel - length, length);
}

const scheme_t scheme_characteristics = {create,         destroy, advance,
                                         outlet_density, profile, content};
