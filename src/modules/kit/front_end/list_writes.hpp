// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/kit/job/traffic.hpp"

namespace degs {

/// How the entries of tile lists reach memory. `Stream`: one behind the other in whole bursts,
/// whichever tiles they are of. `Combined`: as many entries as the binner's buffer holds are
/// grouped by tile, and every group is written to the end of its list. `Entries`: each is written
/// to the end of its list by itself.
enum class ListWriting { Stream, Combined, Entries };

/// Where the entries of a frame's tile lists are written, in the order in which projection makes
/// them: Gaussians in the order of the scene, the tiles of each in raster order. Arithmetic without
/// any time.
class ListWrites {
public:
    /// Entries of one flush of the binner's buffer.
    struct Batch {
        std::uint64_t entries = 0;
        std::vector<std::uint32_t> bursts; ///< bursts of the list region, one write each
        std::vector<std::uint32_t> tiles;  ///< whose lists grow, one per group
    };

    ListWrites(const TrafficConfig& traffic, ListWriting writing)
        : traffic_(traffic), writing_(writing) {}

    /// Goes to the first entry of a frame, which must live as long as its entries are asked for.
    /// `written` says for each of its tile_splats whether it is; the others are in memory already.
    void begin(const FrameWorkload& frame, const std::vector<bool>& written);
    /// Entries that the first `visible` visible Gaussians write, in the order of the scene.
    std::uint64_t entries_before(std::uint32_t visible) const { return before_[visible]; }
    std::uint64_t entries() const { return before_.back(); }
    /// The next `count` entries, all of which must exist; a stream is grouped, too. Valid until the
    /// next call.
    const Batch& next(std::uint64_t count);

private:
    void write(std::uint32_t tile, std::uint64_t count);

    TrafficConfig traffic_;
    ListWriting writing_;
    std::vector<std::uint64_t> before_; ///< per visible Gaussian in the order of the scene, and all
    std::vector<std::uint32_t> tile_of_; ///< of every entry
    std::vector<std::uint64_t> end_;     ///< of each tile's list, in entries of the region
    std::vector<std::uint32_t> grouped_; ///< entries of a tile in the batch
    std::uint64_t next_ = 0;
    Batch batch_;
};

} // namespace degs
