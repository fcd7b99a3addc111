// SPDX-License-Identifier: Apache-2.0
// The kinds of records that GCC alone reads and writes.
#pragma once

#include "modules/kit/memory/stream_kinds.hpp"

namespace degs::gcc {

inline constexpr StreamKind kMeans{"means", StreamData::Scene,
                                   "Positions of all Gaussians, read by Stage I.", true};
inline constexpr StreamKind kGroupListsWritten{
    "group_lists_written", StreamData::Own, "Entries of the lists of groups, written by Stage I.",
    true};
inline constexpr StreamKind kGroupListsRead{"group_lists_read", StreamData::Own,
                                            "The same entries, read by Stage II group by group."};
inline constexpr StreamKind kShapes{
    "shapes", StreamData::Scene,
    "Scale, rotation and opacity of listed Gaussians, read by Stage II."};

} // namespace degs::gcc
