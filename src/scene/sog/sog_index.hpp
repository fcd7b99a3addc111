// SPDX-License-Identifier: Apache-2.0
// lod-meta.json of a streamed SOG scene: which Gaussians of which file show a place at which level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace degs {

/// Gaussians that lie one behind the other in a file.
struct SogRun {
    std::size_t file = 0; ///< position in SogIndex::files
    std::uint64_t offset = 0, count = 0;
};

/// A leaf of the tree: one place of the scene, by level; 0 is the finest. Levels without Gaussians
/// are left out.
using SogLeaf = std::map<int, SogRun>;

struct SogIndex {
    std::vector<std::string> files; ///< names as written, relative to the folder of the index
    std::string environment;        ///< likewise; empty: the scene has none
    std::vector<SogLeaf> leaves;    ///< in the order of the tree
};

/// InputError "<where>: ..." for text that is no such file of version 1 or without a version.
/// Offsets and counts are below 2^32, levels below 100; runs name files of the list, but nothing
/// is known of how many Gaussians these hold.
SogIndex parse_sog_index(const std::string& where, const std::string& text);

} // namespace degs
