# SPDX-License-Identifier: MIT
# A processor without operating system: picolibc's start-up code, linker script and semihosting, and the
# emulator that runs what was built. Only the programs for emulated boards use these; libbelt.a itself
# needs memset and memcpy alone.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)

set(CMAKE_C_FLAGS_INIT "${belt_processor} -ffunction-sections -fdata-sections --specs=picolibc.specs")

set(CMAKE_EXE_LINKER_FLAGS_INIT "--oslib=semihost --crt0=semihost -Wl,--gc-sections")
if(NOT belt_stack_size)
    set(belt_stack_size 0x1000)
endif()
set(belt_symbols __flash __flash_size __ram __ram_size __stack_size)
set(belt_numbers ${belt_memory} ${belt_stack_size})
foreach(symbol value IN ZIP_LISTS belt_symbols belt_numbers)
    string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,--defsym=${symbol}=${value}")
endforeach()

set(CMAKE_CROSSCOMPILING_EMULATOR ${belt_emulator}
    -nographic -monitor none -serial none -semihosting-config enable=on,target=native -kernel)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
