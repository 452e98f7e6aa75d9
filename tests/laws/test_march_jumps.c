/* SPDX-License-Identifier: MIT */
/* The march of a line with laws of its own where the density jumps: `returned` bends, so what is put back is
 * of each cell by itself. */
#include "predictor_case.h"

void setUp(void) {
    set_up_case();
    config.rework_rate = BELT_REAL(0.8);
    config.loss_rate[0] = BELT_REAL(0.3);
}

void tearDown(void) {
}

static double every_other_cell(double x) {
    return ((int)(x / (double)config.belt_length * config.node_count) % 2 == 0) ? 1.0 : 0.0;
}

/** Lays the jumps on the cells themselves: at a node they would be halved. */
static void lay_jumps(void) {
    lay(every_other_cell, level_constant);
    for (uint32_t i = 0; i < model.line.node_count; ++i) {
        model.observer.density[i] =
            BELT_REAL(every_other_cell((double)model.line.spacing * (i + 0.5)));
        model.observer.step[i] = BELT_REAL(0);
    }
}

/** Rework: second order, measured up to 0.053/N^2, and what the fine grid's own ten pieces a cell or more
 * leave, 2e-5. Put back by the mean of two cells instead, it is 0.02 too much. Level: the jump in a pair is
 * taken for a slope, so it is of first order only, measured up to 0.057/N. */
static void test_every_cell_puts_back_what_the_law_makes_of_its_own_density(void) {
    for (uint16_t nodes = 20; nodes <= 80; nodes = (uint16_t)(2 * nodes)) {
        config.node_count = nodes;
        lay_jumps();
        march();
        const future_t future = future_of(every_other_cell, level_constant);
        TEST_ASSERT_DOUBLE_WITHIN(0.1 / nodes / nodes + 2e-5 + rounding(), future.rework,
                                  (double)prediction.inlet_rework);
        TEST_ASSERT_DOUBLE_WITHIN(0.07 / nodes + rounding(), future.level,
                                  (double)prediction.inlet.level);
    }
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_every_cell_puts_back_what_the_law_makes_of_its_own_density);
    return UNITY_END();
}
