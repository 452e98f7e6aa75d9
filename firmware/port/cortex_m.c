/* SPDX-License-Identifier: MIT */
/*
 * cortex_m.c - any Cortex-M: SysTick is the timer, and the counter of cycles too, since it counts those
 * of the core. Name the handler as the start-up code's vector table does (PORT_SYSTICK_HANDLER):
 * SysTick_Handler in CMSIS, arm_systick_isr in picolibc.
 */
#include "port.h"
#include "task.h"

#ifndef PORT_SYSTICK_HANDLER
#define PORT_SYSTICK_HANDLER SysTick_Handler
#endif

#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))
#define SYSTICK_CONTROL REGISTER(0xE000E010u)
#define SYSTICK_RELOAD REGISTER(0xE000E014u)
#define SYSTICK_VALUE REGISTER(0xE000E018u)
#define ENABLE 1u
#define INTERRUPT 2u
#define CORE_CLOCK 4u
#define RELOAD_MAX 0x00FFFFFFu

/* Cycles of all whole periods. */
static volatile uint32_t passed;

void PORT_SYSTICK_HANDLER(void);

void PORT_SYSTICK_HANDLER(void) {
    passed = passed + SYSTICK_RELOAD + 1u;
    task_tick();
}

bool port_start(uint32_t cycles) {
    if ((cycles < 2u) || (cycles - 1u > RELOAD_MAX)) {
        return false;
    }
    SYSTICK_RELOAD = cycles - 1u;
    SYSTICK_VALUE = 0;
    SYSTICK_CONTROL = ENABLE | INTERRUPT | CORE_CLOCK;
    return true;
}

uint32_t port_cycles(void) {
    uint32_t before;
    uint32_t within;
    do {
        before = passed;
        within = SYSTICK_RELOAD - SYSTICK_VALUE;
    } while (before != passed);
    return before + within;
}

/* A masked interrupt ends WFI all the same, so none is slept through. */
void port_sleep_while(const volatile uint32_t *count, uint32_t value) {
    __asm__ volatile("cpsid i" ::: "memory");
    if (*count == value) {
        __asm__ volatile("wfi" ::: "memory");
    }
    __asm__ volatile("cpsie i" ::: "memory");
}
