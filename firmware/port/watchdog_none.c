/* SPDX-License-Identifier: MIT */
/* watchdog_none.c - for boards whose watchdog nobody has written yet, and for emulators without one. */
#include "watchdog.h"

void port_watchdog_start(uint32_t cycles) {
    (void)cycles;
}

void port_watchdog_feed(void) {
}
