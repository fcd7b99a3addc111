# SPDX-License-Identifier: Apache-2.0
# What tests/run.sh --all adds to the core suite, beside the sanitizers: everything here has the
# label `all`. What must be built for it is there with DEGS_ALL_TESTS only.

# degs_all_test(<name> [COST <s>] [ENVIRONMENT …] [EXPECT <regex>] COMMAND …): a test of the outer
# circle; EXPECT is what its output must match. Exit code 77 says that a tool of it is missing.
function(degs_all_test name)
    cmake_parse_arguments(ARG "" "COST;EXPECT" "ENVIRONMENT;COMMAND" ${ARGN})
    add_test(NAME ${name} COMMAND ${ARG_COMMAND})
    set_tests_properties(${name} PROPERTIES TIMEOUT 1800 SKIP_RETURN_CODE 77 LABELS all)
    foreach(property COST ENVIRONMENT)
        if(ARG_${property})
            set_property(TEST ${name} PROPERTY ${property} "${ARG_${property}}")
        endif()
    endforeach()
    if(ARG_EXPECT)
        set_property(TEST ${name} PROPERTY PASS_REGULAR_EXPRESSION "${ARG_EXPECT}")
    endif()
endfunction()

set(here ${CMAKE_CURRENT_SOURCE_DIR})
degs_all_test(packaging/Container COMMAND ${here}/packaging/container.sh ${PROJECT_SOURCE_DIR})
if(DEGS_ALL_TESTS AND TARGET rv32)
    # Programs in C on the core of examples/riscv and on the host.
    add_executable(run_program riscv/run_program.cpp)
    target_link_libraries(run_program PRIVATE rv32 degs_flags)
    degs_all_test(riscv/RandomPrograms COST 5 COMMAND /usr/bin/python3 ${here}/riscv/programs.py
                  --compare $<TARGET_FILE:run_program> ${PROJECT_SOURCE_DIR}/examples/riscv/firmware)
endif()

if(DEGS_ALL_TESTS AND TARGET degs_sim)
    add_subdirectory(${PROJECT_SOURCE_DIR}/examples/own-accelerator own-accelerator EXCLUDE_FROM_ALL)
    target_compile_options(row_sweep PRIVATE ${test_optimisation})
    # Random designs of the example, as tests/random draws those of this project.
    add_executable(degs_own_random_designs ${random_sources} examples/with_row_sweep.cpp)
    degs_random_program(degs_own_random_designs)
    target_link_libraries(degs_own_random_designs PRIVATE row_sweep)
    degs_all_test(random/OwnAccelerator COST 5 COMMAND degs_own_random_designs --designs 50 --seed 1 --attempts 60
                  --configs ${PROJECT_SOURCE_DIR}/examples/own-accelerator)
    degs_tests(examples DEPENDS row_sweep degs::accuracy LABEL all)
    target_compile_definitions(degs_examples_tests PRIVATE DEGS_PROGRAM="$<TARGET_FILE:own-degs>")
    add_dependencies(degs_examples_tests own-degs)
    # It configures the example outside and compiles its files; all of DeGS would take minutes, and
    # is built only with DEGS_SLOW_TESTS=1.
    degs_all_test(packaging/OwnAccelerator COST 30 COMMAND ${here}/packaging/own_accelerator.sh
                  ${PROJECT_BINARY_DIR} ${CMAKE_CXX_COMPILER})
endif()

if(DEGS_ALL_TESTS AND TARGET degs_program)
    add_subdirectory(bench)
    add_subdirectory(rtl)
    if(TARGET degs_rtl_models)
        degs_tests(rtl DEPENDS degs_rtl_models degs::tlm degs::splat COST 3 LABEL all)
        target_compile_definitions(degs_rtl_tests PRIVATE DEGS_PROGRAM="$<TARGET_FILE:degs_program>"
                                   DEGS_RTL_TABLES="${DEGS_RTL_TABLES}")
        add_dependencies(degs_rtl_tests degs_program)
    endif()
endif()

if(TARGET degs_program)
    set(program DEGS_PROGRAM=$<TARGET_FILE:degs_program>)
    set(scripts ${PROJECT_SOURCE_DIR}/scripts)
    set(configs ${PROJECT_SOURCE_DIR}/configs)
    # The draws after those of the core suite, in parts that run side by side.
    foreach(first 10 73 136)
        degs_all_test(random/Designs${first} COST 5
                      COMMAND degs_random_designs --designs 64 --first ${first} --seed 1 --attempts 60)
    endforeach()
    # One design that deadlocked at 4K; scripts/all_designs.sh runs the others, too.
    degs_all_test(sim/DesignAtEveryResolution COST 10 COMMAND ${scripts}/all_designs.sh
                  ENVIRONMENT ${program} DESIGNS=gscore-1024 SCENES=synthetic:object REFERENCE=no)
    degs_all_test(sim/PagesInChromium COST 60 COMMAND ${here}/sweep/pages.sh $<TARGET_FILE:degs_program> ${configs})
    degs_all_test(sim/JobArrayOnSlurm COST 60 COMMAND ${here}/sweep/slurm.sh $<TARGET_FILE:degs_program> ${configs})
    degs_all_test(sim/RecipesOfClusters COST 20
                  COMMAND ${here}/sweep/clusters.sh $<TARGET_FILE:degs_program> ${PROJECT_SOURCE_DIR})
    # Every measured table, made of tiny views, also of a path of cameras in small scenes.
    degs_all_test(docs/tables COST 30 COMMAND /usr/bin/python3 ${scripts}/measure.py --quick ENVIRONMENT ${program})
    # Advice for losses, on one small view.
    degs_all_test(sim/AdviceOfOneView COMMAND ${scripts}/advice.py ${configs}/gscore-64.yaml ${configs}/gcc-64.yaml
                  --scenes synthetic:object,gaussians=2000 --width 240 --jobs 1 --strict
                  EXPECT "holds.*gcc-64.*3 of 3 .design, view, loss, key. cases" ENVIRONMENT ${program})
endif()

if(DEGS_INSTALL)
    set(program "")
    if(TARGET degs_program)
        set(program $<TARGET_FILE:degs_program>)
        degs_all_test(packaging/RiscvPlatform COST 10 COMMAND ${here}/packaging/riscv.sh
                      ${PROJECT_BINARY_DIR} ${CMAKE_CXX_COMPILER} ${program})
    endif()
    degs_all_test(packaging/OutsideProject COST 10 COMMAND ${here}/packaging/run.sh
                  ${PROJECT_BINARY_DIR} ${CMAKE_CXX_COMPILER} ${program})
    set(DEGS_OTHER_SYSTEMC "" CACHE PATH "Prefix of another SystemC, with which the accelerator is tested, too")
    degs_all_test(packaging/OtherSystemC COMMAND ${here}/packaging/systemc.sh ${PROJECT_BINARY_DIR} ${CMAKE_CXX_COMPILER}
                  ${program} ENVIRONMENT DEGS_OTHER_SYSTEMC=${DEGS_OTHER_SYSTEMC})
endif()
