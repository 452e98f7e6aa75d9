/* SPDX-License-Identifier: MIT */
/*
 * scenario_keys.h - the one table of all sections and keys of a scenario.
 */
#ifndef HOST_SIM_SCENARIO_KEYS_H
#define HOST_SIM_SCENARIO_KEYS_H

#include <stdbool.h>
#include <stddef.h>

/** Room for the rows of the table, for arrays that hold something for each key. */
#define SCENARIO_KEY_CAPACITY 128

typedef enum {
    KEY_NUMBER, /**< a double. */
    KEY_COUNT,  /**< a long, written without point or exponent. */
    KEY_WORD,   /**< an enumeration: the place of the word in `words`. */
    KEY_LIST,   /**< 1 to LIST_CAPACITY doubles; their number goes to `count_offset`. */
    KEY_WORDS,  /**< the same of words. */
    KEY_FAULTS  /**< 1 to FAULT_CAPACITY faults; their number goes there too. */
} scenario_kind_t;

typedef struct {
    double least;
    double greatest;
    bool least_is_allowed;
} scenario_range_t;

typedef struct {
    const char *section;
    const char *name;
    scenario_kind_t kind;
    size_t offset; /**< of the value in scenario_t; two keys with one offset replace each other. */
    size_t count_offset;  /**< of a list: of the number of values in scenario_t. */
    const char *fallback; /**< the default as one would write it; NULL: by a rule in scenario.c. */
    const scenario_range_t *range; /**< of each number. */
    const char *
        words; /**< KEY_WORD, KEY_WORDS: the words in the order of the enumeration, one blank between. */
} scenario_key_t;

/** Number of rows of the table. */
size_t scenario_key_count(void);

/** Row `index` of the table, index < scenario_key_count(). */
const scenario_key_t *scenario_key_at(size_t index);

/** Index of the row, or scenario_key_count() when there is none. */
size_t scenario_key_find(const char *section, const char *name);

/** Index of a section's first row, which stands for the section, or scenario_key_count(). */
size_t scenario_section_find(const char *section, size_t length);

#endif
