// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace degs::sim {

/// Largest resident set of this process so far.
std::uint64_t peak_rss_bytes();

} // namespace degs::sim
