# SPDX-License-Identifier: Apache-2.0
# Comfort for who builds this project alone; a platform that embeds it keeps its own choices.
# No precompiled headers here: clang-tidy stumbles over those of g++. The tests have one, see
# tests/precompiled. The presets release and asan compile 16 or 30 sources of a target at a time
# (CMAKE_UNITY_BUILD), which takes less than half the time because most of it goes into headers;
# preset dev and `scripts/tidy.sh --alone` take every source alone and so see an include that is
# missing. Names in unnamed namespaces must therefore differ within a folder.
get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT CMAKE_BUILD_TYPE AND NOT multi_config)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()

find_program(DEGS_CCACHE ccache)
mark_as_advanced(DEGS_CCACHE)
if(DEGS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${DEGS_CCACHE}")
endif()

set(CMAKE_EXPORT_COMPILE_COMMANDS ON) # clang-tidy and editors
