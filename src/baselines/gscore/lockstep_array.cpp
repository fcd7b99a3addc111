// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore/lockstep_array.hpp"

#include <algorithm>

#include "splat/pixels/tested_pixels.hpp"
#include "tlm/has_process.hpp"

namespace degs::gscore {

void LockstepArray::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("lanes", lanes, 16, 1024, "pixel lanes (GSCore: 64)");
    visitor.require(lanes == side() * side() && 32 % side() == 0,
                    {"lanes", "must be a square of 4, 8, 16 or 32 px", "16, 64, 256 or 1024"});
    visitor.choice("subtile_skip", subtile_skip, {"obb", "exact", "none"},
                   "which sub-tiles a splat's bitmap names: those its oriented box meets (GSCore), "
                   "those with a pixel that passes the lanes' check, or all");
    visitor.integer("subtiles", subtiles, 1, 4,
                    "side of a tile in sub-tiles, but never less than 16 px");
    visitor.require(subtiles != 3, {"subtiles", "must be a power of two", "1, 2 or 4"});
    visitor.integer("skips_per_cycle", skips_per_cycle, 0, 1024,
                    "splats without a sub-tile that are passed per cycle; 0: any number, which "
                    "favours the design [assumed]");
    visitor.integer(
        "clusters", clusters, 1, 4,
        "groups of lanes with their own place in the list; group c owns the sub-tiles s = c mod "
        "clusters and takes `clusters` cycles for one; 1: a region per cycle (paper, Sec. II-B)");
    visitor.require(clusters != 3, {"clusters", "must divide the lanes", "1, 2 or 4"});
    visitor.integer("termination_cycles", termination_cycles, 1, 1024,
                    "cycles; 1: the check of cycle T guides cycle T + 1 (paper, Sec. II-B)");
    visitor.integer("pipeline_cycles", pipeline_cycles, 1, 4096,
                    "cycles from the last slot of a tile to its pixels written back; an HLS "
                    "rebuild of the lanes has 192 [assumed]");
}

int LockstepArray::Config::side() const {
    int side = 1;
    while ((side + 1) * (side + 1) <= lanes) {
        ++side;
    }
    return side;
}

int LockstepArray::Config::tile_size() const {
    return std::max(16, subtiles * side());
}

LockstepArray::LockstepArray(const sc_core::sc_module_name& name, const Config& config,
                             const Timebase& time, RenderJob& job, OrientedBoxes& boxes,
                             const ArrayShare& share)
    : sc_core::sc_module(name), in("in", share.inputs), context_free("context_free"),
      tile_done("tile_done"), tile_state("tile_state"), config_(config), job_(job), share_(share),
      self_(time), chunks_(self_, in, job, share.granted), grid_(job.tile_size, config.side()),
      boxes_(boxes), clusters_(config.clusters), subtiles_(grid_.count()), outcomes_(config.side()),
      startable_(share.contexts) {
    DEGS_HAS_PROCESS(LockstepArray);
    SC_THREAD(run);
    self_.show(*this, "", config.clusters);
    recorded_ = job.recorder != nullptr;
    busy_ = self_.track() == nullptr ? nullptr : &self_.track()->state("busy");
    for (Cluster& cluster : clusters_) {
        cluster.part = job.record_part(config.lanes / config.clusters);
    }
}

void LockstepArray::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    context_free->connect_reader(self_);
    tile_done->connect_writer(self_);
    tile_state->connect_writer(self_);
}

void LockstepArray::run() {
    for (TileNumber number = chunks_.next_tile(); number != kNoTile; number = chunks_.next_tile()) {
        render_tile(number);
    }
    chunks_.wait_for_rest();
    stats_.splats_discarded += chunks_.discarded();
    if (share_.granted) {
        tile_state->put(self_, {kNoTile, false});
        tile_done->put(self_, {kNoTile, false});
    }
    close_window();
    self_.finish();
}

void LockstepArray::render_tile(TileNumber number) {
    start_tile(number);
    DatedFifo<SplatChunk>& source = chunks_.of(number);
    bool last = false;
    Cycle begin = 0;
    for (bool first = true; !last && await_chunk(source); first = false) {
        if (first) {
            await_context();
            begin = self_.local();
        }
        last = source.front().last;
        // Several clusters: the first to be done may take the next chunk before the others.
        work(source.front(), std::max(begin, source.head_date()));
        for (const Cluster& cluster : clusters_) {
            self_.advance_to(cluster.free);
        }
        self_.advance_to(scanned_);
        source.drop(self_);
    }
    if (!last) {
        stats_.tiles_stopped++;
        chunks_.stop(number);
    }
    const SliceReport report{number, live_subtiles_ == 0};
    tile_state->put(self_, report);
    tile_done->put(self_, report);
}

