# SPDX-License-Identifier: MIT
# RISC-V of 32 bits, no FPU (GD32VF103, ESP32-C3).
set(belt_processor "-march=rv32imac -mabi=ilp32")
set(belt_emulator qemu-system-riscv32)
include(${CMAKE_CURRENT_LIST_DIR}/riscv64-unknown-elf.cmake)
