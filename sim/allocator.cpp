// SPDX-License-Identifier: Apache-2.0
// What programs ask of jemalloc, with which they are linked (sim/CMakeLists.txt).
#include <cstddef>

#include <pthread.h>

/// Without huge pages the kernel maps tens of thousands of small ones, which takes a third of the
/// processor time of a short run. The environment variable MALLOC_CONF has the last word.
extern "C" const char* const malloc_conf = "thp:always";
// This is of jemalloc, whose header declares the options above as a variable.
extern "C" int mallctl(const char* name, void* old, std::size_t* old_size, void* value,
                       std::size_t size);

namespace {

/// A point of a study is a child. Where its parent has given memory back, the kernel would copy
/// each page that the child takes anew, although nobody reads what was on it.
void take_fresh_arena() {
    unsigned arena = 0;
    std::size_t size = sizeof arena;
    if (::mallctl("arenas.create", &arena, &size, nullptr, 0) == 0) {
        ::mallctl("thread.arena", nullptr, nullptr, &arena, sizeof arena);
        ::mallctl("thread.tcache.flush", nullptr, nullptr, nullptr, 0);
    }
}

[[maybe_unused]] const int kRegistered = ::pthread_atfork(nullptr, nullptr, take_fresh_arena);

} // namespace