void LockstepArray::start_tile(TileNumber number) {
    number_ = number;
    tile_ = &job_.tiles[number];
    context_ = context_in_turn(stats_.tiles++, share_.contexts, share_.first_context);
    if (config_.subtile_skip == SubtileTest::Obb) {
        boxes_.include(tile_->frame);
    }
    inside_ = grid_.holding(tile_->image_columns(), tile_->image_rows());
    live_subtiles_ = 0;
    for (int s = 0; s < grid_.count(); ++s) {
        const PixelBox box = pixels_of(s);
        subtiles_[s] = {};
        if (!box.empty()) {
            subtiles_[s].live = box.width() * box.height();
            ++live_subtiles_;
        }
    }
}

PixelBox LockstepArray::pixels_of(int subtile) const {
    const int side = grid_.side();
    const int x = subtile % grid_.per_side() * side, y = subtile / grid_.per_side() * side;
    const PixelRange columns = tile_->image_columns(), rows = tile_->image_rows();
    return PixelBox{x, y, x + side - 1, y + side - 1}.within(
        {columns.first, rows.first, columns.last, rows.last});
}

/// Waits for the next chunk of the tile. False if the tile stops before the chunk is there.
bool LockstepArray::await_chunk(DatedFifo<SplatChunk>& source) {
    Cycle stop = kNever;
    if (live_subtiles_ == 0) {
        stop = 0;
        for (const Subtile& subtile : subtiles_) {
            stop = std::max(stop, subtile.done_from == kNever ? 0 : subtile.done_from);
        }
    }
    const Cycle ready = self_.local();
    if (stop <= ready || !chunks_.wait_for(source, stop)) {
        return false;
    }
    source.count_late(ready);
    return true;
}

void LockstepArray::await_context() {
    const Cycle ready = self_.local();
    for (; startable_ < stats_.tiles; ++startable_) {
        chunks_.wait_for(context_free.ring(), kNever);
        context_free->take(self_);
    }
    blocked_ += self_.local() - ready;
}

void LockstepArray::work(const SplatChunk& chunk, Cycle begin) {
    const FrameWorkload& frame = job_.frame_of(*tile_);
    const std::uint32_t first_splat = tile_->first_splat;
    const std::uint32_t* list = frame.tile_splats.data() + chunk.first;
    for (std::uint32_t i = 0; i < chunk.count; ++i) {
        if (live_subtiles_ == 0 && all_done(std::max(begin, scanned_))) {
            stats_.splats_discarded += chunk.count - i;
            return;
        }
        stats_.splats++;
        const std::uint32_t splat = first_splat + list[i];
        if (issue(splat, bitmap(splat), std::max(begin, scanned_))) {
            passed_over_ = 0;
        } else {
            stats_.splats_skipped++;
            pass_over(begin);
        }
    }
}

/// The next splats are looked at a cycle later once as many as a cycle takes are passed.
void LockstepArray::pass_over(Cycle begin) {
    if (config_.skips_per_cycle == 0 || ++passed_over_ < config_.skips_per_cycle) {
        return;
    }
    passed_over_ = 0;
    Cycle last = std::max(begin, scanned_);
    for (const Cluster& cluster : clusters_) {
        last = std::max(last, cluster.free);
    }
    scanned_ = last + 1;
}

SubtileMask LockstepArray::bitmap(std::uint32_t splat) const {
    switch (config_.subtile_skip) {
    case SubtileTest::Obb:
        return (grid_.meeting(boxes_[splat], tile_->x, tile_->y) & inside_) |
               (job_.path->rounds_coarsely() ? tested(splat) : 0);
    case SubtileTest::Exact:
        return tested(splat);
    default:
        return inside_;
    }
}

/// The sub-tiles with a pixel that passes the lanes' check.
SubtileMask LockstepArray::tested(std::uint32_t splat) const {
    SubtileMask mask = 0;
    each_tested_row(*job_.path, splat, tile_->columns(), tile_->rows(),
                    [&](int y, const PixelRange& columns) {
                        mask |= grid_.of_pixels(y - tile_->y, columns.relative_to(tile_->x));
                    });
    return mask;
}

/// True if a slot from `begin` on finds every sub-tile done.
bool LockstepArray::all_done(Cycle begin) {
    for (int s = 0; s < grid_.count(); ++s) {
        if ((inside_ >> s & 1U) != 0 &&
            std::max(begin, cluster_of(s).free) < subtiles_[s].done_from) {
            return false;
        }
    }
    return true;
}

bool LockstepArray::issue(std::uint32_t splat, SubtileMask mask, Cycle begin) {
    bool issued = false;
    for (SubtileMask left = mask; left != 0; left &= left - 1) {
        const int s = __builtin_ctz(left);
        const Cycle at = std::max(begin, cluster_of(s).free);
        if (at < subtiles_[s].done_from) {
            pass(s, splat, at);
            issued = true;
        }
    }
    return issued;
}

