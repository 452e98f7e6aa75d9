# SPDX-License-Identifier: MIT
# Cortex-M0, no FPU (STM32F0, nRF51); board micro:bit, 16 kB of RAM.
set(belt_processor "-mcpu=cortex-m0 -mfloat-abi=soft")
set(belt_memory 0 0x40000 0x20000000 0x4000)
set(belt_stack_size 0x500)
set(BELT_BOARD_IS_SMALL ON)
set(belt_board_clock 16000000)
set(belt_emulator -M microbit)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
