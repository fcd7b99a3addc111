# SPDX-License-Identifier: Apache-2.0
# Which SystemC to use. A prefix that somebody names counts more than the SystemC of the system, in
# this order:
# 1. SystemCLanguage_DIR, or the CMake package of a SystemC under CMAKE_PREFIX_PATH or SYSTEMC_HOME;
# 2. headers and a library under one of these prefixes;
# 3. a CMake package elsewhere;
# 4. pkg-config.
# The variables may be those of CMake or of the environment. Sets DEGS_SYSTEMC_INCLUDE,
# DEGS_SYSTEMC_LIBRARY (a file), DEGS_SYSTEMC_VERSION and DEGS_SYSTEMC_FROM (package, prefix or
# pkg-config), and DEGS_SYSTEMC_PROBLEM, a sentence if there is none. The installed package has this
# file, too.

# degs_systemc_prefixes(<variable>): the prefixes that somebody has named.
function(degs_systemc_prefixes variable)
    string(REPLACE ":" ";" from_environment "$ENV{CMAKE_PREFIX_PATH}")
    set(prefixes ${CMAKE_PREFIX_PATH} ${from_environment})
    foreach(home "${SYSTEMC_HOME}" "$ENV{SYSTEMC_HOME}")
        if(home)
            list(APPEND prefixes "${home}")
        endif()
    endforeach()
    set(${variable} ${prefixes} PARENT_SCOPE)
endfunction()

# degs_systemc_version(<include> <variable>): what the headers say of themselves, as 3.0.2.
function(degs_systemc_version include variable)
    set(version "")
    if(EXISTS "${include}/sysc/kernel/sc_ver.h")
        foreach(part MAJOR MINOR PATCH)
            file(STRINGS "${include}/sysc/kernel/sc_ver.h" line REGEX "^#[ ]*define SC_VERSION_${part} +[0-9]+")
            string(REGEX REPLACE ".*SC_VERSION_${part} +([0-9]+).*" "\\1" number "${line}")
            list(APPEND version ${number})
        endforeach()
    endif()
    list(JOIN version "." version)
    set(${variable} "${version}" PARENT_SCOPE)
endfunction()

macro(degs_systemc_of_package)
    get_target_property(DEGS_SYSTEMC_INCLUDE SystemC::systemc INTERFACE_INCLUDE_DIRECTORIES)
    list(GET DEGS_SYSTEMC_INCLUDE 0 DEGS_SYSTEMC_INCLUDE)
    get_target_property(DEGS_SYSTEMC_LIBRARY SystemC::systemc LOCATION)
    set(DEGS_SYSTEMC_FROM package)
endmacro()

macro(degs_find_systemc)
    foreach(fact INCLUDE LIBRARY VERSION FROM) # of an earlier search
        unset(DEGS_SYSTEMC_${fact} CACHE)
        unset(DEGS_SYSTEMC_${fact})
    endforeach()
    set(DEGS_SYSTEMC_FROM "")
    set(DEGS_SYSTEMC_PROBLEM "")
    degs_systemc_prefixes(degs_prefixes)
    if(NOT TARGET SystemC::systemc)
        find_package(SystemCLanguage CONFIG QUIET PATHS ${degs_prefixes} NO_DEFAULT_PATH)
    endif()
    if(TARGET SystemC::systemc)
        degs_systemc_of_package()
    else()
        find_path(DEGS_SYSTEMC_INCLUDE systemc PATHS ${degs_prefixes} PATH_SUFFIXES include NO_DEFAULT_PATH NO_CACHE)
        find_library(DEGS_SYSTEMC_LIBRARY systemc PATHS ${degs_prefixes} NO_DEFAULT_PATH NO_CACHE
                     PATH_SUFFIXES lib lib64 lib-linux64 lib-linuxaarch64 lib/${CMAKE_LIBRARY_ARCHITECTURE})
        if(DEGS_SYSTEMC_INCLUDE AND DEGS_SYSTEMC_LIBRARY)
            set(DEGS_SYSTEMC_FROM prefix)
        endif()
    endif()
    if(NOT DEGS_SYSTEMC_FROM AND (SYSTEMC_HOME OR DEFINED ENV{SYSTEMC_HOME}))
        set(DEGS_SYSTEMC_PROBLEM "SYSTEMC_HOME names '${SYSTEMC_HOME}$ENV{SYSTEMC_HOME}', which has no SystemC: it needs \
include/systemc and a library libsystemc in lib.")
    elseif(NOT DEGS_SYSTEMC_FROM)
        find_package(SystemCLanguage CONFIG QUIET)
        if(TARGET SystemC::systemc)
            degs_systemc_of_package()
        else()
            find_package(PkgConfig QUIET)
            pkg_check_modules(SYSTEMC QUIET systemc)
            if(SYSTEMC_FOUND)
                find_library(DEGS_SYSTEMC_LIBRARY systemc HINTS ${SYSTEMC_LIBRARY_DIRS} NO_CACHE)
                pkg_get_variable(DEGS_SYSTEMC_INCLUDE systemc includedir)
                set(DEGS_SYSTEMC_FROM pkg-config)
            else()
                set(DEGS_SYSTEMC_PROBLEM "There is no SystemC: install libsystemc-dev, or name the prefix of one with \
CMAKE_PREFIX_PATH or SYSTEMC_HOME.")
            endif()
        endif()
    endif()
    string(REGEX REPLACE "/$" "" DEGS_SYSTEMC_INCLUDE "${DEGS_SYSTEMC_INCLUDE}")
    degs_systemc_version("${DEGS_SYSTEMC_INCLUDE}" DEGS_SYSTEMC_VERSION)
endmacro()
