/* SPDX-License-Identifier: MIT */
#include "scenario_slice.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenario_message.h"
#include "scenario_text.h"

scenario_slice_t scenario_slice(const char *start, size_t length) {
    while (length > 0 && strchr(SCENARIO_BLANKS, *start) != NULL) {
        start++;
        length--;
    }
    while (length > 0 && strchr(SCENARIO_BLANKS, start[length - 1]) != NULL) {
        length--;
    }
    const scenario_slice_t slice = {start, length};
    return slice;
}

scenario_slice_t scenario_slice_next(scenario_slice_t *list, char separator) {
    const char *const start = list->start;
    const char *const stop = memchr(start, separator, list->length);
    const size_t length = stop != NULL ? (size_t)(stop - start) : list->length;
    list->start = stop != NULL ? stop + 1 : NULL;
    list->length -= stop != NULL ? length + 1 : length;
    return scenario_slice(start, length);
}

int scenario_slice_shown(scenario_slice_t slice) {
    return slice.length < SCENARIO_SHOWN_MAX ? (int)slice.length : SCENARIO_SHOWN_MAX;
}

int scenario_word_find(const char *words, scenario_slice_t word) {
    for (int index = 0; *words != '\0'; index++) {
        const size_t length = strcspn(words, " ");
        if (length == word.length && memcmp(words, word.start, length) == 0) {
            return index;
        }
        words += length;
        words += strspn(words, " ");
    }
    return -1;
}

static size_t digits_at(scenario_slice_t text, size_t at) {
    size_t count = 0;
    while (at + count < text.length && text.start[at + count] >= '0' &&
           text.start[at + count] <= '9') {
        count++;
    }
    return count;
}

static size_t sign_at(scenario_slice_t text, size_t at) {
    return at < text.length && (text.start[at] == '+' || text.start[at] == '-') ? 1 : 0;
}

/* Decimal numbers only. strtod would take hexadecimal, nan and infinity too, and stop silently at a
 * unit behind the number. */
static bool is_decimal(scenario_slice_t text) {
    size_t at = sign_at(text, 0);
    size_t digits = digits_at(text, at);
    at += digits;
    if (at < text.length && text.start[at] == '.') {
        const size_t fraction = digits_at(text, at + 1);
        at += 1 + fraction;
        digits += fraction;
    }
    if (digits > 0 && at < text.length && (text.start[at] == 'e' || text.start[at] == 'E')) {
        at++;
        at += sign_at(text, at);
        const size_t exponent = digits_at(text, at);
        at += exponent;
        digits = exponent;
    }
    return digits > 0 && at == text.length;
}

bool scenario_slice_is_whole(scenario_slice_t text) {
    const size_t sign = sign_at(text, 0);
    const size_t digits = digits_at(text, sign);
    return digits > 0 && sign + digits == text.length;
}

scenario_number_t scenario_number_read(scenario_slice_t text, const scenario_range_t *range,
                                       double *number) {
    if (!is_decimal(text)) {
        return SCENARIO_NUMBER_NONE;
    }
    errno = 0;
    *number = strtod(text.start, NULL); /* stops at the end of the slice: no digit stands there */
    if (errno == ERANGE) {
        return SCENARIO_NUMBER_UNSIZED;
    }
    return scenario_range_holds(range, *number) ? SCENARIO_NUMBER_READ : SCENARIO_NUMBER_OUTSIDE;
}

bool scenario_range_holds(const scenario_range_t *range, double number) {
    const bool is_above = range->least_is_allowed ? number >= range->least : number > range->least;
    return is_above && number <= range->greatest;
}

void scenario_range_text(const scenario_range_t *range, char text[SCENARIO_RANGE_SIZE]) {
    const char *const relation = range->least_is_allowed ? "at least" : "greater than";
    if (isinf(range->greatest)) {
        (void)snprintf(text, SCENARIO_RANGE_SIZE, "%s %g", relation, range->least);
    } else {
        (void)snprintf(text, SCENARIO_RANGE_SIZE, "%s %g and at most %g", relation, range->least,
                       range->greatest);
    }
}
