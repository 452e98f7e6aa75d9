/* SPDX-License-Identifier: MIT */
#include "speed_window.h"

#include <math.h>
#include <stdlib.h>

/** Level `age` steps ago, age < length. */
static double level_at(const speed_window_t *self, size_t age) {
    return self->level[(self->newest + self->length - age) % self->length];
}

static double sum_of_window(const speed_window_t *self) {
    double sum = 0.0;
    for (size_t age = 0; age <= self->whole; ++age) {
        sum += level_at(self, age);
    }
    return sum;
}

bool speed_window_create(speed_window_t *self, double window, double step, double level) {
    const double steps = window / step;
    self->whole = (size_t)floor(steps + 1e-9);
    self->part = fmax(steps - (double)self->whole, 0.0);
    self->length = self->whole + 2;
    self->newest = 0;
    self->step = step;
    self->level = malloc(self->length * sizeof *self->level);
    if (self->level == NULL) {
        return false;
    }
    for (size_t i = 0; i < self->length; ++i) {
        self->level[i] = level;
    }
    self->sum = sum_of_window(self);
    return true;
}

void speed_window_destroy(speed_window_t *self) {
    free(self->level);
    self->level = NULL;
}

void speed_window_push(speed_window_t *self, double level) {
    self->sum += level - level_at(self, self->whole);
    self->newest = (self->newest + 1) % self->length;
    self->level[self->newest] = level;
    if (self->newest == 0) {
        self->sum = sum_of_window(self);
    }
}

double speed_window_congestion(const speed_window_t *self) {
    const double last = level_at(self, self->whole);
    const double beyond = level_at(self, self->whole + 1);
    const double trapezoids = self->sum - 0.5 * (level_at(self, 0) + last);
    const double rest = self->part * (last + 0.5 * self->part * (beyond - last));
    return (trapezoids + rest) * self->step;
}

double speed_window_tail(const speed_window_t *self) {
    const double last = level_at(self, self->whole);
    return last + self->part * (level_at(self, self->whole + 1) - last);
}
