/* SPDX-License-Identifier: MIT */
#include "scenario_value.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scenario_text.h"

/* Enumerations are stored as int through their bytes. */
typedef char static_assert_law_is_int[sizeof(scenario_law_t) == sizeof(int) ? 1 : -1];
typedef char static_assert_scheme_is_int[sizeof(scenario_scheme_t) == sizeof(int) ? 1 : -1];

/* Part of a text that ends in '\0' somewhere behind it. */
typedef struct {
    const char *start;
    size_t length;
} slice_t;

/* A value on its way into the scenario. */
typedef struct {
    const scenario_key_t *key;
    const scenario_place_t *place;
    scenario_entry_t entry;
} target_t;

static slice_t trimmed(const char *start, size_t length) {
    while (length > 0 && strchr(SCENARIO_BLANKS, *start) != NULL) {
        start++;
        length--;
    }
    while (length > 0 && strchr(SCENARIO_BLANKS, start[length - 1]) != NULL) {
        length--;
    }
    const slice_t slice = {start, length};
    return slice;
}

static size_t digits_at(slice_t text, size_t at) {
    size_t count = 0;
    while (at + count < text.length && text.start[at + count] >= '0' &&
           text.start[at + count] <= '9') {
        count++;
    }
    return count;
}

static size_t sign_at(slice_t text, size_t at) {
    return at < text.length && (text.start[at] == '+' || text.start[at] == '-') ? 1 : 0;
}

/* Decimal numbers only. strtod would take hexadecimal, nan and infinity too, and stop silently at a
 * unit behind the number. */
static bool is_decimal(slice_t text) {
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

static bool is_whole(slice_t text) {
    const size_t sign = sign_at(text, 0);
    const size_t digits = digits_at(text, sign);
    return digits > 0 && sign + digits == text.length;
}

static bool range_is_left(const target_t *target, double number) {
    const scenario_range_t *const range = target->key->range;
    const bool is_above = range->least_is_allowed ? number >= range->least : number > range->least;
    if (is_above && number <= range->greatest) {
        return false;
    }
    const char *const relation = range->least_is_allowed ? "at least" : "greater than";
    if (isinf(range->greatest)) {
        scenario_complain(target->place, &target->entry, "must be %s %g", relation, range->least);
    } else {
        scenario_complain(target->place, &target->entry, "must be %s %g and at most %g", relation,
                          range->least, range->greatest);
    }
    return true;
}

static bool read_number(const target_t *target, slice_t text, double *number) {
    if (!is_decimal(text)) {
        const int shown = text.length < SCENARIO_SHOWN_MAX ? (int)text.length : SCENARIO_SHOWN_MAX;
        scenario_complain(target->place, &target->entry, "\"%.*s\" is not a decimal number", shown,
                          text.start);
        return false;
    }
    errno = 0;
    *number = strtod(text.start, NULL);
    if (errno == ERANGE) {
        scenario_complain(target->place, &target->entry,
                          "must be 0 or of a size from 2.3e-308 to 1.7e308");
        return false;
    }
    return !range_is_left(target, *number);
}

static bool store_number(const target_t *target, slice_t text, char *destination) {
    double number = 0.0;
    if (!read_number(target, text, &number)) {
        return false;
    }
    memcpy(destination, &number, sizeof number);
    return true;
}

static bool store_count(const target_t *target, slice_t text, char *destination) {
    if (!is_whole(text)) {
        scenario_complain(target->place, &target->entry, "must be a whole number in digits");
        return false;
    }
    /* Beyond its range strtol answers with the end of the range, which no key allows. */
    const long count = strtol(text.start, NULL, 10);
    if (range_is_left(target, (double)count)) {
        return false;
    }
    memcpy(destination, &count, sizeof count);
    return true;
}

static bool store_word(const target_t *target, slice_t text, char *destination) {
    const char *word = target->key->words;
    for (int index = 0; *word != '\0'; index++) {
        const size_t length = strcspn(word, " ");
        if (length == text.length && memcmp(word, text.start, length) == 0) {
            memcpy(destination, &index, sizeof index);
            return true;
        }
        word += length;
        word += strspn(word, " ");
    }
    scenario_complain(target->place, &target->entry, "must be one of: %s", target->key->words);
    return false;
}

static bool read_element(const target_t *target, slice_t element, size_t index, double *number) {
    if (index == LIST_CAPACITY) {
        scenario_complain(target->place, &target->entry, "must hold at most %d values",
                          LIST_CAPACITY);
        return false;
    }
    if (element.length == 0) {
        scenario_complain(target->place, &target->entry,
                          "value %zu of the list is empty; no comma stands at its ends", index + 1);
        return false;
    }
    return read_number(target, element, number);
}

static bool store_list(const target_t *target, slice_t text, char *destination, size_t *stored) {
    double values[LIST_CAPACITY];
    size_t count = 0;
    const char *start = text.start;
    const char *stop = NULL;
    const char *const end = text.start + text.length;
    do {
        const char *const comma = memchr(start, ',', (size_t)(end - start));
        stop = comma != NULL ? comma : end;
        double number = 0.0;
        if (!read_element(target, trimmed(start, (size_t)(stop - start)), count, &number)) {
            return false;
        }
        values[count++] = number;
        start = stop + 1;
    } while (stop < end);
    memcpy(destination, values, count * sizeof values[0]);
    *stored = count;
    return true;
}

bool scenario_value_store(const scenario_key_t *key, const char *text,
                          const scenario_place_t *place, scenario_t *scenario) {
    const target_t target = {key, place, {key->section, key->name, text}};
    const slice_t value = trimmed(text, strlen(text));
    char *const destination = (char *)scenario + key->offset;
    if (value.length == 0) {
        scenario_complain(place, &target.entry, "has no value; leave the key out for its default");
        return false;
    }
    switch (key->kind) {
        case KEY_NUMBER: return store_number(&target, value, destination);
        case KEY_COUNT: return store_count(&target, value, destination);
        case KEY_WORD: return store_word(&target, value, destination);
        case KEY_LIST: break;
    }
    size_t count = 0;
    if (!store_list(&target, value, destination, &count)) {
        return false;
    }
    memcpy((char *)scenario + key->count_offset, &count, sizeof count);
    return true;
}

size_t scenario_value_count(const scenario_key_t *key, const scenario_t *scenario) {
    size_t count = 0;
    memcpy(&count, (const char *)scenario + key->count_offset, sizeof count);
    return count;
}

void scenario_value_copy(const scenario_key_t *from, const scenario_key_t *to,
                         scenario_t *scenario) {
    char *const base = (char *)scenario;
    size_t size = sizeof(double);
    if (from->kind == KEY_LIST) {
        const size_t count = scenario_value_count(from, scenario);
        memcpy(base + to->count_offset, &count, sizeof count);
        size *= count;
    }
    memcpy(base + to->offset, base + from->offset, size);
}
