// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include <systemc>

#include "modules/kit/job/kept_list.hpp"
#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/record_places.hpp"
#include "modules/kit/job/slot_recorder.hpp"
#include "modules/kit/job/tile_order.hpp"
#include "modules/kit/job/traffic.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/images/image.hpp"
#include "tlm/process.hpp"
#include "tlm/scattered_records.hpp"

namespace degs {

/// A tile that lists at least one splat. Empty tiles never enter the pipeline.
struct JobTile {
    std::uint32_t frame = 0;
    int x = 0, y = 0;          ///< top left pixel in the raster, see Camera
    int width = 0, height = 0; ///< pixels inside the raster
    /// How many of its first and last columns and rows are not in the image.
    int cut_left = 0, cut_top = 0, cut_right = 0, cut_bottom = 0;
    std::uint64_t first = 0; ///< into the frame's tile_splats
    std::uint64_t count = 0;
    std::uint64_t before = 0; ///< entries of the frame's tiles that are taken earlier
    TileNumber turn = 0;      ///< tiles of its frame before it; TileList counts them
    bool last_of_frame = false;
    bool passed = false; ///< sorted and fetched; its list is not asked for again

    // The part inside the image, which is drawn; the list and the rows are those of the whole tile.
    PixelRange columns() const { return drawn_columns().relative_to(-x); } ///< of the raster
    PixelRange rows() const { return drawn_rows().relative_to(-y); }       ///< of the raster
    PixelRange drawn_columns() const { return {cut_left, width - 1 - cut_right}; } ///< of the tile
    PixelRange drawn_rows() const { return {cut_top, height - 1 - cut_bottom}; }   ///< of the tile
    std::int64_t pixels() const {
        return std::int64_t{1} * drawn_columns().size() * drawn_rows().size();
    }
};

/// Tiles that keep their place when others join or the oldest retire, so that blocks may hold on to
/// one.
class TileList {
public:
    /// The number of the next tile.
    std::size_t size() const { return size_; }
    /// The lowest number that has not retired.
    std::size_t first() const { return first_; }
    bool empty() const { return size_ == 0; }
    JobTile& operator[](std::size_t number) { return *index_[number - first_]; }
    const JobTile& operator[](std::size_t number) const { return *index_[number - first_]; }
    JobTile& back() { return *index_.back(); }
    void push_back(const JobTile& tile) {
        const bool first = tiles_.empty() || tiles_.back().frame != tile.frame;
        const TileNumber turn = first ? 0 : tiles_.back().turn + 1;
        tiles_.push_back(tile);
        tiles_.back().turn = turn;
        index_.push_back(&tiles_.back());
        size_ = first_ + index_.size();
    }
    /// Retires the tiles of a frame, which must be the oldest. False, and nothing happens, if one
    /// of them has not been passed.
    bool retire(std::uint32_t frame);
    /// The iterators go over the tiles that have not retired.
    std::deque<JobTile>::const_iterator begin() const { return tiles_.begin(); }
    std::deque<JobTile>::const_iterator end() const { return tiles_.end(); }

private:
    std::deque<JobTile> tiles_;
    std::vector<JobTile*> index_; // for the hot loops; a deque would have to divide
    std::size_t first_ = 0;       // tiles that have retired
    std::size_t size_ = 0;        // of tiles_ and those, for the hot loops
};

/// The frames that an accelerator is asked to render, and the arithmetic that it uses.
struct RenderJob {
    KeptList<const FrameWorkload*> frames;
    KeptList<std::uint32_t> first_splat; ///< DataPath index of each frame's splat 0
    TileList tiles;                      ///< frame by frame, each in its tile order
    KeptList<std::uint64_t> tiles_of_frame;
    KeptList<Image> images;   ///< one per frame, filled by the Pixel Buffer unless it is empty
    bool keeps_images = true; ///< of frames that join from now on; else theirs are empty
    std::unique_ptr<DataPath> path;
    int tile_size = 0;
    RecordOrder record_order = RecordOrder::Index; ///< of frames that join from now on
    TileOrder tile_order = TileOrder::Raster;      ///< of frames that join from now on
    KeptList<RecordPlaces> places;                 ///< of each frame's splat records
    /// Per frame: tile pairs of the first n visible Gaussians in scene order, for n = 0..visible.
    KeptList<std::vector<std::uint64_t>> pair_prefix;
    /// Per frame: where its streams live, if not where MemoryMap puts them.
    KeptList<MemoryBases> bases;
    /// Consecutive frames that are the views of one frame and whose Gaussians are read together.
    /// Frames that join one by one are views of none.
    std::uint32_t views = 1;
    /// Memory holds nothing of frames before this one: the accelerator was reset, or gave one up.
    std::uint32_t first_since_reset = 0;
    /// Set if slots are recorded with their dates and tiles.
    std::unique_ptr<SlotRecorder> recorder;
    /// Set while more frames, or tiles of them, may join; notified when one has.
    std::unique_ptr<sc_core::sc_event> joined;
    bool frames_join = false; ///< not tiles of the frames alone

