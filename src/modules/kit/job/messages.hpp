// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "splat/pixels/data_path.hpp"
#include "tlm/clock_domain.hpp"

namespace degs {

/// Position of a tile in RenderJob::tiles; counts through all frames.
using TileNumber = std::uint32_t;
/// Stands in place of a tile number where no further tile follows.
constexpr TileNumber kNoTile = ~TileNumber{0};

/// The context of the tile that a block takes as number `turn`: the block uses `contexts` contexts,
/// from `first` on, in turn.
inline std::int16_t context_in_turn(std::uint64_t turn, int contexts, int first = 0) {
    return static_cast<std::int16_t>(first + turn % contexts);
}

/// The number of items in the next chunk: `chunk`, or all that are left if they are fewer.
inline std::uint32_t next_chunk_of(std::uint32_t chunk, std::uint64_t left) {
    return left < chunk ? static_cast<std::uint32_t>(left) : chunk;
}

/// Visible splats of one chunk of Gaussians, Projection Unit -> Tile Binner.
struct ProjectedChunk {
    std::uint32_t frame = 0;
    std::uint32_t first_visible = 0; ///< rank among the frame's visible Gaussians in scene order
    std::uint32_t visible = 0;
    std::uint32_t colours = 0;    ///< evaluated for it; others came with an earlier view
    std::uint64_t tile_pairs = 0; ///< tiles touched by these splats, summed
};

/// Reports that the first entries of a tile's list are in order, Sorting Unit -> Splat Fetcher.
struct SortedRun {
    TileNumber tile = 0;
    std::uint64_t end = 0; ///< entries in order so far; the list is complete at JobTile::count
};

/// Asks for another tile, Splat Fetcher -> Tile Dispatcher.
struct TileRequest {};

/// Up to a fixed number of depth-ordered splats of one tile, Splat Fetcher -> rasterisation.
struct SplatChunk {
    TileNumber tile = 0;
    std::uint64_t first = 0; ///< index into FrameWorkload::tile_splats
    std::uint32_t count = 0;
    bool last = false; ///< nothing of this tile follows
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("tile", tile);
        visitor.number("first", static_cast<std::int64_t>(first));
        visitor.number("count", count);
        visitor.number("last", last);
    }
};

/// Reports that the last row of a Splat Fetcher's chunk has been sent, Slicing Unit -> Parameter
/// Release.
struct ChunkSliced {
    std::size_t fetcher = 0; ///< among those that feed the Slicing Unit
};
/// Reports how many rows of that chunk have gone to a lane of the Span Buffer, Slicing Unit ->
/// Parameter Release.
struct RowCount {
    std::uint32_t rows = 0;
};
/// Reports that a row has become a Span Vector, or misses its tile, Span Unit -> Parameter Release.
struct RowSolved {};
/// Reports that the oldest chunk has left its place in the Gaussian Buffer, Parameter Release ->
/// Splat Fetcher.
struct ChunkReleased {};

/// One scanline of one splat inside a tile, Gaussian Slicing Unit -> Span Unit.
struct RowItem {
    TileNumber tile = 0;
    std::uint32_t splat = 0; ///< DataPath index
    std::int16_t row = 0;    ///< inside the tile
    bool end = false;        ///< end of the tile instead of a row
    RowOutcome outcome;      ///< of a FunctionalModel, if there is one
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("tile", tile);
        visitor.number("end", end);
        visitor.number("splat", end ? 0 : splat);
        visitor.number("row", end ? 0 : row);
    }
};

/// The Span Vector of a row, or the end of a tile, Span Unit -> Issue Bank.
struct SpanItem {
    std::optional<RowSpan> span; ///< none: the end of the tile
    TileNumber tile = 0;
    RowOutcome outcome; ///< of a FunctionalModel, if there is one: the span then has no g0 and d0
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("tile", tile);
        visitor.number("end", !span);
        visitor.number("splat", span ? span->splat : 0);
        visitor.number("row", span ? span->y : 0);
        visitor.number("x0", span ? span->x0 : 0);
        visitor.number("length", span ? span->length : 0);
    }
};