void LockstepArray::pass(int subtile, std::uint32_t splat, Cycle at) {
    Cluster& cluster = cluster_of(subtile);
    account_wait(cluster, at);
    const Cycle end = at + config_.clusters;
    stats_.passes++;
    stats_.window.include({at, end - 1});
    cluster.first = std::min(cluster.first, at);
    cluster.free = end;
    const int ended =
        recorded_ ? record_pass(cluster, at, subtile, splat) : evaluate(subtile, splat);
    if (ended != 0) {
        Subtile& state = subtiles_[subtile];
        state.live -= ended;
        stats_.pixels_ended += ended;
        if (state.live == 0) {
            state.done_from = end - 1 + config_.termination_cycles;
            --live_subtiles_;
        }
    }
}

/// Lets all lanes evaluate their pixels of a sub-tile. Returns how many of these ended.
int LockstepArray::evaluate(int subtile, std::uint32_t splat) {
    const PixelBox box = pixels_of(subtile);
    const int width = box.width();
    PixelTest test;
    test.splat = splat;
    test.mask = width == 32 ? ~0U : (1U << width) - 1U;
    test.x = tile_->x + box.x0;
    test.column = box.x0;
    test.y = tile_->y + box.y0;
    test.row = box.y0;
    test.context = context_;
    const int rows = box.height();
    job_.path->test_rows(test, rows, outcomes_.data());
    int useful = 0, terminated = 0, ended = 0;
    for (int row = 0; row < rows; ++row) {
        useful += __builtin_popcount(outcomes_[row].useful);
        terminated += __builtin_popcount(outcomes_[row].terminated);
        ended += __builtin_popcount(outcomes_[row].ended);
    }
    stats_.slots[Slot::Useful] += useful;
    stats_.slots[Slot::Terminated] += terminated;
    stats_.slots[Slot::Boundary] += config_.lanes - useful - terminated;
    return ended;
}

/// The cycles between a cluster's last work and this: blocked while the tile waited for its
/// context, else without work.
void LockstepArray::account_wait(Cluster& cluster, Cycle at) {
    if (cluster.first != kNever && at > cluster.free) {
        const Cycle wait = at - cluster.free;
        const Cycle blocked = std::min(wait, blocked_ - cluster.blocked);
        const std::uint64_t width = config_.lanes / config_.clusters;
        stats_.slots[Slot::Blocked] += blocked * width;
        stats_.slots[Slot::Starved] += (wait - blocked) * width;
        if (recorded_) {
            record_wait(cluster, at, blocked);
        }
    }
    cluster.blocked = blocked_;
}

int LockstepArray::record_pass(const Cluster& cluster, Cycle at, int subtile, std::uint32_t splat) {
    if (busy_ != nullptr) {
        busy_->add(at, cluster.free, config_.clusters);
    }
    const SlotAccount before = stats_.slots;
    const int ended = evaluate(subtile, splat);
    const SlotAccount& now = stats_.slots;
    SlotPart& part = *cluster.part;
    part.work(number_, at, cluster.free);
    part.add(Slot::Useful, number_, at, cluster.free, now[Slot::Useful] - before[Slot::Useful]);
    part.add(Slot::Boundary, number_, at, cluster.free,
             now[Slot::Boundary] - before[Slot::Boundary]);
    part.add(Slot::Terminated, number_, at, cluster.free,
             now[Slot::Terminated] - before[Slot::Terminated]);
    return ended;
}

/// The context of a tile is asked for when its first splats are there, so last.
void LockstepArray::record_wait(const Cluster& cluster, Cycle at, Cycle blocked) {
    const std::uint64_t width = config_.lanes / config_.clusters;
    const Cycle starved = at - cluster.free - blocked;
    cluster.part->add(Slot::Starved, number_, cluster.free, at - blocked, starved * width);
    cluster.part->add(Slot::Blocked, number_, at - blocked, at, blocked * width);
}

/// A cluster that joins late or is over early does nothing for the rest of the window.
void LockstepArray::close_window() {
    const std::uint64_t width = config_.lanes / config_.clusters;
    for (const Cluster& cluster : clusters_) {
        if (stats_.window.empty()) {
            return;
        }
        if (cluster.first == kNever) {
            stats_.slots[Slot::Drain] += stats_.window.cycles() * width;
        } else {
            stats_.slots[Slot::Starved] += (cluster.first - stats_.window.first) * width;
            stats_.slots[Slot::Drain] += (stats_.window.last + 1 - cluster.free) * width;
        }
    }
}

} // namespace degs::gscore