    std::uint64_t pairs_before(std::uint32_t frame, std::uint32_t visible_rank) const {
        return pair_prefix[frame][visible_rank];
    }
    /// A part of the array that has `width` PEs; nullptr if slots are not recorded.
    SlotPart* record_part(int width) const {
        return recorder == nullptr ? nullptr : &recorder->add_part(width);
    }
    /// Whether there are more than that, views that are read together counted as one.
    bool has_more_frames_than(int count) const {
        const std::size_t limit = count;
        return frames.size() > limit * views;
    }
    /// Which of several like sorting units makes the list of a tile that has joined. They take
    /// turns, anew in each frame, so that a frame does not depend on those before it.
    std::size_t sorter_of(std::size_t tile, std::size_t sorters) const {
        return tiles[tile].turn % sorters;
    }
    const FrameWorkload& frame_of(const JobTile& tile) const { return *frames[tile.frame]; }
    /// Bytes of a frame-buffer pixel.
    int pixel_bytes(std::uint32_t frame, const TrafficConfig& traffic) const {
        const int own = bases[frame].pixel_bytes;
        return own != 0 ? own : traffic.pixel_bytes;
    }
    /// Views that are read together have records, lists and pixels one behind the other.
    MemoryMap map(std::uint32_t frame, const TrafficConfig& traffic) const;
    /// The records of `count` splats; of `count` visible Gaussians in scene order from rank `first`
    /// on, which lie one behind the other in RecordOrder::Index only; the SH of `count` Gaussians.
    /// All views are of the frame's own tables and of the numbers that are handed in.
    ScatteredRecords splat_records(std::uint32_t frame, const TrafficConfig& traffic,
                                   const std::uint32_t* splats, std::size_t count) const;
    ScatteredRecords visible_records(std::uint32_t frame, const TrafficConfig& traffic,
                                     std::uint32_t first, std::size_t count) const;
    ScatteredRecords sh_records(std::uint32_t frame, const TrafficConfig& traffic,
                                const std::uint32_t* gaussians, std::size_t count) const;

    /// True if there is a frame / a tile of this number. If more may come, sleeps until it joins,
    /// and moves the process to that date.
    bool has_frame(Process& process, std::uint32_t frame) const {
        return there(process, [this, frame] { return frame < frames.size(); });
    }
    bool has_tile(Process& process, std::size_t tile) const {
        return there(process, [this, tile] { return tile < tiles.size(); });
    }
    /// True if there will never be a tile of this number.
    bool over(std::size_t tile) const { return joined == nullptr && tile >= tiles.size(); }

    /// Lists the tiles of a frame and loads its splats into the data path.
    void add(const FrameWorkload& frame, const MemoryBases& base = {});
    /// Gives up the tables, the tiles and the splats of frames that have been rendered, from the
    /// oldest on: those below `frame`, up to the first one with a list that a block is still busy
    /// with. A block may only look at them for a list of its own, or at the frame before its own.
    /// The numbers of frames and tiles go on. The workload of a frame from frames.first() on is
    /// still in use.
    void retire_before(std::uint32_t frame);

private:
    template <class There>
    bool there(Process& process, const There& exists) const {
        while (!exists()) {
            if (joined == nullptr) {
                return false;
            }
            sc_core::wait(*joined);
            process.advance_to(process.clock().ceil(sc_core::sc_time_stamp()));
        }
        return true;
    }
};

/// Lists the tiles and loads the data path. All workloads must have the same tile size; splats are
/// drawn as they are, whatever format they were projected in.
RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const DataPathOptions& options, int contexts,
                          RecordOrder records = RecordOrder::Index,
                          TileOrder tiles = TileOrder::Raster);

} // namespace degs
