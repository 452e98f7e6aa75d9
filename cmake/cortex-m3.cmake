# SPDX-License-Identifier: MIT
# Cortex-M3, no FPU (STM32F1); board MPS2 AN385.
set(belt_processor "-mcpu=cortex-m3 -mfloat-abi=soft")
set(belt_memory 0 0x400000 0x20000000 0x400000)
set(belt_board_clock 25000000)
set(belt_board_watchdog 0x40008000)
set(belt_emulator -M mps2-an385)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
