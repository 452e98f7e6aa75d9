/* SPDX-License-Identifier: MIT */
#include "measurement.h"

/** Weight of one sample in level_quality. */
#define QUALITY_SHARE BELT_REAL(0.01)

/** True for numbers in [0, bound]; false for every NaN and infinity. */
static bool is_sound(belt_real_t value, belt_real_t bound) {
    return (value >= BELT_REAL(0)) && (value <= bound);
}

/** True for a level that noise on one the buffer can have may make; false for every NaN. */
static bool is_plausible(belt_real_t level, const belt_line_t *line) {
    const belt_real_t margin = BELT_LEVEL_MARGIN * line->level_capacity;
    return (level >= -margin) && (level <= line->level_capacity + margin);
}

static bool are_near(belt_real_t a, belt_real_t b, belt_real_t distance) {
    const belt_real_t difference = a - b;
    return (difference >= -distance) && (difference <= distance);
}

/** So many more, as far as counting makes a difference. */
static uint32_t counted(uint32_t count, uint32_t more, uint32_t enough) {
    return ((count < enough) && (more < enough - count)) ? count + more : enough;
}

static uint32_t one_more(uint32_t count, uint32_t enough) {
    return counted(count, 1u, enough);
}

void belt_measurement_init(belt_gate_t *gate, const belt_limits_t *limits) {
    const belt_gate_t empty = {0};
    *gate = empty;
    gate->level_quality = BELT_REAL(1);
    gate->good_samples = limits->recovery_samples;
    gate->health = BELT_LEVEL_TRUSTED;
}

/** Whether this step brings a new sample, `periods` after the last; says so if one is overdue. */
static bool has_new_sample(belt_gate_t *gate, const belt_measurement_t *measurement,
                           const belt_limits_t *limits, uint32_t periods, uint32_t *error_bits) {
    const bool is_counted = (measurement->present & BELT_HAS_SAMPLE_COUNT) != 0u;
    const bool is_new =
        !is_counted || (gate->has_level == 0u) || (measurement->sample_count != gate->sample_count);
    gate->sample_age = is_new ? 0u : counted(gate->sample_age, periods, limits->sample_periods);
    gate->sample_count = is_counted ? measurement->sample_count : gate->sample_count;
    if (gate->sample_age >= limits->sample_periods) {
        *error_bits |= BELT_ERROR_LEVEL_STALE;
    }
    return is_new;
}

/** Whether a sample is near enough to the last good one, or to enough others that are not. */
static bool is_believed(belt_gate_t *gate, belt_real_t level, const belt_limits_t *limits) {
    if ((gate->has_level == 0u) || are_near(level, gate->level, limits->level_step_max)) {
        gate->agreeing_samples = 0;
        return true;
    }
    const bool agrees = are_near(level, gate->level_elsewhere, limits->level_step_max);
    gate->agreeing_samples =
        agrees ? one_more(gate->agreeing_samples, limits->recovery_samples) : 1u;
    gate->level_elsewhere = level;
    if (gate->agreeing_samples < limits->recovery_samples) {
        return false;
    }
    gate->agreeing_samples = 0;
    gate->good_samples = limits->recovery_samples; /* they were good ones after all */
    return true;
}

/** The level that is trusted in this period, if there is one. */
static bool gate_level(belt_gate_t *gate, const belt_measurement_t *measurement,
                       const belt_line_t *line, const belt_limits_t *limits, uint32_t periods,
                       uint32_t *error_bits) {
    if ((measurement->present & BELT_HAS_LEVEL) == 0u) {
        gate->sample_age = counted(gate->sample_age, periods, limits->sample_periods);
        if (gate->sample_age >= limits->sample_periods) { /* between two samples there is none */
            *error_bits |= BELT_ERROR_LEVEL_MISSING;
        }
        return false;
    }
    if (!is_plausible(measurement->level, line)) {
        *error_bits |= BELT_ERROR_LEVEL_INVALID;
        gate->agreeing_samples = 0;
        return false;
    }
    if (!has_new_sample(gate, measurement, limits, periods, error_bits)) {
        return false;
    }
    const belt_real_t level = belt_line_level(line, measurement->level);
    if (!is_sound(measurement->level, line->level_capacity)) {
        *error_bits |= BELT_ERROR_LEVEL_RANGE;
    }
    if (!is_believed(gate, measurement->level, limits)) {
        *error_bits |= BELT_ERROR_LEVEL_STEP;
        return false;
    }
    if (gate->has_level == 0u) { /* nothing before it speaks against the first one */
        gate->good_samples = limits->recovery_samples;
    }
    gate->level = level;
    gate->has_level = 1u;
    return true;
}

static void judge_bad(belt_gate_t *gate, uint32_t periods, const belt_limits_t *limits) {
    gate->good_samples = 0;
    gate->bad_periods = counted(gate->bad_periods, periods, limits->hold_periods + 1u);
    if (gate->bad_periods > limits->hold_periods) {
        gate->found_samples = 0;
        gate->health = BELT_LEVEL_LOST;
    } else if (gate->health != BELT_LEVEL_LOST) {
        gate->health = BELT_LEVEL_DOUBTED;
    }
}

/** Good samples in a row end every doubt; with gaps no longer than hold bears, they end the loss. */
static void judge_good(belt_gate_t *gate, const belt_limits_t *limits) {
    gate->bad_periods = 0;
    gate->good_samples = one_more(gate->good_samples, limits->recovery_samples);
    gate->found_samples = one_more(gate->found_samples, limits->recovery_samples);
    if (gate->good_samples >= limits->recovery_samples) {
        gate->health = BELT_LEVEL_TRUSTED;
    } else if (gate->found_samples >= limits->recovery_samples) {
        gate->health = BELT_LEVEL_DOUBTED;
    }
}

