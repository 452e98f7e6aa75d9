/* SPDX-License-Identifier: MIT */
#include "scenario_value.h"

#include <stdlib.h>
#include <string.h>

#include "scenario_fault.h"
#include "scenario_slice.h"

/* Enumerations are stored as int through their bytes. */
typedef char static_assert_mode_is_int[sizeof(scenario_mode_t) == sizeof(int) ? 1 : -1];
typedef char static_assert_law_is_int[sizeof(scenario_law_t) == sizeof(int) ? 1 : -1];
typedef char static_assert_scheme_is_int[sizeof(scenario_scheme_t) == sizeof(int) ? 1 : -1];
typedef char static_assert_estimator_is_int[sizeof(scenario_estimator_t) == sizeof(int) ? 1 : -1];

/* A value on its way into the scenario. */
typedef struct {
    const scenario_key_t *key;
    const scenario_place_t *place;
    scenario_entry_t entry;
} target_t;

static bool complain_of_range(const target_t *target) {
    char limits[SCENARIO_RANGE_SIZE];
    scenario_range_text(target->key->range, limits);
    scenario_complain(target->place, &target->entry, "must be %s", limits);
    return false;
}

static bool read_number(const target_t *target, scenario_slice_t text, double *number) {
    switch (scenario_number_read(text, target->key->range, number)) {
        case SCENARIO_NUMBER_READ: return true;
        case SCENARIO_NUMBER_OUTSIDE: return complain_of_range(target);
        case SCENARIO_NUMBER_NONE:
            scenario_complain(target->place, &target->entry, "\"%.*s\" is not a decimal number",
                              scenario_slice_shown(text), text.start);
            break;
        case SCENARIO_NUMBER_UNSIZED:
            scenario_complain(target->place, &target->entry,
                              "must be 0 or of a size from 2.3e-308 to 1.7e308");
            break;
    }
    return false;
}

static bool store_number(const target_t *target, scenario_slice_t text, char *destination) {
    double number = 0.0;
    if (!read_number(target, text, &number)) {
        return false;
    }
    memcpy(destination, &number, sizeof number);
    return true;
}

static bool store_count(const target_t *target, scenario_slice_t text, char *destination) {
    if (!scenario_slice_is_whole(text)) {
        scenario_complain(target->place, &target->entry, "must be a whole number in digits");
        return false;
    }
    /* Beyond its range strtol answers with the end of the range, which no key allows. */
    const long count = strtol(text.start, NULL, 10);
    if (!scenario_range_holds(target->key->range, (double)count)) {
        return complain_of_range(target);
    }
    memcpy(destination, &count, sizeof count);
    return true;
}

static bool store_word(const target_t *target, scenario_slice_t text, char *destination) {
    const int index = scenario_word_find(target->key->words, text);
    if (index < 0) {
        scenario_complain(target->place, &target->entry, "must be one of: %s", target->key->words);
        return false;
    }
    memcpy(destination, &index, sizeof index);
    return true;
}

static bool store_fault(const target_t *target, scenario_slice_t text, char *destination) {
    fault_t fault;
    if (!scenario_fault_read(text, target->place, &target->entry, &fault)) {
        return false;
    }
    memcpy(destination, &fault, sizeof fault);
    return true;
}

/* What a list of each kind holds. */
typedef struct {
    size_t capacity;
    size_t size; /* of one element */
    bool (*store)(const target_t *target, scenario_slice_t text, char *destination);
} list_t;

static list_t list_of(scenario_kind_t kind) {
    const list_t numbers = {LIST_CAPACITY, sizeof(double), store_number};
    const list_t words = {LIST_CAPACITY, sizeof(int), store_word};
    const list_t faults = {FAULT_CAPACITY, sizeof(fault_t), store_fault};
    switch (kind) {
        case KEY_WORDS: return words;
        case KEY_FAULTS: return faults;
        case KEY_NUMBER:
        case KEY_COUNT:
        case KEY_WORD:
        case KEY_LIST: break;
    }
    return numbers;
}

static bool store_element(const target_t *target, const list_t *list, scenario_slice_t text,
                          size_t index, char *elements) {
    if (index == list->capacity) {
        scenario_complain(target->place, &target->entry, "must hold at most %zu values",
                          list->capacity);
        return false;
    }
    if (text.length == 0) {
        scenario_complain(target->place, &target->entry,
                          "value %zu of the list is empty; no comma stands at its ends", index + 1);
        return false;
    }
    return list->store(target, text, elements + index * list->size);
}

/* Behind the first `*stored` elements; all are there or none. Room behind the last one is cleared, so
 * that equal lists are equal bytes. */
static bool store_list(const target_t *target, scenario_slice_t text, char *destination,
                       size_t *stored) {
    const list_t list = list_of(target->key->kind);
    char elements[sizeof(fault_t) * FAULT_CAPACITY + sizeof(double) * LIST_CAPACITY];
    memset(elements, 0, sizeof elements);
    size_t count = *stored;
    while (text.start != NULL) {
        const scenario_slice_t element = scenario_slice_next(&text, ',');
        if (!store_element(target, &list, element, count, elements)) {
            return false;
        }
        count++;
    }
    memcpy(destination + *stored * list.size, elements + *stored * list.size,
           (list.capacity - *stored) * list.size);
    *stored = count;
    return true;
}

static bool is_list(const scenario_key_t *key) {
    return key->kind == KEY_LIST || key->kind == KEY_WORDS || key->kind == KEY_FAULTS;
}

/* Behind what the list holds already, `kept` elements. */
static bool add_to_list(const target_t *target, scenario_slice_t value, size_t kept,
                        scenario_t *scenario) {
    size_t count = kept;
    if (!store_list(target, value, (char *)scenario + target->key->offset, &count)) {
        return false;
    }
    memcpy((char *)scenario + target->key->count_offset, &count, sizeof count);
    return true;
}

static bool store_value(const target_t *target, scenario_slice_t value, scenario_t *scenario) {
    char *const destination = (char *)scenario + target->key->offset;
    switch (target->key->kind) {
        case KEY_NUMBER: return store_number(target, value, destination);
        case KEY_COUNT: return store_count(target, value, destination);
        case KEY_WORD: return store_word(target, value, destination);
        case KEY_LIST:
        case KEY_WORDS:
        case KEY_FAULTS: break;
    }
    return add_to_list(target, value, 0, scenario);
}

static bool value_is_there(const target_t *target, scenario_slice_t value) {
    if (value.length == 0) {
        scenario_complain(target->place, &target->entry,
                          "has no value; leave the key out for its default");
    }
    return value.length > 0;
}

bool scenario_value_store(const scenario_key_t *key, const char *text,
                          const scenario_place_t *place, scenario_t *scenario) {
    const target_t target = {key, place, {key->section, key->name, text}};
    const scenario_slice_t value = scenario_slice(text, strlen(text));
    return value_is_there(&target, value) && store_value(&target, value, scenario);
}

bool scenario_value_add(const scenario_key_t *key, const char *text, const scenario_place_t *place,
                        scenario_t *scenario) {
    const target_t target = {key, place, {key->section, key->name, text}};
    const scenario_slice_t value = scenario_slice(text, strlen(text));
    return value_is_there(&target, value) &&
           add_to_list(&target, value, scenario_value_count(key, scenario), scenario);
}

size_t scenario_value_count(const scenario_key_t *key, const scenario_t *scenario) {
    size_t count = 0;
    if (!is_list(key)) {
        return count;
    }
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
