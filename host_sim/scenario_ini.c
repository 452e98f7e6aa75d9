/* SPDX-License-Identifier: MIT */
#include "scenario_ini.h"

#include <ini.h>
#include <string.h>

#include "scenario.h"
#include "scenario_keys.h"
#include "scenario_text.h"

/* inih is handed one line at a time, after a look at it: how it was built decides whether it
 * continues lines, takes comments behind values, skips a byte order mark, and where it cuts a long
 * line in two. No line that reaches it shows the difference. */

/* Bytes inih keeps free in its line for CR, LF and the end of the string. */
#define LINE_MAX_BYTES ((size_t)INI_MAX_LINE - 3)

typedef struct {
    const char *text;
    size_t length;
    size_t at; /* of the first byte not yet handed on */
    scenario_place_t place;
    const scenario_taker_t *taker;
    bool is_refused;
    bool is_opened[SCENARIO_KEY_CAPACITY]; /* by the index of the section's first key */
} reading_t;

static bool text_is_refused(const reading_t *reading, const char *line, size_t length, int room) {
    const size_t limit = (size_t)room < LINE_MAX_BYTES + 2 ? (size_t)room - 2 : LINE_MAX_BYTES;
    if (length > limit) {
        scenario_complain(&reading->place, NULL, "line of %zu bytes; at most %zu", length, limit);
        return true;
    }
    const size_t fault = scenario_text_fault(line, length);
    if (fault < length) {
        scenario_complain(&reading->place, NULL,
                          "byte 0x%02X at column %zu is no text; must be UTF-8 without control "
                          "characters and byte order mark",
                          (unsigned)(unsigned char)line[fault], fault + 1);
        return true;
    }
    return false;
}

static bool section_is_refused(reading_t *reading, const char *line, size_t length) {
    const char *const close = memchr(line, ']', length);
    if (close == NULL) {
        scenario_complain(&reading->place, NULL, "section without ']'");
        return true;
    }
    const char *const name = line + 1;
    const size_t index = scenario_section_find(name, (size_t)(close - name));
    if (index == scenario_key_count()) {
        scenario_complain(&reading->place, NULL, "unknown section %.*s", (int)(close - line) + 1,
                          line);
        return true;
    }
    if (reading->is_opened[index]) {
        scenario_complain(&reading->place, NULL, "section %.*s stands twice",
                          (int)(close - line) + 1, line);
        return true;
    }
    reading->is_opened[index] = true;
    const size_t used = (size_t)(close - line) + 1;
    if (strspn(close + 1, SCENARIO_BLANKS) < length - used) {
        scenario_complain(&reading->place, NULL, "text behind the section; comments stand alone");
        return true;
    }
    return false;
}

static bool entry_is_refused(const reading_t *reading, const char *line) {
    const size_t separator = strcspn(line, "=:");
    if (line[separator] != '=') {
        scenario_complain(&reading->place, NULL, "must be `key = value`, `[section]` or a comment");
        return true;
    }
    const char *const comment = strpbrk(line, ";#");
    if (comment != NULL) {
        scenario_complain(&reading->place, NULL,
                          "'%c' behind the key; comments stand on lines of their own", *comment);
        return true;
    }
    return false;
}

/* `line` ends in '\0'. */
static bool line_is_refused(reading_t *reading, const char *line, size_t length) {
    const size_t indent = strspn(line, SCENARIO_BLANKS);
    if (indent == length || line[0] == '#' || line[0] == ';') {
        return false;
    }
    if (indent > 0) {
        scenario_complain(&reading->place, NULL, "indented; values do not continue on a next line");
        return true;
    }
    return line[0] == '[' ? section_is_refused(reading, line, length)
                          : entry_is_refused(reading, line);
}

/* fgets for inih: the next line, without CR and with LF; NULL at the end and after a mistake. */
static char *next_line(char *line, int room, void *context) {
    reading_t *const reading = context;
    if (reading->is_refused || reading->at == reading->length) {
        return NULL;
    }
    const char *const start = reading->text + reading->at;
    const size_t left = reading->length - reading->at;
    const char *const feed = memchr(start, '\n', left);
    size_t length = feed != NULL ? (size_t)(feed - start) : left;
    reading->at += feed != NULL ? length + 1 : length;
    reading->place.line++;
    if (feed != NULL && length > 0 && start[length - 1] == '\r') {
        length--;
    }
    reading->is_refused = true;
    if (text_is_refused(reading, start, length, room)) {
        return NULL;
    }
    memcpy(line, start, length);
    line[length] = '\0';
    reading->is_refused = line_is_refused(reading, line, length);
    line[length] = '\n';
    line[length + 1] = '\0';
    return reading->is_refused ? NULL : line;
}

static int take_entry(void *context, const char *section, const char *key, const char *value) {
    reading_t *const reading = context;
    const scenario_entry_t entry = {section, key, value};
    if (!reading->is_refused) {
        reading->is_refused =
            !reading->taker->take(reading->taker->context, &reading->place, &entry);
    }
    return reading->is_refused ? 0 : 1;
}

bool scenario_ini_read(const char *text, size_t length, const char *name,
                       const scenario_taker_t *taker, FILE *messages) {
    reading_t reading = {text, length, 0, {name, 0, messages}, taker, false, {false}};
    if (length > SCENARIO_SIZE_MAX) {
        scenario_complain(&reading.place, NULL, "%zu bytes; a scenario has at most %u", length,
                          SCENARIO_SIZE_MAX);
        return false;
    }
    const int fault = ini_parse_stream(next_line, &reading, take_entry, &reading);
    if (fault != 0 && !reading.is_refused) {
        scenario_complain(&reading.place, NULL, "inih cannot take line %d apart", fault);
    }
    return fault == 0 && !reading.is_refused;
}
