# SPDX-License-Identifier: MIT
# RISC-V of 32 bits with FPU.
set(belt_processor "-march=rv32imafc -mabi=ilp32f")
set(BELT_BOARD_HAS_CORE ON)
set(belt_emulator qemu-system-riscv32)
include(${CMAKE_CURRENT_LIST_DIR}/riscv64-unknown-elf.cmake)
