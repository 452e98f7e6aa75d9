/* SPDX-License-Identifier: MIT */
/*
 * channel_core.c - the channels of a program on the simulated core of core_bench.cpp, and the counts of
 * its steps: a few addresses that the bench answers. All messages are whole words.
 */
#include "channel_port.h"

#include <stdint.h>

#include "server_counts.h"

#define DEVICE(offset) (*(volatile uint32_t *)(uintptr_t)(0xF0000000u + (offset)))
#define REQUEST_NEXT DEVICE(0u)
#define REQUEST_LEFT DEVICE(4u)
#define REPLY_NEXT DEVICE(8u)
#define COUNT_NEXT DEVICE(12u)
#define EXIT DEVICE(16u)

#define WITH_CSR(instruction) ".option push\n.option arch, +zicsr\n" instruction "\n.option pop"

enum { REQUESTS, REPLIES };

static uint32_t cycles;
static uint32_t instructions;

int channel_port_open(const char *name, bool is_written) {
    (void)name;
    return is_written ? REPLIES : REQUESTS;
}

size_t channel_port_read(int channel, void *bytes, size_t size) {
    uint32_t *const word = bytes;
    const size_t left = (channel == REQUESTS) ? REQUEST_LEFT : 0;
    const size_t count = (size / sizeof *word < left) ? size / sizeof *word : left;
    for (size_t i = 0; i < count; ++i) {
        word[i] = REQUEST_NEXT;
    }
    return count * sizeof *word;
}

bool channel_port_write(int channel, const void *bytes, size_t size) {
    const uint32_t *const word = bytes;
    for (size_t i = 0; i < size / sizeof *word; ++i) {
        REPLY_NEXT = word[i];
    }
    return channel == REPLIES;
}

__attribute__((noinline)) void server_before_step(void) {
    __asm__ volatile(WITH_CSR("csrw 0x320, zero")); /* both counters count */
    __asm__ volatile(WITH_CSR("csrr %0, minstret") : "=r"(instructions));
    __asm__ volatile(WITH_CSR("csrr %0, mcycle") : "=r"(cycles));
}

__attribute__((noinline)) void server_after_step(void) {
    uint32_t cycles_now;
    uint32_t instructions_now;
    __asm__ volatile(WITH_CSR("csrr %0, mcycle") : "=r"(cycles_now));
    __asm__ volatile(WITH_CSR("csrr %0, minstret") : "=r"(instructions_now));
    COUNT_NEXT = cycles_now - cycles;
    COUNT_NEXT = instructions_now - instructions;
}

/* picolibc's start-up asks for the words of a command; here are none. */
int sys_semihost_get_cmdline(char *text, int size);

int sys_semihost_get_cmdline(char *text, int size) {
    (void)text;
    (void)size;
    return -1;
}

void _exit(int code);

void _exit(int code) {
    for (;;) {
        EXIT = (uint32_t)code;
    }
}
