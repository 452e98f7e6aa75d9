/* SPDX-License-Identifier: MIT */
/*
 * watchdog_cmsdk.c - the watchdog of Arm's Cortex-M System Design Kit; PORT_WATCHDOG is its address. It
 * counts down twice: the first time ends in an NMI, whose handler may still bring the actuator to rest,
 * the second in the reset.
 */
#include "watchdog.h"

#define REGISTER(offset) (*(volatile uint32_t *)(uintptr_t)(PORT_WATCHDOG + (offset)))
#define LOAD REGISTER(0x000u)
#define CONTROL REGISTER(0x008u)
#define CLEAR REGISTER(0x00Cu)
#define LOCK REGISTER(0xC00u)
#define UNLOCKED 0x1ACCE551u
#define COUNT 1u
#define RESET 2u

void port_watchdog_start(uint32_t cycles) {
    LOCK = UNLOCKED;
    LOAD = (cycles / 2u) + 1u;
    CONTROL = COUNT | RESET;
    LOCK = 0;
}

/* The count begins anew with it. Locked again at once: a task that runs wild seldom unlocks. */
void port_watchdog_feed(void) {
    LOCK = UNLOCKED;
    CLEAR = 1u;
    LOCK = 0;
}
