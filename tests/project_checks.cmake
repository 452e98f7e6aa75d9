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
    BELT_SIM_PAPERS_LAWS=${builds}/host/belt_sim_papers_laws
    BELT_SIM_NONLINEAR_REWORK=${builds}/host/belt_sim_nonlinear_rework
    BELT_SIM_OTHER_LAWS=${builds}/host/belt_sim_other_laws
    BELT_SIM_UNAWARE=${builds}/host/belt_sim_unaware
    BELT_REPLAY=${builds}/host/belt_replay
    BELT_REPLAY_F64=${builds}/host-f64/belt_replay
    BELT_WALK=${builds}/host/belt_walk
    BELT_MISMATCH=${builds}/host/belt_mismatch)

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
belt_add_pytest(laws)
belt_add_pytest(target)
belt_add_pytest(assurance)
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
belt_add_check(misra)
belt_add_check(clang_tidy)
belt_add_check(gcc_analyzer)
belt_add_check(complexity)
belt_add_check(no_statics --library $<TARGET_FILE:belt>)
belt_add_check(readme_example
    --library $<TARGET_FILE:belt>
    --work-dir ${PROJECT_BINARY_DIR}
    --
    ${CMAKE_C_COMPILER} -std=c99
    $<TARGET_PROPERTY:belt_compile_rules,INTERFACE_COMPILE_OPTIONS>
    "-D$<JOIN:$<TARGET_PROPERTY:belt,INTERFACE_COMPILE_DEFINITIONS>,$<SEMICOLON>-D>"
    "-I$<TARGET_PROPERTY:belt,INTERFACE_INCLUDE_DIRECTORIES>")

# Every harness of tests/fuzz, ten million inputs in all, most of them where they are quick.
function(belt_add_fuzz target runs)
    add_test(NAME fuzz/${target}
        COMMAND ${PROJECT_SOURCE_DIR}/tools/fuzz --no-build --target ${target} --runs ${runs})
    set_tests_properties(fuzz/${target} PROPERTIES TIMEOUT 3600 COST 900)
endfunction()
belt_add_fuzz(step 4000000)
belt_add_fuzz(config 4500000)
belt_add_fuzz(scenario 1200000)
belt_add_fuzz(snapshot 300000)

# Some mutants, always the same; tools/assure judges all of them.
add_test(NAME mutation/sample
    COMMAND ${PROJECT_SOURCE_DIR}/tools/mutate --sample 40 --seed 1 --require 80 --list-survivors)
add_test(NAME coverage
    COMMAND ${PROJECT_SOURCE_DIR}/tools/coverage --missing --require 100 100 95)
set_tests_properties(mutation/sample coverage PROPERTIES
    TIMEOUT 3600 COST 800 PROCESSORS 2)
