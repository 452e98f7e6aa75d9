/* SPDX-License-Identifier: MIT */
#include "scenario_text.h"

/* Forms of a character in UTF-8: how many bytes follow the first, and the range its value must
 * have. The lower limits refuse overlong forms; the two-byte one refuses the C1 controls too. */
typedef struct {
    unsigned char mask;
    unsigned char lead;
    size_t following;
    unsigned long least;
    unsigned long greatest;
} form_t;

static const form_t FORMS[] = {
    {0x80u, 0x00u, 0, 0x20ul, 0x7Eul},
    {0xE0u, 0xC0u, 1, 0xA0ul, 0x7FFul},
    {0xF0u, 0xE0u, 2, 0x800ul, 0xFFFFul},
    {0xF8u, 0xF0u, 3, 0x10000ul, 0x10FFFFul},
};

/* Bytes of the character that starts at `text`, 0 when no valid one does. */
static size_t character_length(const unsigned char *text, size_t left) {
    for (size_t index = 0; index < sizeof FORMS / sizeof FORMS[0]; index++) {
        const form_t *form = &FORMS[index];
        if ((text[0] & form->mask) != form->lead) {
            continue;
        }
        if (form->following >= left) {
            return 0;
        }
        unsigned long character = text[0] & (unsigned long)(unsigned char)~form->mask;
        for (size_t byte = 1; byte <= form->following; byte++) {
            if ((text[byte] & 0xC0u) != 0x80u) {
                return 0;
            }
            character = (character << 6) | (text[byte] & 0x3Ful);
        }
        const int is_surrogate = character >= 0xD800ul && character <= 0xDFFFul;
        const int is_mark = character == 0xFEFFul;
        const int in_range = character >= form->least && character <= form->greatest;
        return in_range && !is_surrogate && !is_mark ? form->following + 1 : 0;
    }
    return 0;
}

size_t scenario_text_fault(const char *text, size_t length) {
    const unsigned char *bytes = (const unsigned char *)text;
    size_t at = 0;
    while (at < length) {
        const size_t step = bytes[at] == '\t' ? 1 : character_length(bytes + at, length - at);
        if (step == 0) {
            return at;
        }
        at += step;
    }
    return length;
}
