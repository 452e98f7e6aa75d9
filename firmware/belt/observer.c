/* SPDX-License-Identifier: MIT */
#include "observer.h"

/** A cell that rounding left a hair short of full is full: which period closes it must not hang on
 * the last bit. */
#define FULL BELT_REAL(0.99999)

/** A cut stays this far from a cell's ends, where its step would be ill-conditioned. */
#define CUT_MARGIN BELT_REAL(0.0009765625)

/** Nothing is in the open cell yet. */
static void begin_cell(belt_observer_t *observer) {
    observer->moment = BELT_REAL(0);
    observer->jumps = BELT_REAL(0);
    observer->jumps_place = BELT_REAL(0);
}

/** Lays whole cells from the outlet on; one density leaves, one is fed. */
static void begin_belt(belt_observer_t *observer, belt_real_t leaving, belt_real_t fed) {
    observer->outlet = 0;
    observer->gone = BELT_REAL(0);
    observer->outlet_density = leaving;
    observer->modelled_density = leaving;
    observer->fed_density = fed;
    begin_cell(observer);
}

static void empty_cell(belt_observer_t *observer, uint32_t cell) {
    observer->density[cell] = BELT_REAL(0);
    observer->step[cell] = BELT_REAL(0);
    observer->cut[cell] = BELT_REAL(0);
}

void belt_observer_init(belt_observer_t *observer) {
    begin_belt(observer, BELT_REAL(0), BELT_REAL(0));
    for (uint32_t i = 0; i < BELT_CELL_CAPACITY; ++i) {
        empty_cell(observer, i);
    }
}

void belt_observer_assume(belt_observer_t *observer, const belt_line_t *line,
                          const belt_real_t *density) {
    begin_belt(observer, density[0], density[line->node_count]);
    empty_cell(observer, line->node_count);
    empty_cell(observer, line->cell_slots - 1u);
    for (uint32_t i = 0; i < line->node_count; ++i) {
        observer->density[i] = BELT_HALF * (density[i] + density[i + 1]);
        observer->cut[i] = BELT_HALF;
        observer->step[i] = BELT_HALF * (density[i + 1] - density[i]);
    }
}

/** Density on the outlet side of a cell's cut. */
static belt_real_t outlet_side(const belt_observer_t *observer, uint32_t cell) {
    return observer->density[cell] - observer->step[cell] * (BELT_REAL(1) - observer->cut[cell]);
}

/** Integral of a cell's density over its first `share`, in units of a cell. */
static belt_real_t first_part(const belt_observer_t *observer, uint32_t cell, belt_real_t share) {
    const belt_real_t beyond = share - observer->cut[cell];
    return outlet_side(observer, cell) * share +
           ((beyond > BELT_REAL(0)) ? observer->step[cell] * beyond : BELT_REAL(0));
}

belt_real_t belt_observer_rest_of_outlet(const belt_observer_t *observer) {
    const uint32_t cell = observer->outlet;
    const belt_real_t gone = observer->gone;
    const belt_real_t cut = observer->cut[cell];
    if (gone >= cut) {
        return observer->density[cell] + observer->step[cell] * cut;
    }
    return observer->density[cell] +
           observer->step[cell] * gone * (BELT_REAL(1) - cut) / (BELT_REAL(1) - gone);
}

/** What of the material that leaves is put back [parts/m]. */
static belt_real_t returned(const belt_observer_t *observer) {
    return belt_line_returned(observer->outlet_density);
}

/** What leaves of a cell in a share of a spacing, when its centre still has `place` spacings to go at
 * `pace`: integral of the density over the share. `amount` is that integral now. */
static belt_real_t on_leaving(const belt_observer_t *observer, const belt_line_t *line,
                              belt_real_t amount, belt_real_t share, belt_real_t place,
                              belt_real_t pace) {
    if (place <= BELT_REAL(0)) {
        return amount;
    }
    const belt_real_t rework =
        belt_line_rework(line, BELT_HALF * place) * returned(observer) * place * pace;
    return amount * belt_line_survival(belt_line_loss_sum(line, place) * pace) + rework * share;
}

/** Mean density that leaves while the belt travels (Mp1), `pace` seconds a spacing. */
static belt_real_t leaving_density(const belt_observer_t *observer, const belt_line_t *line,
                                   belt_real_t travel, belt_real_t pace) {
    const uint32_t cell = observer->outlet;
    const belt_real_t gone = observer->gone;
    const belt_real_t reach = gone + travel;
    const belt_real_t end = (reach < BELT_REAL(1)) ? reach : BELT_REAL(1);
    const belt_real_t amount = first_part(observer, cell, end) - first_part(observer, cell, gone);
    belt_real_t left = on_leaving(observer, line, amount, end - gone, BELT_HALF - gone, pace);
    if (reach > end) {
        const uint32_t next = belt_observer_behind(line, cell, 1u);
        const belt_real_t rest = reach - end;
        left += on_leaving(observer, line, first_part(observer, next, rest), rest,
                           BELT_REAL(1.5) - gone, pace);
    }
    return left / travel;
}

