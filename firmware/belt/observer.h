/* SPDX-License-Identifier: MIT */
/*
 * observer.h - the density along the belt, which nobody measures.
 *
 * The belt is a shift register in the material's own coordinate: cells one node spacing wide ride
 * with the material, so nothing is smeared. The inlet cell is being filled with every part that is
 * fed, the outlet cell is being emptied, and both hands of that clock move by the same share
 * `gone`. Cells change by loss and rework alone:
 *
 *     outlet                                                    inlet
 *     | gone |  rest |         |         |         |     | open |
 *            x=0     cell 1    cell 2      ...       cell N-1    x=D
 *
 * A cell holds the mean of its material, taken at the age of its centre; so every part fed is in
 * exactly one cell. Where the flux jumped within a cell, the cell also remembers the place of the
 * cut and the step there: inside the belt only the mean counts (to second order), but while the
 * cell leaves the belt the outlet sees first one side of the cut and then the other. The cut is the
 * centre of the squared jumps: at the jump if there is one, near the middle if the flux changed
 * evenly; the step is the one that has the cell's first moment.
 *
 * Cost: about 20 instructions a cell and period, some 180 for the ends. Memory: three numbers a cell.
 */
#ifndef BELT_OBSERVER_H
#define BELT_OBSERVER_H

#include "line_model.h"

#define BELT_CELL_CAPACITY (BELT_NODE_CAPACITY + 2)
/** Less than any belt moves in a period, BELT_DEAD_TIME_PERIODS being the longest dead time [node
 * spacings]. */
#define BELT_TRAVEL_MIN BELT_REAL(1e-4)

typedef struct {
    belt_real_t density[BELT_CELL_CAPACITY]; /**< ring: mean density of each cell [parts/m]. */
    belt_real_t step[BELT_CELL_CAPACITY];    /**< density inlet-side less outlet-side of the cut. */
    belt_real_t cut[BELT_CELL_CAPACITY];     /**< share of the cell on the outlet side, [0, 1). */
    uint32_t
        outlet; /**< ring index of the outlet cell. Cells 2m and 2m + 1 are a pair for the march,
                        and stay one on their way. */
    belt_real_t gone;           /**< share of the outlet cell that has left, of the open cell that
                                      has been fed, [0, 1). */
    belt_real_t outlet_density; /**< mean density that left in the last period [parts/m]. */
    belt_real_t
        modelled_density;    /**< the same, the observer's own where outlet_density is measured. */
    belt_real_t fed_density; /**< density fed in the last period [parts/m]. */
    belt_real_t moment;      /**< open cell: integral of density times place in it, the place
                                      counted from its outlet side. */
    belt_real_t jumps;       /**< open cell: sum of the squared jumps of the density fed, each times
                                     its distances to both ends of the cell. */
    belt_real_t jumps_place; /**< the same, each times its place in the cell. */
} belt_observer_t;

/** What happened to the belt in one period. */
typedef struct {
    belt_real_t duration;     /**< the period [s]. */
    belt_real_t travel;       /**< how far the belt moved [node spacings], (0, 1]. */
    belt_real_t fed_density;  /**< flux really fed over speed [parts/m], >= 0. */
    belt_real_t left_density; /**< density that left, from a measured outlet flux [parts/m]. */
    bool left_is_measured;    /**< whether left_density is to be used. */
} belt_passage_t;

/** Empties the belt. */
void belt_observer_init(belt_observer_t *observer);

/** Lays a known profile on the belt: node_count + 1 densities >= 0, equally spaced, outlet to inlet
 * [parts/m]. */
void belt_observer_assume(belt_observer_t *observer, const belt_line_t *line,
                          const belt_real_t *density);

/** Moves the belt on by one period (Mp, along its characteristics). */
void belt_observer_advance(belt_observer_t *observer, const belt_line_t *line,
                           const belt_passage_t *passage);

/** Density at a place, 0 <= place <= node_count [spacings from the outlet]; for looking at, not for
 * the step [parts/m]. */
belt_real_t belt_observer_density_at(const belt_observer_t *observer, const belt_line_t *line,
                                     belt_real_t place);

/** Mean density of what is left of the outlet cell [parts/m]. */
belt_real_t belt_observer_rest_of_outlet(const belt_observer_t *observer);

/** The ring's cell `count` further towards the inlet, count <= node_count. */
static inline uint32_t belt_observer_behind(const belt_line_t *line, uint32_t cell,
                                            uint32_t count) {
    const uint32_t index = cell + count;
    return (index < line->cell_slots) ? index : index - line->cell_slots;
}

#endif
