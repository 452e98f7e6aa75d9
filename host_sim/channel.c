/* SPDX-License-Identifier: MIT */
#include "channel.h"

#include <stdlib.h>
#include <string.h>

#include "schedule.h"

/** Copies bits, so that garbage stays what it is. */
static void copy(signal_t *to, const signal_t *from, size_t width) {
    memcpy(to->value, from->value, width * sizeof *to->value);
    to->is_present = from->is_present;
    to->is_garbage = from->is_garbage;
    to->sample_count = from->sample_count;
}

static bool create_station(station_t *self, const channel_setup_t *setup, size_t number,
                           size_t width) {
    const fault_t *const fault = &setup->faults[number];
    self->fault = fault;
    chance_begin(&self->chance, setup->seed,
                 (uint32_t)number + 1u); /* stream 0: the sensor's noise */
    self->kept_count =
        (fault->word == FAULT_DELAYED) ? schedule_periods(fault->value, setup->period) + 1 : 1;
    self->kept = calloc(self->kept_count, sizeof *self->kept);
    self->numbers = calloc(self->kept_count * width, sizeof *self->numbers);
    if ((self->kept == NULL) || (self->numbers == NULL)) {
        return false;
    }
    for (size_t i = 0; i < self->kept_count; ++i) {
        self->kept[i].value = self->numbers + i * width;
    }
    return true;
}

bool channel_create(channel_t *self, const channel_setup_t *setup, size_t width) {
    memset(self, 0, sizeof *self);
    self->width = width;
    self->period = setup->period;
    bool is_created = true;
    for (size_t i = 0; (i < setup->count) && is_created; ++i) {
        if (setup->faults[i].signal == setup->signal) {
            is_created = create_station(&self->station[self->station_count], setup, i, width);
            self->station_count += 1;
        }
    }
    return is_created;
}

void channel_destroy(channel_t *self) {
    for (size_t i = 0; i < self->station_count; ++i) {
        free(self->station[i].kept);
        free(self->station[i].numbers);
    }
    self->station_count = 0;
}

static void spoil(station_t *self, signal_t *signal, size_t width) {
    for (size_t i = 0; i < width; ++i) {
        const uint64_t bits = chance_bits(&self->chance);
        memcpy(&signal->value[i], &bits, sizeof bits);
    }
    signal->is_garbage = true;
}

static bool is_number(const signal_t *signal) {
    return signal->is_present && !signal->is_garbage;
}

static void hold(const station_t *self, signal_t *signal, size_t width) {
    if (self->has_kept) {
        copy(signal, &self->kept[0], width);
    }
}

static void scale(const station_t *self, signal_t *signal, size_t width) {
    for (size_t i = 0; (i < width) && is_number(signal); ++i) {
        signal->value[i] *= self->fault->value;
    }
}

/** An implicit Euler step of the lag: stable for any time constant, and no exponential in it. */
static void lag(const station_t *self, signal_t *signal, size_t width, double period) {
    const double share = period / (self->fault->value + period);
    for (size_t i = 0; (i < width) && self->has_kept && is_number(signal); ++i) {
        const double before = self->kept[0].value[i];
        signal->value[i] = before + share * (signal->value[i] - before);
    }
}

static void lose(station_t *self, signal_t *signal) {
    const bool is_lost = chance_share(&self->chance) < self->fault->value;
    signal->is_present = signal->is_present && !is_lost;
}

/** The newest signal stays in the ring; one that has been under way long enough goes on, but none
 * older than what went on before. */
static void delay(station_t *self, signal_t *signal, size_t width, bool is_active) {
    const size_t newest = self->taken;
    const size_t under_way = self->kept_count - 1;
    copy(&self->kept[newest % self->kept_count], signal, width);
    const size_t due = (newest > under_way) ? newest - under_way : 0;
    if (!is_active) {
        self->delivered = newest;
    } else if (due > self->delivered) {
        self->delivered = due;
    }
    copy(signal, &self->kept[self->delivered % self->kept_count], width);
}

static void pass_active(station_t *self, signal_t *signal, size_t width, double period) {
    switch (self->fault->word) {
        case FAULT_OFF: signal->is_present = false; break;
        case FAULT_STUCK: hold(self, signal, width); break;
        case FAULT_GARBAGE: spoil(self, signal, width); break;
        case FAULT_WRONG: scale(self, signal, width); break;
        case FAULT_SLOW: lag(self, signal, width, period); break;
        case FAULT_DELAYED: delay(self, signal, width, true); break;
        case FAULT_INTERMITTENT: lose(self, signal); break;
    }
}

static void remember(station_t *self, const signal_t *signal, size_t width) {
    const fault_word_t word = self->fault->word;
    if ((word == FAULT_STUCK) || ((word == FAULT_SLOW) && is_number(signal))) {
        copy(&self->kept[0], signal, width);
        self->has_kept = true;
    }
    self->taken += 1;
}

void channel_pass(channel_t *self, size_t index, signal_t *signal) {
    for (size_t i = 0; i < self->station_count; ++i) {
        station_t *const station = &self->station[i];
        if (fault_is_active(station->fault, index, self->period)) {
            pass_active(station, signal, self->width, self->period);
        } else if (station->fault->word == FAULT_DELAYED) {
            delay(station, signal, self->width, false);
        }
        remember(station, signal, self->width);
    }
}

void channel_settle(channel_t *self, const signal_t *signal) {
    for (size_t i = 0; i < self->station_count; ++i) {
        station_t *const station = &self->station[i];
        for (size_t place = 0; place < station->kept_count; ++place) {
            copy(&station->kept[place], signal, self->width);
        }
        station->has_kept = true;
        station->taken = (station->taken > 0) ? station->taken : 1;
        station->delivered = station->taken - 1;
    }
}