/** One period's ageing of whole cells, the same for all or different from cell to cell. */
typedef struct {
    const belt_line_t *line;
    belt_real_t time_here; /**< time in the spacing a cell's centre is in [s]. */
    belt_real_t time_next; /**< time in the next one towards the outlet [s]. */
    belt_real_t source;    /**< density returned, times the period [parts s/m]. */
    belt_real_t place;     /**< of the first cell's centre, halfway of the period [spacings]. */
} ageing_t;

static void age_uniform(belt_observer_t *observer, ageing_t ageing) {
    const belt_line_t *line = ageing.line;
    const belt_real_t loss = line->loss_mean * (ageing.time_here + ageing.time_next);
    const belt_real_t lost = belt_line_lost(loss);
    const belt_real_t kept = BELT_REAL(1) - lost;
    const belt_real_t source = ageing.source * (BELT_REAL(1) - BELT_HALF * loss);
    const belt_real_t rework_less = source * line->rework_per_spacing;
    belt_real_t rework = source * belt_line_rework(line, ageing.place);
    /* The ring in its two straight runs. */
    uint32_t from = observer->outlet + 1u;
    uint32_t to = observer->outlet + line->node_count;
    for (int run = 0; run < 2; ++run) {
        const uint32_t end = (to < line->cell_slots) ? to : line->cell_slots;
        for (uint32_t cell = from; cell < end; ++cell) {
            observer->density[cell] += rework - observer->density[cell] * lost;
            observer->step[cell] *= kept;
            rework -= rework_less;
        }
        from = 0;
        to = to - end;
    }
}

static void age_profile(belt_observer_t *observer, ageing_t ageing) {
    const belt_line_t *line = ageing.line;
    belt_real_t place = ageing.place;
    uint32_t cell = observer->outlet;
    for (uint32_t i = 1; i < line->node_count; ++i) {
        cell = belt_observer_behind(line, cell, 1u);
        const belt_real_t loss = ageing.time_here * belt_line_loss(line, i) +
                                 ageing.time_next * belt_line_loss(line, i - 1u);
        const belt_real_t lost = belt_line_lost(loss);
        const belt_real_t rework =
            ageing.source * belt_line_rework(line, place) * (BELT_REAL(1) - BELT_HALF * loss);
        observer->density[cell] += rework - observer->density[cell] * lost;
        observer->step[cell] *= BELT_REAL(1) - lost;
        place += BELT_REAL(1);
    }
}

/** Loss and rework of the outlet cell and the whole cells over one period. */
static void age_cells(belt_observer_t *observer, const belt_line_t *line,
                      const belt_passage_t *passage, belt_real_t pace) {
    const belt_real_t travel = passage->travel;
    const belt_real_t offset = BELT_HALF - observer->gone;
    /* Centres lie `offset` beyond a node and move on together: one part of the period in one node
     * spacing, the other in the next, the same for all of them. */
    const belt_real_t ahead = (offset > BELT_REAL(0)) ? offset : BELT_REAL(0);
    const belt_real_t here = (travel < ahead) ? travel : ahead;
    const ageing_t ageing = {
        line,
        here * pace,
        (travel - here) * pace,
        returned(observer) * passage->duration,
        BELT_REAL(1) + offset - BELT_HALF * travel,
    };
    observer->density[observer->outlet] =
        observer->density[observer->outlet] *
            belt_line_survival(belt_line_loss(line, 0u) * ageing.time_here) +
        belt_line_rework(line, BELT_REAL(0)) * returned(observer) * ageing.time_here;
    if (belt_line_is_plain(line)) {
        age_uniform(observer, ageing);
    } else {
        age_profile(observer, ageing);
    }
}

/** Fills the open cell from one share to another with material of one density. */
static void feed(belt_observer_t *observer, const belt_line_t *line, uint32_t open,
                 belt_real_t from, belt_real_t to, belt_real_t density, belt_real_t pace) {
    const belt_real_t jump = density - observer->fed_density;
    const belt_real_t weight = jump * jump * from * (BELT_REAL(1) - from);
    observer->jumps += weight;
    observer->jumps_place += weight * from;
    /* While the cell fills, its centre moves at half the speed of the belt; what is fed now is
     * taken at the age at which it will pass the place where the centre is at the end. */
    const belt_real_t loss = belt_line_loss(line, line->node_count) * pace;
    const belt_real_t source = returned(observer) * pace;
    const belt_real_t drift = BELT_HALF * (to - from);
    const belt_real_t centre = BELT_HALF * to;
    const belt_real_t centre_of_fresh = BELT_HALF * (from + to);
    const belt_real_t kept = belt_line_survival(loss * drift);
    const belt_real_t gained =
        source * drift * belt_line_rework_beyond_inlet(line, centre - BELT_HALF * drift);
    const belt_real_t fresh =
        density * belt_line_survival(loss * centre) +
        source * centre * belt_line_rework_beyond_inlet(line, BELT_HALF * centre);
    const belt_real_t present = observer->density[open] * kept + gained;
    observer->moment = observer->moment * kept + gained * BELT_HALF * from * from +
                       fresh * centre_of_fresh * (to - from);
    observer->density[open] = (present * from + fresh * (to - from)) / to;
}

