// SPDX-License-Identifier: Apache-2.0
// What programs ask of jemalloc, with which they are linked (sim/CMakeLists.txt).

/// Without huge pages the kernel maps tens of thousands of small ones, which takes a third of the
/// processor time of a short run. The environment variable MALLOC_CONF has the last word.
extern "C" const char* const malloc_conf = "thp:always";
