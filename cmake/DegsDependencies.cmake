# SPDX-License-Identifier: Apache-2.0
# Everything the model needs from outside, found once.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

include(DegsSystemC)
degs_find_systemc()
if(DEGS_SYSTEMC_PROBLEM)
    message(FATAL_ERROR "${DEGS_SYSTEMC_PROBLEM}")
endif()
message(STATUS "degs: SystemC ${DEGS_SYSTEMC_VERSION} (${DEGS_SYSTEMC_FROM}), ${DEGS_SYSTEMC_LIBRARY}")
foreach(fact INCLUDE LIBRARY VERSION FROM)
    set(DEGS_SYSTEMC_${fact} "${DEGS_SYSTEMC_${fact}}" CACHE INTERNAL "of the SystemC that was found") # for the tests
endforeach()
# By its files: an imported target is not known to a project that embeds this one.
add_library(degs_systemc INTERFACE)
add_library(degs::systemc ALIAS degs_systemc)
target_include_directories(degs_systemc SYSTEM INTERFACE $<BUILD_INTERFACE:${DEGS_SYSTEMC_INCLUDE}>)
target_link_libraries(degs_systemc INTERFACE $<BUILD_INTERFACE:${DEGS_SYSTEMC_LIBRARY}>)

set(CMAKE_MESSAGE_LOG_LEVEL WARNING) # Debian's Imath complains of Python bindings that nobody needs
find_package(OpenEXR CONFIG REQUIRED)
unset(CMAKE_MESSAGE_LOG_LEVEL)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
# Codecs of compressed scenes; Debian ships them with pkg-config files.
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(ZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy) # vectors of every instruction set
find_package(TinyGLTF CONFIG REQUIRED)
find_package(yaml-cpp CONFIG REQUIRED)

# Header-only packages. Debian's glm has no CMake package of a stable name, so look for the header.
find_path(GLM_INCLUDE_DIR glm/glm.hpp REQUIRED)
add_library(degs_glm INTERFACE)
add_library(glm::glm ALIAS degs_glm)
target_include_directories(degs_glm SYSTEM INTERFACE $<BUILD_INTERFACE:${GLM_INCLUDE_DIR}>)
find_package(nlohmann_json CONFIG REQUIRED)