/** Place of the open cell's cut: the centre of its squared jumps, the middle if there are none. */
static belt_real_t cut_of(const belt_observer_t *observer) {
    if (!(observer->jumps > BELT_REAL(0))) {
        return BELT_HALF;
    }
    return belt_within(CUT_MARGIN, observer->jumps_place / observer->jumps,
                       BELT_REAL(1) - CUT_MARGIN);
}

/** Ends the open cell at its full width; it has travelled `since` spacings more at `pace`. The slot
 * behind it becomes the open cell. */
static void close_cell(belt_observer_t *observer, const belt_line_t *line, uint32_t open,
                       belt_real_t since, belt_real_t pace) {
    const belt_real_t cut = cut_of(observer);
    const belt_real_t mean = observer->density[open];
    const belt_real_t moment = observer->moment - BELT_HALF * mean;
    const belt_real_t step = BELT_REAL(2) * moment / (cut * (BELT_REAL(1) - cut));
    observer->cut[open] = cut;
    observer->step[open] = belt_within(-mean / cut, step, mean / (BELT_REAL(1) - cut));
    const belt_real_t time = since * pace;
    const belt_real_t from_inlet = BELT_HALF + BELT_HALF * since;
    observer->density[open] =
        observer->density[open] *
            belt_line_survival(belt_line_loss(line, line->node_count) * time) +
        belt_line_rework_beyond_inlet(line, from_inlet) * returned(observer) * time;

    const uint32_t fresh = belt_observer_behind(line, open, 1u);
    observer->outlet = belt_observer_behind(line, observer->outlet, 1u);
    empty_cell(observer, fresh);
    begin_cell(observer);
}

belt_real_t belt_observer_density_at(const belt_observer_t *observer, const belt_line_t *line,
                                     belt_real_t place) {
    const belt_real_t nodes = (belt_real_t)line->node_count;
    const belt_real_t reach = observer->gone + belt_within(BELT_REAL(0), place, nodes);
    const uint32_t whole = (uint32_t)(int32_t)reach;
    if (whole >= line->node_count) {
        /* The open cell has no cut yet; nothing of it has been fed when a cell has just closed. */
        const uint32_t open = belt_observer_behind(line, observer->outlet, line->node_count);
        return (observer->gone > BELT_REAL(0)) ? observer->density[open] : observer->fed_density;
    }
    const uint32_t cell = belt_observer_behind(line, observer->outlet, whole);
    const bool is_behind_cut = (reach - (belt_real_t)whole) >= observer->cut[cell];
    return outlet_side(observer, cell) + (is_behind_cut ? observer->step[cell] : BELT_REAL(0));
}

void belt_observer_advance(belt_observer_t *observer, const belt_line_t *line,
                           const belt_passage_t *passage) {
    const belt_real_t pace = passage->duration / passage->travel;
    observer->modelled_density = belt_within(
        BELT_REAL(0), leaving_density(observer, line, passage->travel, pace), line->density_bound);
    observer->outlet_density =
        passage->left_is_measured
            ? belt_within(BELT_REAL(0), passage->left_density, line->density_bound)
            : observer->modelled_density;
    age_cells(observer, line, passage, pace);

    const uint32_t open = belt_observer_behind(line, observer->outlet, line->node_count);
    const belt_real_t reach = observer->gone + passage->travel;
    if (reach < FULL) {
        feed(observer, line, open, observer->gone, reach, passage->fed_density, pace);
        observer->gone = reach;
    } else {
        const belt_real_t rest = (reach > BELT_REAL(1)) ? reach - BELT_REAL(1) : BELT_REAL(0);
        const uint32_t fresh = belt_observer_behind(line, open, 1u);
        feed(observer, line, open, observer->gone, BELT_REAL(1), passage->fed_density, pace);
        close_cell(observer, line, open, rest, pace);
        if (rest > BELT_REAL(0)) {
            feed(observer, line, fresh, BELT_REAL(0), rest, passage->fed_density, pace);
        }
        observer->gone = rest;
    }
    observer->fed_density = passage->fed_density;
}
