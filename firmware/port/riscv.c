/* SPDX-License-Identifier: MIT */
/*
 * riscv.c - RISC-V in machine mode with a CLINT: mtime is the timer, mcycle the counter of cycles.
 * PORT_CLINT and PORT_TIMER_CLOCK are the chip's; the defaults are those of QEMU's board virt.
 */
#include "port.h"
#include "task.h"

#ifndef PORT_CLINT
#define PORT_CLINT 0x02000000u
#endif
/* Frequency of mtime [1/s]. */
#ifndef PORT_TIMER_CLOCK
#define PORT_TIMER_CLOCK 10000000u
#endif

#define COMPARE ((volatile uint32_t *)(uintptr_t)(PORT_CLINT + 0x4000u))
#define NOW ((volatile uint32_t *)(uintptr_t)(PORT_CLINT + 0xBFF8u))
#define TIMER_INTERRUPT 0x80u /* in mie */
#define INTERRUPTS 0x8u       /* in mstatus */

/* gcc -march=rv32imac knows no control registers, and with their name in it takes other libraries. */
#define WITH_CSR(instruction) ".option push\n.option arch, +zicsr\n" instruction "\n.option pop"

static uint64_t next;
static uint32_t ticks;

static uint64_t now(void) {
    uint32_t high;
    uint32_t low;
    do {
        high = NOW[1];
        low = NOW[0];
    } while (high != NOW[1]);
    return ((uint64_t)high << 32) | low;
}

static void compare_with(uint64_t time) {
    COMPARE[1] = 0xFFFFFFFFu; /* never in between */
    COMPARE[0] = (uint32_t)time;
    COMPARE[1] = (uint32_t)(time >> 32);
}

/* The only interrupt that is on. */
__attribute__((interrupt("machine"), aligned(4))) static void on_timer(void) {
    next += ticks;
    compare_with(next);
    task_tick();
}

static void mask_interrupts(void) {
    __asm__ volatile(WITH_CSR("csrc mstatus, %0")::"r"(INTERRUPTS) : "memory");
}

static void allow_interrupts(void) {
    __asm__ volatile(WITH_CSR("csrs mstatus, %0")::"r"(INTERRUPTS) : "memory");
}

bool port_start(uint32_t cycles) {
    ticks = (uint32_t)((uint64_t)cycles * PORT_TIMER_CLOCK / PORT_CLOCK);
    if (ticks == 0u) {
        return false;
    }
    next = now() + ticks;
    compare_with(next);
    __asm__ volatile(WITH_CSR("csrw mtvec, %0")::"r"(&on_timer));
    __asm__ volatile(WITH_CSR("csrs mie, %0")::"r"(TIMER_INTERRUPT));
    allow_interrupts();
    return true;
}

uint32_t port_cycles(void) {
    unsigned long cycles;
    __asm__ volatile(WITH_CSR("csrr %0, mcycle") : "=r"(cycles));
    return (uint32_t)cycles;
}

/* A masked interrupt ends WFI all the same, so none is slept through. */
void port_sleep_while(const volatile uint32_t *count, uint32_t value) {
    mask_interrupts();
    if (*count == value) {
        __asm__ volatile("wfi" ::: "memory");
    }
    allow_interrupts();
}
