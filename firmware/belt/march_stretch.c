/* SPDX-License-Identifier: MIT */
#include "march_stretch.h"

#include "fast_forward.h"
#include "march_step.h"

/** The second cell's share of a stretch. */
static inline belt_real_t second_share(const belt_stretch_t *stretch) {
    return (stretch->width[1] > BELT_REAL(0))
               ? stretch->width[1] / (stretch->width[0] + stretch->width[1])
               : BELT_REAL(0);
}

/** Two cells leave one after the other; `share` is the second one's of the stretch. Their density is taken
 * to lie on a straight line: its moment is a third more than that of a jump between equal cells. */
static inline belt_leaving_t one_after_the_other(belt_real_t first, belt_real_t second,
                                                 belt_real_t share) {
    const belt_leaving_t leaving = {first + share * (second - first), BELT_REAL(2.0 / 3.0) * share *
                                                                          (BELT_REAL(1) - share) *
                                                                          (first - second)};
    return leaving;
}

/** Plain line: survival and rework are carried along. */
static inline belt_leaving_t leave_plain(belt_carried_t *carried, const belt_line_t *line,
                                         const belt_stretch_t *stretch, belt_real_t pace) {
    belt_real_t left[2];
    for (int i = 0; i < 2; ++i) {
        const belt_cell_factors_t factors = belt_carried_factors(line, stretch->width[i], pace);
        left[i] = belt_carried_density(carried, &factors, stretch->density[i]);
    }
    return one_after_the_other(left[0], left[1], second_share(stretch));
}

/* What is put back while each stretch leaves, its mean over the stretch: of two cells that of each, since
 * the law may bend. */
#ifdef BELT_LINE_LAWS
static inline const belt_real_t *returned_by(const belt_prediction_t *prediction) {
    return prediction->returned;
}

static inline void put_back(belt_prediction_t *prediction, belt_real_t first, belt_real_t second,
                            belt_real_t share) {
    const belt_real_t of_first = belt_line_returned(first);
    prediction->returned[prediction->inlet.count] =
        of_first + share * (belt_line_returned(second) - of_first);
}
#else
static inline const belt_real_t *returned_by(const belt_prediction_t *prediction) {
    return prediction->outlet_density;
}

static inline void put_back(const belt_prediction_t *prediction, belt_real_t first,
                            belt_real_t second, belt_real_t share) {
    (void)prediction;
    (void)first;
    (void)second;
    (void)share;
}
#endif

/** What happens to material now at `place` while the first `count` stretches pass. */
static belt_transfer_t while_they_pass(const belt_prediction_t *p, const belt_line_t *line,
                                       uint32_t count, belt_real_t place) {
    const belt_passed_t passed = {p->width, p->pace, returned_by(p), count};
    return belt_fast_forward(line, &passed, place);
}

static void keep(belt_carried_t *carried, const belt_transfer_t *transfer) {
    carried->survival = transfer->survival;
    carried->rework = transfer->rework / transfer->survival;
}

/** What is put back while a stretch's middle is on its last way: of its outlet end, with the loss and the
 * rework of that very way, which is found by going it once already. */
static inline belt_real_t returned_on_the_last_way(const belt_line_t *line,
                                                   const belt_transfer_t *before, belt_real_t way,
                                                   belt_real_t pace, belt_real_t density) {
    belt_transfer_t gone = *before;
    belt_fast_forward_last(&gone, line, way, pace,
                           belt_line_returned(before->survival * density + before->rework));
    return belt_line_returned(gone.survival * density + gone.rework);
}

/** Any line: the stretch's middle is moved past all before it; its two cells are told apart by the loss
 * between them. */
static belt_leaving_t leave_any(belt_prediction_t *prediction, const belt_line_t *line,
                                const belt_stretch_t *stretch, belt_real_t pace) {
    belt_front_t *front = &prediction->inlet;
    const belt_real_t half = BELT_HALF * (stretch->width[0] + stretch->width[1]);
    const belt_real_t middle = prediction->place + half;
    prediction->place = middle + half;
    const belt_real_t share = second_share(stretch);
    belt_transfer_t transfer = while_they_pass(prediction, line, front->count, middle);
    const belt_real_t returned =
        returned_on_the_last_way(line, &transfer, half, pace, stretch->density[0]);
    belt_fast_forward_last(&transfer, line, half, pace, returned);
    keep(&front->carried, &transfer);

    /* The first cell's centre lies half the second's width nearer to the outlet, and the other way round. */
    const belt_real_t sum = belt_line_loss_sum(line, middle);
    const belt_real_t less =
        (sum - belt_line_loss_sum(line, middle - BELT_HALF * stretch->width[1])) * pace;
    const belt_real_t more =
        (belt_line_loss_sum(line, middle + BELT_HALF * stretch->width[0]) - sum) * pace;
    const belt_real_t first = transfer.survival * stretch->density[0] * belt_line_survival(-less);
    const belt_real_t second = transfer.survival * stretch->density[1] * belt_line_survival(more);
    put_back(prediction, first + transfer.rework, second + transfer.rework, share);
    return one_after_the_other(first + transfer.rework, second + transfer.rework, share);
}

/** Looks at the level that leaves the window during the stretch ahead, as march_step.h says: on a plain
 * line in its middle, else at both ends too, where there has been a front whose corner one look misses. */
static belt_real_t look_ahead(belt_prediction_t *prediction, const belt_model_t *model,
                              belt_real_t width) {
    belt_front_t *front = &prediction->inlet;
    const belt_real_t half = BELT_HALF * width * front->pace;
    if (belt_line_is_plain(&model->line)) {
        return belt_march_seen_once(front, belt_march_tail_at(prediction, model, half));
    }
    /* In the order of time: the window's end only moves forward. */
    const belt_real_t begin = belt_march_tail_at(prediction, model, BELT_REAL(0));
    const belt_real_t middle = belt_march_tail_at(prediction, model, half);
    const belt_real_t end = belt_march_tail_at(prediction, model, half + half);
    front->tail = BELT_REAL(1.0 / 6.0) * (begin + BELT_REAL(4) * middle + end);
    return BELT_REAL(1.0 / 3.0) * (begin + middle + middle);
}

void belt_march_stretch(belt_prediction_t *prediction, const belt_model_t *model,
                        const belt_stretch_t *stretch) {
    const belt_line_t *line = &model->line;
    belt_front_t *front = &prediction->inlet;
    const belt_real_t width = stretch->width[0] + stretch->width[1];
    const belt_real_t early = look_ahead(prediction, model, width);
    const belt_real_t pace = belt_march_pace_ahead(line, front, width, early);
    const belt_leaving_t leaving = belt_line_is_plain(line)
                                       ? leave_plain(&front->carried, line, stretch, pace)
                                       : leave_any(prediction, line, stretch, pace);
    belt_march_pass(prediction, model, front, width, pace, leaving);
}

void belt_march_to_inlet(belt_prediction_t *prediction, const belt_model_t *model) {
    const belt_line_t *line = &model->line;
    if (!belt_line_is_plain(line)) { /* the march knows survival and rework of the last middle */
        const uint32_t last = prediction->inlet.count - 1u;
        belt_transfer_t transfer =
            while_they_pass(prediction, line, last, (belt_real_t)line->node_count);
        belt_fast_forward_last(&transfer, line, prediction->width[last], prediction->pace[last],
                               returned_by(prediction)[last]);
        keep(&prediction->inlet.carried, &transfer);
    }
}
