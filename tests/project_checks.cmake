# SPDX-License-Identifier: MIT
# Tests of the project as a whole rather than of one build; for the preset host only.
set(builds ${PROJECT_SOURCE_DIR}/build)
set(python ${builds}/venv/bin/python)
set(checks ${PROJECT_SOURCE_DIR}/tools/checks)

set(pytest_environment
    PYTHONPATH=${PROJECT_SOURCE_DIR}
    MPLBACKEND=Agg
    HYPOTHESIS_STORAGE_DIRECTORY=${builds}/hypothesis
    BELT_SIM=${builds}/host/belt_sim
    BELT_SIM_F64=${builds}/host-f64/belt_sim
    BELT_SIM_SANITIZE=${builds}/sanitize/belt_sim
    BELT_REPLAY=${builds}/host/belt_replay
    BELT_REPLAY_F64=${builds}/host-f64/belt_replay)

# Where pytest finds no test it exits with 5, which fails the test here too.
# COST: ctest starts the long ones first.
function(belt_add_pytest name)
    add_test(NAME ${name}
        COMMAND ${python} -m pytest tests/${name}
        WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    set_tests_properties(${name} PROPERTIES
        TIMEOUT 3600
        COST 1000
        ENVIRONMENT "${pytest_environment}")
endfunction()
belt_add_pytest(reference)
belt_add_pytest(system)
belt_add_pytest(checks)

# Each check is a script that is told the root to look at; tests/checks shows every one of them to
# fail on a planted violation.
function(belt_add_check name)
    add_test(NAME style/${name}
        COMMAND ${python} ${checks}/${name}.py --root ${PROJECT_SOURCE_DIR} ${ARGN}
        COMMAND_EXPAND_LISTS)
    set_tests_properties(style/${name} PROPERTIES TIMEOUT ${BELT_TEST_TIMEOUT})
endfunction()
belt_add_check(include_rules)
belt_add_check(forbidden_words)
belt_add_check(spdx)
belt_add_check(format)
belt_add_check(cppcheck)
belt_add_check(no_statics --library $<TARGET_FILE:belt>)
belt_add_check(readme_example
    --library $<TARGET_FILE:belt>
    --work-dir ${PROJECT_BINARY_DIR}
    --
    ${CMAKE_C_COMPILER} -std=c99
    $<TARGET_PROPERTY:belt_compile_rules,INTERFACE_COMPILE_OPTIONS>
    "-D$<JOIN:$<TARGET_PROPERTY:belt,INTERFACE_COMPILE_DEFINITIONS>,$<SEMICOLON>-D>"
    "-I$<TARGET_PROPERTY:belt,INTERFACE_INCLUDE_DIRECTORIES>")
