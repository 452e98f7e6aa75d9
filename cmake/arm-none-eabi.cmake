# SPDX-License-Identifier: MIT
# What all Arm targets share: gcc-arm-none-eabi with picolibc. Expects belt_processor (flags), belt_memory
# (flash and RAM: origin and size of each) and belt_emulator (QEMU and its board) to be set.
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(belt_emulator qemu-system-arm ${belt_emulator})
set(belt_processor "-mthumb ${belt_processor}")
include(${CMAKE_CURRENT_LIST_DIR}/bare_metal.cmake)
