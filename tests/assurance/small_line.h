/* SPDX-License-Identifier: MIT */
/*
 * small_line.h - a conveyor and its buffer in a few lines, for programs that make 1e8 steps.
 *
 * Everything fed in a period is a parcel: it leaves once the belt has moved a belt length further,
 * less what is lost by then (uniform loss, no rework). The speed is that of the congestion in the
 * middle of a period. Level and travel are counted in whole 2^-40, so nothing ever drifts by
 * rounding: what drifts in a loop with this line is the controller.
 */
#ifndef TESTS_ASSURANCE_SMALL_LINE_H
#define TESTS_ASSURANCE_SMALL_LINE_H

#include "belt/belt.h"

#include <math.h>
#include <string.h>

#define SMALL_LINE_PARCELS 1024u /**< more periods than the longest dead time. */
#define SMALL_LINE_LEVELS 1024u  /**< more periods than the window. */

typedef struct {
    double length, processing_time, connectivity, service_rate_max, capacity, loss_rate, period;
    uint32_t window;                            /**< [periods]. */
    int64_t level;                              /**< [2^-40 parts]. */
    int64_t level_sum;                          /**< of the last `window` levels. */
    int64_t levels[SMALL_LINE_LEVELS];          /**< ring. */
    uint64_t travel;                            /**< how far the belt has come [2^-40 m]. */
    uint64_t travel_before[SMALL_LINE_PARCELS]; /**< ring: that, where each parcel begins. */
    double parts[SMALL_LINE_PARCELS];           /**< ring: what was fed [parts]. */
    uint64_t now;                               /**< period. */
    uint64_t leaving;                           /**< the parcel that leaves. */
    double outlet_flux;                         /**< in the last period [parts/s]. */
} small_line_t;

static inline double small_line_unit(void) {
    return 1099511627776.0; /* 2^40 */
}

static inline double small_line_level(const small_line_t *line) {
    return (double)line->level / small_line_unit();
}

/** An empty belt and a level that has always been there. */
static inline void small_line_begin(small_line_t *line, const belt_config_t *config, double level) {
    memset(line, 0, sizeof *line);
    line->length = (double)config->belt_length;
    line->processing_time = (double)config->processing_time / (double)config->congestion_scale;
    line->connectivity = (double)config->connectivity;
    line->service_rate_max = (double)config->service_rate_max;
    line->capacity = (double)config->level_capacity;
    line->loss_rate = (double)config->loss_rate[0];
    line->period = (double)config->period;
    line->window = (uint32_t)lround((double)config->speed_window / line->period);
    line->level = (int64_t)(level * small_line_unit());
    for (uint32_t i = 0; i < SMALL_LINE_LEVELS; ++i) {
        line->levels[i] = line->level;
    }
    line->level_sum = line->level * line->window;
}

/** How far the belt moves in this period [2^-40 m]. */
static inline uint64_t small_line_way(const small_line_t *line) {
    /* Trapezoids, and half a period on. */
    const double congestion = (double)line->level_sum / small_line_unit() * line->period;
    return (uint64_t)(line->period / (line->processing_time * (1.0 + congestion)) *
                      small_line_unit());
}

/** Parts that leave while the belt comes as far as `reach`. */
static inline double small_line_left(small_line_t *line, uint64_t reach) {
    const uint64_t length = (uint64_t)(line->length * small_line_unit());
    double left = 0.0;
    while (line->leaving <= line->now) {
        const size_t parcel = line->leaving % SMALL_LINE_PARCELS;
        const size_t next = (line->leaving + 1u) % SMALL_LINE_PARCELS;
        const uint64_t begin = line->travel_before[parcel] + length;
        const uint64_t end = line->travel_before[next] + length;
        const uint64_t from = (begin > line->travel) ? begin : line->travel;
        const uint64_t to = (end < reach) ? end : reach;
        if (to > from) {
            const double age = (double)(line->now - line->leaving) * line->period;
            left += line->parts[parcel] * (double)(to - from) / (double)(end - begin) *
                    exp(-line->loss_rate * age);
        }
        if (end > reach) {
            break;
        }
        ++line->leaving;
    }
    return left;
}

/** One period with a flux [parts/s]. */
static inline void small_line_advance(small_line_t *line, double flux) {
    const uint64_t reach = line->travel + small_line_way(line);
    line->travel_before[line->now % SMALL_LINE_PARCELS] = line->travel;
    line->parts[line->now % SMALL_LINE_PARCELS] = flux * line->period;
    line->travel_before[(line->now + 1u) % SMALL_LINE_PARCELS] = reach;
    const double left = small_line_left(line, reach);
    line->travel = reach;
    line->outlet_flux = left / line->period;

    const double before = small_line_level(line);
    const double service = fmin(before, line->service_rate_max) * line->period;
    const double level = before + line->connectivity * left - service * (1.0 - 0.5 * line->period);
    line->level = (int64_t)(fmin(fmax(level, 0.0), line->capacity) * small_line_unit());
    ++line->now;
    const size_t oldest = (line->now + SMALL_LINE_LEVELS - line->window) % SMALL_LINE_LEVELS;
    line->levels[line->now % SMALL_LINE_LEVELS] = line->level;
    line->level_sum += line->level - line->levels[oldest];
}

#endif
