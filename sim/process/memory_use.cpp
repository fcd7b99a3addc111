// SPDX-License-Identifier: Apache-2.0
#include "sim/process/memory_use.hpp"

#include <sys/resource.h>

namespace degs::sim {

std::uint64_t peak_rss_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return std::uint64_t{1024} * usage.ru_maxrss; // Linux counts in KiB
}

} // namespace degs::sim
