/* SPDX-License-Identifier: MIT */
/*
 * core_bench.cpp - the processor core CV32E40P in Verilator, with a flat memory that answers in the next
 * cycle, and the addresses of channel_core.c. core_bench PROGRAM REQUESTS REPLIES COUNTS: a program as it
 * lies in memory; words to read; words written. Exit: the program's own, or 2.
 */
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "Vcv32e40p_top.h"
#include "verilated.h"

namespace {

constexpr uint32_t memory_begin = 0x80000000u;
constexpr uint32_t memory_size = 0x00400000u;
constexpr uint32_t device = 0xF0000000u;
constexpr uint64_t cycles_max = 4000000000u; // it hangs

std::vector<uint32_t> memory(memory_size / 4);
std::vector<uint32_t> requests;
size_t next_request;
FILE *replies;
FILE *counts;
int exit_code = -1;

void fail(const char *what, uint32_t address = 0) {
    std::fprintf(stderr, "core_bench: %s (%#lx)\n", what, static_cast<unsigned long>(address));
    std::exit(2);
}

std::vector<uint32_t> read_words(const char *name) {
    std::vector<uint32_t> words;
    uint32_t word = 0;
    FILE *const file = std::fopen(name, "rb");
    if (file == nullptr) {
        fail("a file cannot be read");
    }
    while (std::fread(&word, 1, sizeof word, file) > 0) {
        words.push_back(word);
        word = 0;
    }
    std::fclose(file);
    return words;
}

void write_word(FILE *file, uint32_t word) {
    if (std::fwrite(&word, sizeof word, 1, file) != 1) {
        fail("a file cannot be written");
    }
}

uint32_t load(uint32_t address) {
    if (address - memory_begin < memory_size) {
        return memory[(address - memory_begin) / 4];
    }
    if (address == device) {
        return (next_request < requests.size()) ? requests[next_request++] : 0;
    }
    if (address == device + 4) {
        return static_cast<uint32_t>(requests.size() - next_request);
    }
    fail("the program read where nothing is", address);
    return 0;
}

void store(uint32_t address, uint32_t value, uint32_t bytes) {
    uint32_t mask = 0;
    for (unsigned i = 0; i < 4; ++i) {
        mask |= ((bytes >> i) & 1u) ? (0xFFu << (8 * i)) : 0;
    }
    if (address - memory_begin < memory_size) {
        uint32_t &word = memory[(address - memory_begin) / 4];
        word = (word & ~mask) | (value & mask);
    } else if (address == device + 8) {
        write_word(replies, value);
    } else if (address == device + 12) {
        write_word(counts, value);
    } else if (address == device + 16) {
        exit_code = static_cast<int>(value);
    } else {
        fail("the program wrote where nothing is", address);
    }
}

} // namespace

int main(int argument_count, char **argument) {
    if (argument_count != 5) {
        fail("usage: core_bench PROGRAM REQUESTS REPLIES COUNTS");
    }
    const std::vector<uint32_t> program = read_words(argument[1]);
    requests = read_words(argument[2]);
    replies = std::fopen(argument[3], "wb");
    counts = std::fopen(argument[4], "wb");
    if ((program.size() > memory.size()) || (replies == nullptr) || (counts == nullptr)) {
        fail("a file cannot be opened, or the program is too large");
    }
    std::copy(program.begin(), program.end(), memory.begin());

    Vcv32e40p_top core;
    core.boot_addr_i = memory_begin;
    core.mtvec_addr_i = memory_begin;
    core.instr_gnt_i = 1;
    core.data_gnt_i = 1;
    core.fetch_enable_i = 1;
    core.rst_ni = 1; // the divider wants to see it fall
    core.eval();
    core.rst_ni = 0;
    for (uint64_t cycle = 0; (exit_code < 0) && (cycle < cycles_max); ++cycle) {
        core.clk_i = 0;
        core.eval();
        // What is asked for before the edge is answered behind it.
        const bool fetches = core.instr_req_o;
        const bool moves = core.data_req_o;
        const uint32_t fetched = fetches && core.rst_ni ? load(core.instr_addr_o & ~3u) : 0;
        uint32_t loaded = 0;
        if (moves && core.data_we_o) {
            store(core.data_addr_o & ~3u, core.data_wdata_o, core.data_be_o);
        } else if (moves) {
            loaded = load(core.data_addr_o & ~3u);
        }
        core.clk_i = 1;
        core.eval();
        core.instr_rvalid_i = fetches;
        core.instr_rdata_i = fetched;
        core.data_rvalid_i = moves;
        core.data_rdata_i = loaded;
        core.rst_ni = cycle >= 3;
    }
    if ((std::fclose(replies) != 0) || (std::fclose(counts) != 0)) {
        fail("a file cannot be written");
    }
    return (exit_code < 0) ? 2 : exit_code;
}
