/* SPDX-License-Identifier: MIT */
/*
 * watchdog.h - what the periodic task's board wants of a watchdog. One file per kind has it:
 * watchdog_cmsdk.c for that of Arm's Cortex-M System Design Kit, watchdog_none.c where there is none.
 */
#ifndef PORT_WATCHDOG_H
#define PORT_WATCHDOG_H

#include <stdint.h>

/** Starts the watchdog: it resets the chip once it has not been fed for `cycles` of PORT_CLOCK. */
void port_watchdog_start(uint32_t cycles);

void port_watchdog_feed(void);

#endif
