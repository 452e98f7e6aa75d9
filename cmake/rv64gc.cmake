# SPDX-License-Identifier: MIT
# RISC-V of 64 bits with FPU in double precision (SiFive U74 and such).
set(belt_processor "-march=rv64imafdc -mabi=lp64d -mcmodel=medany")
set(belt_emulator qemu-system-riscv64)
include(${CMAKE_CURRENT_LIST_DIR}/riscv64-unknown-elf.cmake)
