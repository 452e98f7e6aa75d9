# SPDX-License-Identifier: MIT
# Cortex-M4 with FPU (STM32F4, nRF52); board MPS2 AN386.
set(belt_processor "-mcpu=cortex-m4 -mfloat-abi=hard -mfpu=fpv4-sp-d16")
set(belt_memory 0 0x400000 0x20000000 0x400000)
set(belt_board_clock 25000000)
set(belt_board_watchdog 0x40008000)
set(belt_emulator -M mps2-an386)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
