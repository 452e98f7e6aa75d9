# SPDX-License-Identifier: MIT
# Unity: the tree tools/setup put there, otherwise from its repository.
if(NOT FETCHCONTENT_SOURCE_DIR_UNITY AND EXISTS ${PROJECT_SOURCE_DIR}/build/unity)
    set(FETCHCONTENT_SOURCE_DIR_UNITY ${PROJECT_SOURCE_DIR}/build/unity CACHE PATH "")
endif()
include(FetchContent)
FetchContent_Declare(unity
    GIT_REPOSITORY https://github.com/ThrowTheSwitch/Unity.git
    GIT_TAG v2.6.1)
FetchContent_MakeAvailable(unity)
if(NOT TARGET unity) # Debian's copy of Unity comes without a CMakeLists.txt
    add_library(unity STATIC ${unity_SOURCE_DIR}/src/unity.c)
    target_include_directories(unity PUBLIC ${unity_SOURCE_DIR}/src)
endif()
target_compile_definitions(unity PUBLIC UNITY_INCLUDE_DOUBLE UNITY_SUPPORT_64)
set_target_properties(unity PROPERTIES INTERFACE_SYSTEM_INCLUDE_DIRECTORIES
    "$<TARGET_PROPERTY:unity,INTERFACE_INCLUDE_DIRECTORIES>")
