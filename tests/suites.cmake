# SPDX-License-Identifier: Apache-2.0
# cmake -D PROGRAM= -D ROOM= -D COST= -D LABEL= -D ONLY= -D OUT= -P suites.cmake: writes a CTest
# test for each suite of a test program. A suite, not a test, because starting the program costs
# more than most tests do; within a suite each test is a process of its own (test_main.cpp).
#
# Labels: `asan` for Hostile* (broken and malicious input) and SmallRun* (whole simulations of a
# second or less), which run once more under the sanitizers; `shape` for Shape* (how results move
# with a parameter); `all` for what only tests/run.sh --all runs: suites named Long*, and the draws
# of Random/* from the eleventh on. LABEL is one for all suites; ONLY=asan drops what has not this
# label, and of every suite what has a number above nine.
execute_process(COMMAND ${PROGRAM} --suites OUTPUT_VARIABLE suites COMMAND_ERROR_IS_FATAL ANY)
string(STRIP "${suites}" suites)
string(REPLACE "\n" ";" suites "${suites}")
# Numbers from 10 to 999; words of two or three letters are no draws.
set(later_numbers "")
foreach(digit RANGE 1 9)
    list(APPEND later_numbers "${digit}?" "${digit}??")
endforeach()
set(text "")

# later_draws(OUT SUITE): the filter of a suite's draws from the eleventh on.
function(later_draws out suite)
    list(TRANSFORM later_numbers PREPEND "${suite}.*/" OUTPUT_VARIABLE filters)
    string(JOIN ":" filter ${filters})
    set(${out} "${filter}" PARENT_SCOPE)
endfunction()

# add(NAME FILTER LABELS): appends a test to the text.
function(add name filter labels)
    string(APPEND text "add_test([=[${ROOM}/${name}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${filter}]=])\n"
        "set_tests_properties([=[${ROOM}/${name}]=] PROPERTIES TIMEOUT 600 SKIP_RETURN_CODE 77 "
        "COST ${COST} LABELS [=[${labels}]=])\n")
    set(text "${text}" PARENT_SCOPE)
endfunction()

foreach(line IN LISTS suites)
    string(REGEX MATCH "^([^ ]+) ([0-9]+)$" matched "${line}")
    set(suite ${CMAKE_MATCH_1})
    set(count ${CMAKE_MATCH_2})
    set(labels ${LABEL})
    if(suite MATCHES "(^|/)(Hostile|SmallRun)[^/]*$")
        list(APPEND labels asan)
    elseif(ONLY STREQUAL "asan")
        continue()
    elseif(suite MATCHES "(^|/)Shape[^/]*$")
        list(APPEND labels shape)
    elseif(suite MATCHES "(^|/)Long[^/]*$")
        list(APPEND labels all)
    endif()
    if(ONLY STREQUAL "asan" OR (suite MATCHES "^Random/" AND count GREATER 10))
        later_draws(later "${suite}")
        add("${suite}" "${suite}.*-${later}" "${labels}")
        if(NOT ONLY)
            add("${suite}.further" "${later}" all)
        endif()
    else()
        add("${suite}" "${suite}.*" "${labels}")
    endif()
endforeach()
file(WRITE ${OUT} "${text}")
