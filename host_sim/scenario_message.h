/* SPDX-License-Identifier: MIT */
/*
 * scenario_message.h - where in the input something stands, and what is wrong with it.
 */
#ifndef HOST_SIM_SCENARIO_MESSAGE_H
#define HOST_SIM_SCENARIO_MESSAGE_H

#include <stdio.h>

/** Bytes of a name or value that a message repeats. */
#define SCENARIO_SHOWN_MAX 80

typedef struct {
    const char *name; /**< the file, or `--set`. */
    long line;        /**< counted from 1; 0: no line to name. */
    FILE *messages;
} scenario_place_t;

/** A key as it was written, for the message; `key` or `value` NULL: not known. */
typedef struct {
    const char *section;
    const char *key;
    const char *value;
} scenario_entry_t;

/** Writes one line: place, entry (NULL: none), what is wrong. A long value is cut. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
void scenario_complain(const scenario_place_t *place, const scenario_entry_t *entry,
                       const char *format, ...);

#endif
