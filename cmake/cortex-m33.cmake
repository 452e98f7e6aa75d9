# SPDX-License-Identifier: MIT
# Cortex-M33 with FPU (STM32L5, U5; nRF53); board MPS2 AN505.
set(belt_processor "-mcpu=cortex-m33 -mfloat-abi=hard -mfpu=fpv5-sp-d16")
set(belt_memory 0x10000000 0x400000 0x38000000 0x400000)
set(belt_board_clock 20000000)
set(belt_board_watchdog 0x50081000)
set(belt_emulator -M mps2-an505)
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
