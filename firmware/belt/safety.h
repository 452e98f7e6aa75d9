/* SPDX-License-Identifier: MIT */
/*
 * safety.h - will the law ever ask for less than nothing? Proposition 2, and a sharper bound.
 *
 * By (MF1) the inlet flux is positive as long as what the law wants to arrive, u(Q*, p1(D)), exceeds
 * what the rework of the material ahead will bring, speed times I(D). From the first arrival on the
 * level goes monotonically from p1(D) to Q*, so the law never wants less than u, the lesser of
 * u(Q*, p1(D)) and u(Q*, Q*); and with M, the most that p2 can be, the rework is bounded too:
 *
 *     M/u < 2/(A D^2 s)                         [s/m], s = 1 + tau Qmax/congestion_scale      (Abound)
 *     M = max(density, P s^2 Bmax) exp(2 A D^2 P s), u also at the present level               (Mchar)
 *
 * The paper prints the right side in m^2/s; this is what its own proof gives. The sharper bound takes
 * the belt as it is and moves it on. Of every piece of it p2 is known now; what is fed later arrives
 * with at most P s_high max(u); what is lost on the way does not arrive:
 *
 *     falling * max over xi of the integral of A y E(D - y) p2(y + xi) over [0, D]  <  u     [parts/s]
 *     E(r) = exp(-P s_low * integral of C over [0, r]),  falling = 1 + tau fall/congestion_scale/s_low
 *
 * s_low and s_high: 1 + tau Q/congestion_scale at the lowest and the highest level in the window, on the
 * belt (p1) and at Q*; fall: by how much a later one of them lies below an earlier one. The integral is a
 * sum over the stretches of the march; 4/node_count^2 of it are added for what such a sum may miss.
 *
 * Both are sufficient, neither is necessary: docs/ROBUSTNESS.md has the map. They speak of the paper's
 * predictor, of a line that is its model with the disturbance as estimated now, and of a valve that
 * feeds what it is told. Where a bound does not hold nothing is said against the line; the command
 * stays at 0 or above in any case.
 *
 * Not part of the step: for start-up, an operator or a slow task, between two steps. Cost: a march and
 * node_count^2/4 exponentials, some 20,000 x86-64 instructions with 20 nodes and a window of 80 periods
 * (25,000 with a loss profile); 450 bytes of stack with the capacities of types.h.
 */
#ifndef BELT_SAFETY_H
#define BELT_SAFETY_H

#include "belt.h"

/** A sufficient condition: left < right. Every number is finite; what has no bound is
 * BELT_REAL_MAX. */
typedef struct {
    belt_real_t flux_min;    /**< u: least outlet flux that the law will want [parts/s]. */
    belt_real_t density_max; /**< M: most that p2 can be [parts/m]. */
    belt_real_t left;
    belt_real_t right;
    belt_real_t margin; /**< right/left, above 1 where the inequality holds; BELT_REAL_MAX without
                             rework. */
    bool
        applies; /**< what both presuppose: BELT_PREDICT_CONGESTION, 0 <= Q < Qmax now and all along
                       the prediction, no negative density, no loss rate below 0; and the paper's laws. */
    bool holds;  /**< applies, and left < right: U > 0 for all times to come. */
} belt_promise_t;

typedef struct {
    belt_promise_t proposition; /**< (Abound): left is M/u; both sides in s/m. */
    belt_promise_t sharper;     /**< left is the rework to come, right is u, both in parts/s. */
    belt_real_t
        jump; /**< rho(D) less what (nu0) asks for: height of the front that the next command
                           lets in, 0 where there is none [parts/m]. */
} belt_safety_t;

/**
 * Judges the present state of a controller under its present set-point. Writes all of `safety`, and
 * nothing of the controller. Returns
 *   BELT_OK        it is judged;
 *   BELT_NO_LEVEL  the controller is not running (no level yet, or its memory has changed): nothing
 *                  is promised, every number is 0;
 *   BELT_MISUSE    a null pointer. BELT_ASSERT first.
 */
belt_status_t belt_safety_assess(const belt_controller_t *controller, belt_safety_t *safety);

#endif
