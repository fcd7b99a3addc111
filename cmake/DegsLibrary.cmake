# SPDX-License-Identifier: Apache-2.0
# One place for the flags that every target of the project shares.
add_library(degs_flags INTERFACE)
add_library(degs::flags ALIAS degs_flags)
target_compile_features(degs_flags INTERFACE cxx_std_17)
# No contraction: results must not depend on whether the machine has fused multiply-add. For the
# same reason the baseline architecture is a fixed one, never -march=native; x86-64-v2 (2009:
# popcnt, SSE4) saves 10 % of a run and has no fused multiply-add. Wider lanes are chosen at run
# time (*_lanes.cpp). slp-vectorize: g++ 12.2 drops the rounding of neighbouring double -> float
# -> double conversions. psabi: vector lanes are passed between our own functions only, all compiled
# with the same flags. What else is warned of concerns this project's sources, not those of others.
set(DEGS_ARCH "" CACHE STRING "Value of -march; empty: x86-64-v2 on x86-64, else the compiler's default")
if(DEGS_ARCH)
    target_compile_options(degs_flags INTERFACE -march=${DEGS_ARCH})
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    target_compile_options(degs_flags INTERFACE -march=x86-64-v2)
endif()
target_compile_options(degs_flags INTERFACE -ffp-contract=off -fno-tree-slp-vectorize
                       "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion>"
                       $<BUILD_INTERFACE:-Wnon-virtual-dtor> -Wno-psabi
                       $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:Clang>:-Wno-overloaded-virtual>>
                       $<BUILD_INTERFACE:$<$<BOOL:${DEGS_WARNINGS_AS_ERRORS}>:-Werror>>)
target_include_directories(degs_flags INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)

# What src has inside, for those who build on it: this project's program and tests, and accelerators
# from outside. Targets that link a room see the public headers of include/degs alone.
set(DEGS_KIT_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR}/degs-kit) # where the package has these headers
add_library(degs_sources INTERFACE)
add_library(degs::sources ALIAS degs_sources)
target_include_directories(degs_sources INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                           $<INSTALL_INTERFACE:${DEGS_KIT_INCLUDEDIR}>)

# degs_compiled_fast(<target>): for sources in which a run spends next to none of its time, such as
# those that read and write text. -Og compiles them in two thirds of the time of -O2; the sanitizers
# are built as Debug, with -O1 for what runs.
function(degs_compiled_fast target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-Og> $<$<CONFIG:Debug>:-O0>)
endfunction()

# degs_library(<room> DEPENDS <targets…>): the library of src/<room>, also known as degs::<room>.
# A room that has headers only, or nothing yet, is an INTERFACE library of the same name.
function(degs_library room)
    cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${room}/*.cpp)
    set(scope PUBLIC)
    if(sources)
        add_library(degs_${room} STATIC ${sources})
        # Kernels, which Highway compiles once per instruction set: it includes the source anew. Its
        # SSE4 would ask for AES instructions, which they do not use and x86-64-v2 does not have.
        set(lanes ${sources})
        list(FILTER lanes INCLUDE REGEX "_lanes\\.cpp$")
        set_source_files_properties(${lanes} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
                                    COMPILE_DEFINITIONS HWY_DISABLE_PCLMUL_AES)
        target_link_libraries(degs_${room} PRIVATE $<BUILD_INTERFACE:degs_flags>)
    else()
        set(scope INTERFACE)
        add_library(degs_${room} INTERFACE)
    endif()
    add_library(degs::${room} ALIAS degs_${room})
    target_link_libraries(degs_${room} ${scope} ${ARG_DEPENDS})
    target_compile_features(degs_${room} ${scope} cxx_std_17)
    target_include_directories(degs_${room} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                               $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()
