# SPDX-License-Identifier: MIT
# Cortex-M7 with FPU in double precision (STM32F7, H7); board MPS2 AN500.
set(belt_processor "-mcpu=cortex-m7 -mfloat-abi=hard -mfpu=fpv5-d16")
set(belt_memory 0 0x400000 0x20000000 0x400000)
set(belt_board_clock 25000000)
set(belt_board_watchdog 0x40008000)
set(belt_emulator -M mps2-an500)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
