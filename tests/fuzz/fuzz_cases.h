/* SPDX-License-Identifier: MIT */
/*
 * fuzz_cases.h - sound configurations to start from, and what holds of a controller after every
 * step whatever came in.
 */
#ifndef TESTS_FUZZ_CASES_H
#define TESTS_FUZZ_CASES_H

#include "belt/belt.h"

#define FUZZ_CASE_COUNT 4u

/** Sound configurations: the paper's; four nodes and every limit of the command; a loss profile with
 * the estimator; a long window with the frozen march and rare samples. index < FUZZ_CASE_COUNT. */
belt_config_t fuzz_case(unsigned index);

static inline bool fuzz_is_finite(belt_real_t value) {
    return (value >= -BELT_REAL_MAX) && (value <= BELT_REAL_MAX);
}

/** Fills a command with bits that no step may leave: every field of it breaks fuzz_check_command(). */
void fuzz_spoil_command(belt_command_t *command);

/** Stops unless the step wrote the whole command: the flux finite and within its limits, the mode one
 * of its words, no error bit but those there are. */
void fuzz_check_command(const belt_command_t *command, belt_real_t inlet_flux_max);

/** Stops unless what a controller holds is finite and within its bounds. */
void fuzz_check_controller(const belt_controller_t *controller);

#endif
