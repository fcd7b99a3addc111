// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <systemc>

#include "modules/kit/job/kept_list.hpp"
#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/record_places.hpp"
#include "modules/kit/job/slot_recorder.hpp"
#include "modules/kit/job/tile_list.hpp"
#include "modules/kit/job/tile_order.hpp"
#include "modules/kit/job/traffic.hpp"
#include "modules/kit/job/turn_mutex.hpp"
#include "splat/frame/frame_source.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/images/image.hpp"
#include "tlm/process.hpp"
#include "tlm/scattered_records.hpp"

namespace degs {

/// The frames that an accelerator is asked to render, and the arithmetic that it uses.
struct RenderJob {
    KeptList<FramePointer> frames;
    KeptList<std::uint32_t> first_splat; ///< DataPath index of each frame's splat 0
    TileList tiles;                      ///< frame by frame, each in its tile order
    KeptList<std::uint64_t> tiles_of_frame;
    KeptList<Image> images; ///< one per frame, filled by the Pixel Buffer unless it is empty
    std::size_t drawn_images = ~std::size_t{0}; ///< of the first frames; those of others are empty
    std::unique_ptr<DataPath> path;
    int tile_size = 0;
    RecordOrder record_order = RecordOrder::Index; ///< of frames that join from now on
    TileOrder tile_order = TileOrder::Raster;      ///< of frames that join from now on
    KeptList<RecordPlaces> places;                 ///< of each frame's splat records
    /// Per frame: tile pairs of the first n visible Gaussians in scene order, for n = 0..visible.
    KeptList<std::vector<std::uint64_t>> pair_prefix;
    /// Per frame: where its streams live, if not where MemoryMap puts them.
    KeptList<MemoryBases> bases;
    /// Consecutive frames of the source that are the views of one frame and whose Gaussians are
    /// read together.
    std::uint32_t views = 1;
    /// Somebody will add frames beside those of the source; how many is not known.
    bool is_open = false;
    /// Memory holds nothing of frames before this one: the accelerator was reset, or gave one up.
    std::uint32_t first_since_reset = 0;
    /// Set if slots are recorded with their dates and tiles.
    std::unique_ptr<SlotRecorder> recorder;
    /// Set while more frames, or tiles of them, may join; notified when one has.
    std::unique_ptr<sc_core::sc_event> joined;
    /// Frames that follow those that are there. Each is made when a block first asks for it or for
    /// a tile of it, which takes no simulated time: the run is that of a job that has had all
    /// frames from the start. Those that have ended retire then.
    FrameSource source;
    /// Images and dates of frames that have retired stay, for a result.
    bool keeps_results = true;
    std::uint64_t background_tiles = 0; ///< that list no splat, of all frames so far
    /// Messages of note_end() for each tile of a frame, and for the frame itself.
    struct {
        std::uint64_t of_tile = 1, of_frame = 0;
    } ends;
    /// Held while frames join and retire, and by a thread that looks at their splats beside the
    /// simulation.
    std::unique_ptr<TurnMutex> changes = std::make_unique<TurnMutex>();

    std::uint64_t pairs_before(std::uint32_t frame, std::uint32_t visible_rank) const {
        return pair_prefix[frame][visible_rank];
    }
    /// A part of the array that has `width` PEs; nullptr if slots are not recorded.
    SlotPart* record_part(int width) const {
        return recorder == nullptr ? nullptr : &recorder->add_part(width);
    }
    /// Whether there are more than that or may be, views that are read together counted as one.
    bool has_more_frames_than(int count) const {
        const std::size_t limit = count;
        return is_open || joined_groups_ + source.frames / views > limit;
    }
    /// Frames that are the views of one frame have joined together. How many they are, and the
    /// first of them; of a frame that joined alone, 1 and itself.
    std::uint32_t views_of(std::uint32_t frame) const { return groups_[frame].views; }
    std::uint32_t first_view_of(std::uint32_t frame) const { return groups_[frame].first; }
    /// The frame of the same view in the group before, if that has as many views and memory still
    /// holds what it has left there.
    std::optional<std::uint32_t> view_before(std::uint32_t frame) const;
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
    /// Views that are read together have records, lists and pixels one behind the other, unless
    /// somebody else gives them their places.
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
        return there(process, [this, frame] { return comes(frames, frame); });
    }
    bool has_tile(Process& process, std::size_t tile) const {
        return there(process, [this, tile] { return lists(tile); });
    }
    /// True if there is a tile of this number now.
    bool lists(std::size_t tile) const { return comes(tiles, tile); }
    /// True if there will never be a tile of this number.
    bool over(std::size_t tile) const { return !lists(tile) && joined == nullptr; }

    /// Lists the tiles of a frame and loads its splats into the data path.
    void add(FramePointer frame, const MemoryBases& base = {}) {
        add_view(std::move(frame), base, {static_cast<std::uint32_t>(frames.size()), 1});
        ++joined_groups_;
    }
    /// Adds the views of a frame that are read together likewise. `base`: of each, or empty.
    void add_together(std::vector<FramePointer> group, const std::vector<MemoryBases>& base = {});
    /// Adds the next frame of the source, with all of its views that are read together, in place of
    /// those that have ended. False if there is none.
    bool add_next();
    /// A block that ends frames has done so with a tile of this one, or with the frame.
    void note_end(std::uint32_t frame) { ends_of_frame_[frame]++; }
    /// The first frame of which blocks keep dates.
    std::size_t first_dated() const { return keeps_results ? 0 : frames.first(); }
    /// Gives up the tables, the tiles and the splats of frames that have been rendered, from the
    /// oldest on: those below `frame`, up to the first one with a list that a block is still busy
    /// with. A block may only look at them for a list of its own, or at the frame before its own.
    /// The numbers of frames and tiles go on.
    void retire_before(std::uint32_t frame);

private:
    /// The views of one frame.
    struct Group {
        std::uint32_t first, views;
    };
    void add_view(FramePointer frame, const MemoryBases& base, const Group& group);
    void retire_ended();
    /// Whether there is a frame or a tile of this number. That one is made when somebody asks for
    /// it cannot be told from its having been there, so that the job is const to those who ask.
    template <class List>
    bool comes(const List& list, std::size_t number) const {
        while (number >= list.size()) {
            if (source.frames == 0 || !const_cast<RenderJob*>(this)->add_next()) {
                return false;
            }
        }
        return true;
    }
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

    std::size_t ended_ = 0; // frames of which nothing will be asked but by those after them
    KeptList<std::uint64_t> ends_of_frame_; // messages of note_end()
    KeptList<Group> groups_;                // of each frame
    std::size_t joined_groups_ = 0;
};

/// A job without frames.
RenderJob make_render_job(const DataPathOptions& options, int tile_size, int contexts,
                          RecordOrder records = RecordOrder::Index,
                          TileOrder tiles = TileOrder::Raster);
/// Lists the tiles and loads the data path. All workloads must have the same tile size and outlive
/// the job; splats are drawn as they are, whatever format they were projected in.
RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const DataPathOptions& options, int contexts,
                          RecordOrder records = RecordOrder::Index,
                          TileOrder tiles = TileOrder::Raster);

} // namespace degs
