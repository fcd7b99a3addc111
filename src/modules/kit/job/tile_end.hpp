// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/render_job.hpp"

namespace degs {

/// Tells a block when no tile follows. Without tile streams that are granted their tiles, all tiles
/// of the job come. A stream that is granted tiles does not know which is its last one: kNoTile
/// ends it.
class TileEnd {
public:
    /// `granted_streams`: number of tile streams that end with kNoTile; 0 if tiles are not granted,
    /// so that the block sees all tiles of the job.
    TileEnd(const RenderJob& job, std::size_t granted_streams)
        : job_(job), granted_streams_(granted_streams) {}

    /// The block has done a tile, or has been told the end of a stream.
    void count(TileNumber tile) {
        if (tile == kNoTile) {
            ++ended_streams_;
        } else {
            ++tiles_;
        }
    }
    bool over() const {
        return granted_streams_ == 0 ? job_.over(tiles_) : ended_streams_ == granted_streams_;
    }
    /// The number of tiles that the block has done.
    std::size_t tiles() const { return tiles_; }

private:
    const RenderJob& job_;
    std::size_t granted_streams_;
    std::size_t ended_streams_ = 0;
    std::size_t tiles_ = 0;
};

} // namespace degs
