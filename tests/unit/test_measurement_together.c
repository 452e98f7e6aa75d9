/* SPDX-License-Identifier: MIT */
/* Every combination of what can be wrong in one period. */
#include "gate_case.h"

void setUp(void) {
    begin_with_all_inputs();
}

void tearDown(void) {
}

/* What can be wrong with each input; the bits said of it. */
typedef struct {
    void (*make)(void);
    uint32_t error_bits;
} fault_t;

static void make_nothing(void) {
}
static void make_level_missing(void) {
    measurement.present &= ~BELT_HAS_LEVEL;
}
static void make_level_invalid(void) {
    measurement.level = BELT_REAL(INFINITY);
}
static void make_level_out_of_range(void) {
    memory.level = BELT_REAL(1);
    measurement.level = BELT_REAL(1.0625);
}
static void make_level_stale(void) {
    memory.sample_count = measurement.sample_count + 1u; /* step_after() counts one up */
    memory.sample_age = limits.sample_periods;
}
static void make_level_step(void) {
    measurement.level = BELT_REAL(0.9);
}
static void make_level_out_of_range_and_far_away(void) {
    measurement.level = BELT_REAL(1.0625);
}
static const fault_t level_faults[] = {
    {make_nothing, 0u},
    {make_level_missing, BELT_ERROR_LEVEL_MISSING},
    {make_level_invalid, BELT_ERROR_LEVEL_INVALID},
    {make_level_out_of_range, BELT_ERROR_LEVEL_RANGE},
    {make_level_stale, BELT_ERROR_LEVEL_STALE},
    {make_level_step, BELT_ERROR_LEVEL_STEP},
    {make_level_out_of_range_and_far_away, BELT_ERROR_LEVEL_RANGE | BELT_ERROR_LEVEL_STEP},
};

static void make_outlet_flux_invalid(void) {
    measurement.outlet_flux = BELT_REAL(-1);
}
static void make_applied_flux_invalid(void) {
    measurement.applied_flux = BELT_REAL(-1);
}
static void make_flux_mismatch(void) {
    memory.mismatch_periods = 4u;
    measurement.applied_flux = BELT_REAL(0.25);
}
static const fault_t flux_faults[] = {
    {make_nothing, 0u},
    {make_outlet_flux_invalid, BELT_ERROR_OUTLET_FLUX_INVALID},
    {make_applied_flux_invalid, BELT_ERROR_APPLIED_FLUX_INVALID},
    {make_flux_mismatch, BELT_ERROR_FLUX_MISMATCH},
};

static void make_density_invalid(void) {
    density[3] = BELT_REAL(NAN);
}
static void make_density_out_of_range(void) {
    density[4] = BELT_REAL(-1);
}
static const fault_t density_faults[] = {
    {make_nothing, 0u},
    {make_density_invalid, BELT_ERROR_DENSITY_INVALID},
    {make_density_out_of_range, BELT_ERROR_DENSITY_RANGE},
};

static const struct {
    uint32_t elapsed;
    uint32_t error_bits;
} period_faults[] = {{1u, 0u},
                     {2u, BELT_ERROR_PERIODS_LATE},
                     {CAP + 1u, BELT_ERROR_PERIODS_LOST},
                     {0u, BELT_ERROR_PERIOD_REPEATED}};

static void test_every_combination_of_faults_says_each_of_them(void) {
    for (size_t i = 0; i < COUNT(level_faults); ++i) {
        for (size_t j = 0; j < COUNT(flux_faults); ++j) {
            for (size_t k = 0; k < COUNT(density_faults); ++k) {
                for (size_t m = 0; m < COUNT(period_faults); ++m) {
                    setUp();
                    level_faults[i].make();
                    flux_faults[j].make();
                    density_faults[k].make();
                    const uint32_t bits = level_faults[i].error_bits | flux_faults[j].error_bits |
                                          density_faults[k].error_bits |
                                          period_faults[m].error_bits;
                    /* A step repeated in its period reads nothing. */
                    const uint32_t said =
                        (period_faults[m].elapsed == 0u) ? BELT_ERROR_PERIOD_REPEATED : bits;
                    TEST_ASSERT_EQUAL_HEX32(said, step_after(period_faults[m].elapsed).error_bits);
                }
            }
        }
    }
}

static void test_all_faults_that_can_meet_meet(void) {
    make_level_out_of_range_and_far_away();
    make_outlet_flux_invalid();
    make_flux_mismatch();
    make_density_invalid();
    make_density_out_of_range();
    TEST_ASSERT_EQUAL_HEX32(0x4u | 0x8u | 0x20u | 0x40u | 0x100u | 0x400u | 0x1000u,
                            step_after(UINT32_MAX).error_bits);
}

int main(void) {
    UNITY_BEGIN();
    RUN_TEST(test_every_combination_of_faults_says_each_of_them);
    RUN_TEST(test_all_faults_that_can_meet_meet);
    return UNITY_END();
}
