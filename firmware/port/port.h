/* SPDX-License-Identifier: MIT */
/*
 * port.h - what the periodic task wants of a processor. One file per architecture has it: cortex_m.c by
 * SysTick, riscv.c by mtime. A board whose control timer is another one writes these three functions.
 */
#ifndef PORT_PORT_H
#define PORT_PORT_H

#include <stdbool.h>
#include <stdint.h>

/** Frequency of the processor's counter of cycles and of its timer [1/s]. The board's clock tree sets
 * them, so the build states them: PORT_CLOCK. */
#ifndef PORT_CLOCK
#define PORT_CLOCK 25000000u
#endif

/** Starts the timer: from now on an interrupt calls task_tick() every `cycles` of it. False: the timer
 * cannot count so far. */
bool port_start(uint32_t cycles);

/** A counter of cycles that wraps. What it counts on each processor says its file; on a chip with a
 * better one (DWT_CYCCNT, say) this is the one function to exchange. */
uint32_t port_cycles(void);

/** Sleeps until an interrupt comes, unless one has changed `count` from `value` already. */
void port_sleep_while(const volatile uint32_t *count, uint32_t value);

#endif
