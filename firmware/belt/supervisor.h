/* SPDX-License-Identifier: MIT */
/*
 * supervisor.h - who is in command, and the command's limits.
 *
 * modes.h has the modes and the table of all changes between them. A change that touches off is made
 * at once; every other one starts from the last command and goes over with transfer_time, so that
 * the valve does not jump. On top of it all the command keeps its limit and its rate limit in every
 * mode: a closed line, too, is closed at that rate.
 *
 * Cost: about 60 instructions.
 */
#ifndef BELT_SUPERVISOR_H
#define BELT_SUPERVISOR_H

#include "command.h"
#include "measurement.h"

typedef struct {
    belt_mode_t requested;   /**< what the operator asks for: off, manual or automatic. */
    belt_real_t manual_flux; /**< the operator's; begins with the command in force when manual
                                  is asked for [parts/s]. */
    belt_real_t bump;        /**< what is left between the last mode's command and this one's
                                  [parts/s]. */
} belt_supervisor_t;

/** Automatic is asked for, off is the mode until the first step. */
void belt_supervisor_init(belt_supervisor_t *supervisor);

/** What moves the modes in this period. */
belt_event_t belt_supervisor_event(const belt_supervisor_t *supervisor, belt_level_health_t health);

/** Next mode and command from the last ones; `law_flux` is what the law asks for [parts/s]. Leaves
 * error_bits alone. */
void belt_supervisor_decide(belt_supervisor_t *supervisor, belt_command_t *command,
                            const belt_limits_t *limits, belt_event_t event, belt_real_t law_flux);

#endif