/** How the level stands after a period with a good sample, without one, or between two samples. */
static void judge_level(belt_gate_t *gate, bool is_good, bool is_bad, uint32_t periods,
                        const belt_limits_t *limits) {
    if (is_good || is_bad) {
        const belt_real_t found = is_good ? BELT_REAL(1) : BELT_REAL(0);
        gate->level_quality = belt_within(
            BELT_REAL(0), gate->level_quality + QUALITY_SHARE * (found - gate->level_quality),
            BELT_REAL(1));
    }
    if (is_bad) {
        judge_bad(gate, periods, limits);
    } else if (is_good) {
        judge_good(gate, limits);
    }
}

/** Periods to be made up for. */
static uint32_t gate_periods(belt_gate_t *gate, const belt_measurement_t *measurement,
                             uint32_t *error_bits) {
    const uint32_t cap = BELT_CATCH_UP_PERIODS;
    const bool is_told = (measurement->present & BELT_HAS_ELAPSED_TICKS) != 0u;
    const uint32_t elapsed = is_told ? measurement->elapsed_ticks : 1u;
    if (elapsed == 0u) {
        *error_bits |= BELT_ERROR_PERIOD_REPEATED;
        return 0;
    }
    const bool are_lost = (elapsed > cap) || (gate->owed_periods > cap - elapsed);
    const uint32_t periods = are_lost ? cap : elapsed + gate->owed_periods;
    gate->owed_periods = 0;
    if (are_lost) {
        *error_bits |= BELT_ERROR_PERIODS_LOST;
    } else if (periods > 1u) {
        *error_bits |= BELT_ERROR_PERIODS_LATE;
    }
    return periods;
}

static bool gate_density(const belt_measurement_t *measurement, const belt_line_t *line,
                         uint32_t *error_bits) {
    if ((measurement->present & BELT_HAS_DENSITY) == 0u) {
        return false;
    }
    if (measurement->density == NULL) {
        *error_bits |= BELT_ERROR_DENSITY_INVALID;
        return false;
    }
    uint32_t found = 0;
    for (uint32_t i = 0; i <= line->node_count; ++i) {
        const belt_real_t density = measurement->density[i];
        if (density < BELT_REAL(0)) {
            found |= BELT_ERROR_DENSITY_RANGE;
        } else if (!is_sound(density, line->density_bound)) {
            found |= BELT_ERROR_DENSITY_INVALID;
        }
    }
    *error_bits |= found;
    return found == 0u;
}

/** The flux really fed, and whether the valve does what it is told. */
static belt_real_t gate_applied_flux(belt_gate_t *gate, const belt_measurement_t *measurement,
                                     belt_real_t command, const belt_line_t *line,
                                     const belt_limits_t *limits, uint32_t *error_bits) {
    if ((measurement->present & BELT_HAS_APPLIED_FLUX) == 0u) {
        gate->mismatch_periods = 0;
        return command;
    }
    if (!is_sound(measurement->applied_flux, line->flux_bound)) {
        *error_bits |= BELT_ERROR_APPLIED_FLUX_INVALID;
        return command;
    }
    gate->mismatch_periods = are_near(measurement->applied_flux, command, limits->flux_tolerance)
                                 ? 0u
                                 : one_more(gate->mismatch_periods, BELT_MISMATCH_PERIODS);
    if (gate->mismatch_periods >= BELT_MISMATCH_PERIODS) {
        *error_bits |= BELT_ERROR_FLUX_MISMATCH;
    }
    return measurement->applied_flux;
}

void belt_measurement_gate(belt_trusted_t *trusted, belt_gate_t *gate,
                           const belt_measurement_t *measurement, belt_real_t command,
                           const belt_line_t *line, const belt_limits_t *limits) {
    const uint32_t level_is_bad = BELT_ERROR_LEVEL_MISSING | BELT_ERROR_LEVEL_INVALID |
                                  BELT_ERROR_LEVEL_STALE | BELT_ERROR_LEVEL_STEP |
                                  BELT_ERROR_PERIODS_LOST;
    const belt_trusted_t nothing = {0};
    uint32_t error_bits = 0;
    *trusted = nothing;
    trusted->periods = gate_periods(gate, measurement, &error_bits);
    if ((trusted->periods == 0u) && (gate->has_level != 0u)) { /* nothing moves */
        trusted->level = gate->level;
        trusted->applied_flux = command;
        trusted->error_bits = error_bits;
        return;
    }
    trusted->level_is_new =
        gate_level(gate, measurement, line, limits, trusted->periods, &error_bits);
    trusted->level = gate->level;
    const bool is_bad = (error_bits & level_is_bad) != 0u;
    /* A sample that comes after lost periods is one that is not believed, and no longer lack of it. */
    const uint32_t bad_periods = trusted->level_is_new ? 1u : trusted->periods;
    judge_level(gate, trusted->level_is_new && !is_bad, is_bad, bad_periods, limits);

    trusted->has_outlet_flux = (measurement->present & BELT_HAS_OUTLET_FLUX) != 0u;
    if (trusted->has_outlet_flux && !is_sound(measurement->outlet_flux, line->flux_bound)) {
        trusted->has_outlet_flux = false;
        error_bits |= BELT_ERROR_OUTLET_FLUX_INVALID;
    }
    trusted->outlet_flux = trusted->has_outlet_flux ? measurement->outlet_flux : BELT_REAL(0);
    trusted->applied_flux =
        gate_applied_flux(gate, measurement, command, line, limits, &error_bits);
    trusted->has_density = gate_density(measurement, line, &error_bits);
    trusted->error_bits = error_bits;
}
