/* SPDX-License-Identifier: MIT */
#include "scenario_message.h"

#include <stdarg.h>
#include <string.h>

static void show(FILE *messages, const char *text) {
    fprintf(messages, "%.*s%s", SCENARIO_SHOWN_MAX, text,
            strlen(text) > SCENARIO_SHOWN_MAX ? "..." : "");
}

static void show_entry(FILE *messages, const scenario_entry_t *entry) {
    fputs(" [", messages);
    show(messages, entry->section);
    fputc(']', messages);
    if (entry->key != NULL) {
        fputc(' ', messages);
        show(messages, entry->key);
    }
    if (entry->value != NULL) {
        fputs(" = ", messages);
        show(messages, entry->value);
    }
    fputc(':', messages);
}

void scenario_complain(const scenario_place_t *place, const scenario_entry_t *entry,
                       const char *format, ...) {
    fprintf(place->messages, "%s:", place->name);
    if (place->line > 0) {
        fprintf(place->messages, "%ld:", place->line);
    }
    if (entry != NULL) {
        show_entry(place->messages, entry);
    }
    fputc(' ', place->messages);
    va_list arguments;
    va_start(arguments, format);
    vfprintf(place->messages, format, arguments);
    va_end(arguments);
    fputc('\n', place->messages);
}
