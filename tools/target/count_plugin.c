/* SPDX-License-Identifier: MIT */
/*
 * count_plugin.c - a plugin for QEMU that counts the instructions of each call of one function.
 *
 *     -plugin count_plugin.so,begin=ADDRESS,caller=ADDRESS,caller_end=ADDRESS,out=FILE
 *
 * A call lasts from the instruction at `begin` until one of its caller runs again, which lies in
 * caller ... caller_end; whatever runs between belongs to it, the compiler's own routines too. FILE gets
 * a line `call COUNT LEAPS` for each, in order, and at the end a line `at ADDRESS COUNT` for each
 * instruction that ran in any of them. A leap goes elsewhere than to the next instruction: a branch that
 * is taken, a call, a return, that of the function itself included.
 *
 * What is counted are blocks of instructions, when they begin: no block is left before its end, as
 * nothing but a fault or an interrupt could do that. On Arm an instruction that IT skips counts.
 *
 * Debian's QEMU takes plugins but ships no header: what is used of it is declared here, as
 * qemu-plugin.h has it since version 1 of that interface.
 */
#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef struct qemu_info_t qemu_info_t;

extern void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id,
                                                  void (*seen)(qemu_plugin_id_t id,
                                                               struct qemu_plugin_tb *block));
extern void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *block,
                                                 void (*begins)(unsigned cpu, void *data),
                                                 int registers, void *data);
extern void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id,
                                           void (*ends)(qemu_plugin_id_t id, void *data),
                                           void *data);
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *block);
extern struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *block,
                                                        size_t index);
extern uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *instruction);
extern size_t qemu_plugin_insn_size(const struct qemu_plugin_insn *instruction);

extern int qemu_plugin_version;
int qemu_plugin_version = 1;
int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int argument_count,
                        char **argument);

typedef struct block {
    struct block *next;
    uint64_t runs; /**< within calls. */
    uint64_t end;  /**< address behind it. */
    size_t count;
    uint64_t address[];
} block_t;

typedef struct {
    uint64_t begin;
    uint64_t caller;
    uint64_t caller_end;
    FILE *out;
    block_t *blocks;
    bool is_counting;
    uint64_t count;
    uint64_t leaps;
    uint64_t next; /**< where it goes on without a leap. */
} counter_t;

static counter_t counter;

static void begins(unsigned cpu, void *data) {
    block_t *const block = data;
    const uint64_t address = block->address[0];
    (void)cpu;
    counter.leaps += (address != counter.next) ? 1u : 0u;
    counter.next = block->end;
    if (address == counter.begin) {
        counter.is_counting = true;
        counter.count = 0;
        counter.leaps = 0;
    } else if (counter.is_counting && (address >= counter.caller) &&
               (address < counter.caller_end)) {
        counter.is_counting = false;
        fprintf(counter.out, "call %" PRIu64 " %" PRIu64 "\n", counter.count, counter.leaps);
    }
    if (counter.is_counting) {
        counter.count += block->count;
        block->runs += 1;
    }
}

static void seen(qemu_plugin_id_t id, struct qemu_plugin_tb *translated) {
    const size_t count = qemu_plugin_tb_n_insns(translated);
    block_t *const block = malloc(sizeof *block + count * sizeof block->address[0]);
    (void)id;
    if (block == NULL) {
        abort();
    }
    block->next = counter.blocks;
    block->runs = 0;
    block->end = 0;
    block->count = count;
    for (size_t i = 0; i < count; ++i) {
        const struct qemu_plugin_insn *const instruction = qemu_plugin_tb_get_insn(translated, i);
        block->address[i] = qemu_plugin_insn_vaddr(instruction);
        block->end = block->address[i] + qemu_plugin_insn_size(instruction);
    }
    counter.blocks = block;
    qemu_plugin_register_vcpu_tb_exec_cb(translated, begins, 0, block);
}

static void ends(qemu_plugin_id_t id, void *data) {
    (void)id;
    (void)data;
    for (const block_t *block = counter.blocks; block != NULL; block = block->next) {
        for (size_t i = 0; (i < block->count) && (block->runs > 0); ++i) {
            fprintf(counter.out, "at %#" PRIx64 " %" PRIu64 "\n", block->address[i], block->runs);
        }
    }
    if (fclose(counter.out) != 0) {
        abort(); /* a count that is not on the disk is none */
    }
}

/** The text behind `name=`, or NULL. */
static const char *value_of(int argument_count, char **argument, const char *name) {
    const size_t length = strlen(name);
    for (int i = 0; i < argument_count; ++i) {
        if ((strncmp(argument[i], name, length) == 0) && (argument[i][length] == '=')) {
            return argument[i] + length + 1;
        }
    }
    return NULL;
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int argument_count,
                        char **argument) {
    const char *const begin = value_of(argument_count, argument, "begin");
    const char *const caller = value_of(argument_count, argument, "caller");
    const char *const caller_end = value_of(argument_count, argument, "caller_end");
    const char *const out = value_of(argument_count, argument, "out");
    (void)info;
    if ((begin == NULL) || (caller == NULL) || (caller_end == NULL) || (out == NULL)) {
        fprintf(stderr, "count_plugin: wants begin, caller, caller_end and out\n");
        return 1;
    }
    counter.begin = strtoull(begin, NULL, 0);
    counter.caller = strtoull(caller, NULL, 0);
    counter.caller_end = strtoull(caller_end, NULL, 0);
    counter.out = fopen(out, "w");
    if (counter.out == NULL) {
        fprintf(stderr, "count_plugin: %s cannot be written\n", out);
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, seen);
    qemu_plugin_register_atexit_cb(id, ends, NULL);
    return 0;
}
