# SPDX-License-Identifier: MIT
# What all RISC-V targets share: gcc-riscv64-unknown-elf with picolibc, QEMU's board virt. Expects
# belt_processor (flags) and belt_emulator (which QEMU) to be set.
set(CMAKE_SYSTEM_PROCESSOR riscv)
set(CMAKE_C_COMPILER riscv64-unknown-elf-gcc)
set(belt_memory 0x80000000 0x200000 0x80200000 0x200000)
# QEMU counts a cycle a nanosecond.
set(belt_board_clock 1000000000)
set(belt_emulator ${belt_emulator} -M virt -bios none)
include(${CMAKE_CURRENT_LIST_DIR}/bare_metal.cmake)
