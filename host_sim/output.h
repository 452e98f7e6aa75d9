/* SPDX-License-Identifier: MIT */
/*
 * output.h - result files that are there whole or not at all.
 *
 * A file is written under a temporary name in the folder of its destination and renamed when it
 * is complete and on the disk; until then a file of that name stays as it was. A device or pipe
 * (/dev/stdout) has no name to exchange and is written as it comes.
 */
#ifndef HOST_SIM_OUTPUT_H
#define HOST_SIM_OUTPUT_H

#include <stdbool.h>
#include <stdio.h>

typedef struct {
    const char *path;  /**< as the user wrote it, for messages; NULL: no output wanted. */
    FILE *stream;      /**< to write to while open, else NULL. */
    char *destination; /**< absolute, links followed. */
    char *temporary;   /**< NULL for a device, and once renamed. */
} output_t;

typedef enum {
    OUTPUT_READY,
    OUTPUT_REFUSED, /**< no such folder, a directory, no permission: the caller's mistake. */
    OUTPUT_FAILED   /**< disk full, no memory. */
} output_status_t;

/** Opens an output; path NULL gives one that is not wanted, on which the other functions do
 * nothing. Writes a line on `messages` unless OUTPUT_READY. */
output_status_t output_open(output_t *output, const char *path, FILE *messages);

/** True when both are wanted and lead to the same file. */
bool output_is_same(const output_t *left, const output_t *right);

/** True when the output is wanted and leads to the file at `path`. */
bool output_is_at(const output_t *output, const char *path);

/** Writes out and closes; false, after a message, when any byte may not be on the disk. */
bool output_complete(output_t *output, FILE *messages);

/** Gives a completed output its name; false after a message. */
bool output_publish(output_t *output, FILE *messages);

/** Removes what has not been published and frees everything. */
void output_discard(output_t *output);

#endif