/// What becomes of the tasks of a segment, a bit of each mask for each task; see RowOutcome.
struct TaskOutcome {
    std::uint32_t inside = 0, useful = 0, ended = 0;
};

/// Tasks of one segment on their way to the array. A packet may carry a part of them; the others
/// follow in the next packets, before any other task of the same conflict domain.
struct TaskRun {
    BlendTask task;         ///< all tasks of the segment, one per set bit of the mask
    std::uint32_t part = 0; ///< tasks in this packet
    TileNumber tile = 0;
    std::uint32_t domain = 0; ///< conflict domain inside the bank's part of the tile
    TaskOutcome outcome;      ///< of a FunctionalModel, in place of g0, d0 and offset
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("tile", tile);
        visitor.number("context", task.context);
        visitor.number("domain", domain);
        visitor.number("splat", task.splat);
        visitor.number("row", task.row);
        visitor.number("column", task.column);
        visitor.number("mask", task.mask);
        visitor.number("part", part);
    }
};

/// A fixed-width packet of tasks, Packing Unit -> Blending Array.
struct TaskPacket {
    static constexpr int kMaxRuns = 32;
    int run_count = 0;
    Cycle slot = 0;         ///< cycle in which the array executes it
    int tasks = 0;          ///< set bits over all parts, <= PEs per array slice
    bool ends_tile = false; ///< the bank has nothing more for `ended_tile`
    TileNumber ended_tile = 0;
    std::int16_t ended_context = 0;       ///< of the Pixel Buffer, in which ended_tile lies
    std::array<TaskRun, kMaxRuns> runs{}; ///< the first run_count count

    const TaskRun* begin() const { return runs.data(); }
    const TaskRun* end() const { return runs.data() + run_count; }
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("slot", static_cast<std::int64_t>(slot));
        visitor.number("tasks", tasks);
        visitor.number("ends_tile", ends_tile);
        visitor.number("ended_tile", ends_tile ? ended_tile : 0);
        visitor.number("ended_context", ends_tile ? ended_context : 0);
        visitor.list("runs", runs.data(), run_count);
    }

    TaskPacket() = default;
    TaskPacket(const TaskPacket& other) { copy(other); }
    TaskPacket& operator=(const TaskPacket& other) {
        if (this != &other) {
            copy(other);
        }
        return *this;
    }
    ~TaskPacket() = default;

private:
    /// Copies only the runs in use, because most packets have few.
    void copy(const TaskPacket& other) {
        std::copy_n(other.runs.begin(), other.run_count, runs.begin());
        run_count = other.run_count;
        slot = other.slot;
        tasks = other.tasks;
        ends_tile = other.ends_tile;
        ended_tile = other.ended_tile;
        ended_context = other.ended_context;
    }
};

/// Pixels that have ended, Blending Array -> Issue Bank (paper, Sec. IV-B).
struct Termination {
    TileNumber tile = 0;
    std::int16_t row = 0;     ///< inside the tile
    std::int16_t column = 0;  ///< of mask bit 0, a multiple of the segment length
    std::int16_t context = 0; ///< of the Pixel Buffer, in which the tile lies
    std::uint32_t mask = 0;
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("tile", tile);
        visitor.number("context", context);
        visitor.number("row", row);
        visitor.number("column", column);
        visitor.number("mask", mask);
    }
};

/// A segment of a tile's row whose pixels have all ended, array slice -> Gaussian Slicing Unit.
struct RegionEnded {
    TileNumber tile = 0;
    std::int16_t row = 0;     ///< inside the tile
    std::int16_t segment = 0; ///< column / segment length
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("tile", tile);
        visitor.number("row", row);
        visitor.number("segment", segment);
    }
};

/// Reports what a slice knows of a tile, array slice -> Tile Monitor and Pixel Buffer.
struct SliceReport {
    TileNumber tile = 0;
    bool all_ended = false; ///< every pixel of the slice's rows has terminated
    template <class Visitor>
    void visit(Visitor& visitor) const {
        visitor.number("tile", tile);
        visitor.number("all_ended", all_ended);
    }
};

} // namespace degs
