/* SPDX-License-Identifier: MIT */
#include "scenario_fault.h"

#include <math.h>
#include <string.h>

/* Enumerations are stored as int through their bytes. */
typedef char static_assert_signal_is_int[sizeof(fault_signal_t) == sizeof(int) ? 1 : -1];
typedef char static_assert_word_is_int[sizeof(fault_word_t) == sizeof(int) ? 1 : -1];

static const scenario_range_t NOT_NEGATIVE = {0.0, (double)INFINITY, true};
static const scenario_range_t POSITIVE = {0.0, (double)INFINITY, false};
static const scenario_range_t ANY = {-(double)INFINITY, (double)INFINITY, true};
static const scenario_range_t SHARE = {0.0, 1.0, false};
static const scenario_range_t TICKS = {0.0, FAULT_TICKS_MAX, true};

/* What may happen to each kind of signal; the rest makes no sense there. */
#define MEASURED_WORDS FAULT_WORDS
#define VALVE_WORDS "off stuck wrong slow delayed intermittent"
#define PERIOD_WORDS "off stuck garbage wrong intermittent"

/* A fault on its way out of its text. */
typedef struct {
    scenario_slice_t text;
    const scenario_place_t *place;
    const scenario_entry_t *entry;
} reading_t;

static bool complain(const reading_t *reading, const char *what, scenario_slice_t part,
                     const char *must) {
    scenario_complain(reading->place, reading->entry, "%.*s: %s \"%.*s\" must be %s",
                      scenario_slice_shown(reading->text), reading->text.start, what,
                      scenario_slice_shown(part), part.length > 0 ? part.start : "", must);
    return false;
}

static const char *words_on(fault_signal_t signal) {
    switch (signal) {
        case FAULT_ON_VALVE: return VALVE_WORDS;
        case FAULT_ON_PERIOD: return PERIOD_WORDS;
        case FAULT_ON_BUFFER_LEVEL:
        case FAULT_ON_OUTLET_FLUX:
        case FAULT_ON_APPLIED_FLUX:
        case FAULT_ON_DENSITY: break;
    }
    return MEASURED_WORDS;
}

static const scenario_range_t *factor_range(fault_signal_t signal) {
    switch (signal) {
        case FAULT_ON_PERIOD: return &TICKS;
        case FAULT_ON_VALVE: return &NOT_NEGATIVE;
        case FAULT_ON_BUFFER_LEVEL:
        case FAULT_ON_OUTLET_FLUX:
        case FAULT_ON_APPLIED_FLUX:
        case FAULT_ON_DENSITY: break;
    }
    return &ANY;
}

/* NULL: the word stands alone. */
static const scenario_range_t *range_of(const fault_t *fault) {
    switch (fault->word) {
        case FAULT_WRONG: return factor_range(fault->signal);
        case FAULT_SLOW:
        case FAULT_DELAYED: return &POSITIVE;
        case FAULT_INTERMITTENT: return &SHARE;
        case FAULT_OFF:
        case FAULT_STUCK:
        case FAULT_GARBAGE: break;
    }
    return NULL;
}

static bool read_number(const reading_t *reading, const char *what, scenario_slice_t part,
                        const scenario_range_t *range, double *number) {
    char limits[SCENARIO_RANGE_SIZE];
    const scenario_number_t result = scenario_number_read(part, range, number);
    if (result == SCENARIO_NUMBER_READ) {
        return true;
    }
    scenario_range_text(range, limits);
    return complain(reading, what, part,
                    result == SCENARIO_NUMBER_OUTSIDE ? limits : "a decimal number");
}

/* `word[=value]` on a signal that is known. */
static bool read_word(const reading_t *reading, scenario_slice_t text, fault_t *fault) {
    const scenario_slice_t word = scenario_slice_next(&text, '=');
    char must[sizeof FAULT_WORDS + 32];
    (void)snprintf(must, sizeof must, "one of: %s", words_on(fault->signal));
    if (scenario_word_find(words_on(fault->signal), word) < 0) {
        return complain(reading, "word", word, must);
    }
    const int index = scenario_word_find(FAULT_WORDS, word);
    memcpy(&fault->word, &index, sizeof index);
    const scenario_range_t *const range = range_of(fault);
    if (range == NULL) {
        return text.start == NULL ||
               complain(reading, "value", scenario_slice(text.start, text.length), "left out");
    }
    const scenario_slice_t nothing = {"", 0};
    const scenario_slice_t value =
        text.start != NULL ? scenario_slice(text.start, text.length) : nothing;
    return read_number(reading, "value", value, range, &fault->value);
}

static bool read_signal(const reading_t *reading, scenario_slice_t signal, fault_t *fault) {
    const int index = scenario_word_find(FAULT_SIGNALS, signal);
    if (index < 0) {
        return complain(reading, "signal", signal, "one of: " FAULT_SIGNALS);
    }
    memcpy(&fault->signal, &index, sizeof index);
    return true;
}

/* The plus sign between start and length, not one of an exponent: 1e+1+2. */
static size_t plus_at(scenario_slice_t times) {
    size_t at = 1;
    while (at < times.length &&
           (times.start[at] != '+' || strchr("eE", times.start[at - 1]) != NULL)) {
        at++;
    }
    return at;
}

/* `start+length`. */
static bool read_times(const reading_t *reading, scenario_slice_t times, fault_t *fault) {
    const size_t at = plus_at(times);
    if (at >= times.length) {
        return complain(reading, "time", times, "start+length");
    }
    const scenario_slice_t start = scenario_slice(times.start, at);
    const scenario_slice_t length = scenario_slice(times.start + at + 1, times.length - at - 1);
    return read_number(reading, "start", start, &NOT_NEGATIVE, &fault->start) &&
           read_number(reading, "length", length, &POSITIVE, &fault->length);
}

bool scenario_fault_read(scenario_slice_t text, const scenario_place_t *place,
                         const scenario_entry_t *entry, fault_t *fault) {
    const reading_t reading = {text, place, entry};
    fault_t found;
    memset(&found, 0, sizeof found);
    scenario_slice_t rest = text;
    const scenario_slice_t signal = scenario_slice_next(&rest, ':');
    if (rest.start == NULL) {
        return complain(&reading, "fault", text, "signal:word[=value]@start+length");
    }
    const scenario_slice_t word = scenario_slice_next(&rest, '@');
    if (rest.start == NULL) {
        return complain(&reading, "fault", text, "signal:word[=value]@start+length");
    }
    if (!read_signal(&reading, signal, &found) || !read_word(&reading, word, &found) ||
        !read_times(&reading, scenario_slice(rest.start, rest.length), &found)) {
        return false;
    }
    *fault = found;
    return true;
}
