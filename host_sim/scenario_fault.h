/* SPDX-License-Identifier: MIT */
/*
 * scenario_fault.h - the text of a fault, `signal:word[=value]@start+length`, becomes a fault.
 */
#ifndef HOST_SIM_SCENARIO_FAULT_H
#define HOST_SIM_SCENARIO_FAULT_H

#include <stdbool.h>

#include "fault.h"
#include "scenario_message.h"
#include "scenario_slice.h"

/** Reads one fault. Returns false after a message that names the part, and what it must be; `fault` is
 * then untouched. */
bool scenario_fault_read(scenario_slice_t text, const scenario_place_t *place,
                         const scenario_entry_t *entry, fault_t *fault);

#endif
