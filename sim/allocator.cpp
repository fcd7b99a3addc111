// SPDX-License-Identifier: Apache-2.0
// What programs ask of jemalloc, with which they are linked (sim/CMakeLists.txt).

/// Huge pages take half of the time of a short run away, in which the kernel otherwise maps tens of
/// thousands of small pages one by one. The environment variable MALLOC_CONF has the last word.
extern "C" const char* const malloc_conf = "thp:always";
