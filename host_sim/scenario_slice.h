/* SPDX-License-Identifier: MIT */
/*
 * scenario_slice.h - a value's text in pieces: trimmed, taken apart, found among words, read as a
 * number.
 */
#ifndef HOST_SIM_SCENARIO_SLICE_H
#define HOST_SIM_SCENARIO_SLICE_H

#include <stdbool.h>
#include <stddef.h>

#include "scenario_keys.h"

/** Part of a text that ends in '\0' somewhere behind it. */
typedef struct {
    const char *start;
    size_t length;
} scenario_slice_t;

/** Room for what scenario_range_text() writes. */
#define SCENARIO_RANGE_SIZE 64

typedef enum {
    SCENARIO_NUMBER_READ,
    SCENARIO_NUMBER_NONE,    /**< no decimal number. */
    SCENARIO_NUMBER_UNSIZED, /**< too large or too small for a double. */
    SCENARIO_NUMBER_OUTSIDE  /**< not in its range. */
} scenario_number_t;

/** `length` bytes at `start` without the blanks at their ends. */
scenario_slice_t scenario_slice(const char *start, size_t length);

/** Cuts the piece before the first `separator` off a list, trimmed; the list then begins behind it.
 * Without a separator the piece is all, and the list's start becomes NULL. */
scenario_slice_t scenario_slice_next(scenario_slice_t *list, char separator);

/** Length as a precision for printf, at most SCENARIO_SHOWN_MAX. */
int scenario_slice_shown(scenario_slice_t slice);

/** Place of a word among words with one blank between, -1 when it is none of them. */
int scenario_word_find(const char *words, scenario_slice_t word);

/** Whether it is a whole number in digits. */
bool scenario_slice_is_whole(scenario_slice_t text);

/** Reads a decimal number and holds it against its range. */
scenario_number_t scenario_number_read(scenario_slice_t text, const scenario_range_t *range,
                                       double *number);

bool scenario_range_holds(const scenario_range_t *range, double number);

/** Writes the range as it stands behind "must be": "at least 0 and at most 1". */
void scenario_range_text(const scenario_range_t *range, char text[SCENARIO_RANGE_SIZE]);

#endif
