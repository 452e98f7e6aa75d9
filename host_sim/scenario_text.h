/* SPDX-License-Identifier: MIT */
/*
 * scenario_text.h - what may stand in a line of a scenario before anything takes it apart.
 */
#ifndef HOST_SIM_SCENARIO_TEXT_H
#define HOST_SIM_SCENARIO_TEXT_H

#include <stddef.h>

/** What separates words within a line. */
#define SCENARIO_BLANKS " \t"

/** Offset of the first byte that is no text, `length` when there is none: text is valid UTF-8
 * without control characters (C0 but tab, DEL, C1) and without byte order marks. */
size_t scenario_text_fault(const char *text, size_t length);

#endif
