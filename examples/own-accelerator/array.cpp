// SPDX-License-Identifier: Apache-2.0
#include "array.hpp"

#include "splat/frame/pixel_mask.hpp"
#include "tlm/has_process.hpp"

namespace degs::row_sweep {

void Array::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 256, "arrays, each on a tile of its own");
    visitor.integer("latency_cycles", latency_cycles, 1, 4096,
                    "cycles from the last slot of a tile to its pixels written back [assumed]");
    visitor.boolean("skip_ended", skip_ended, "rows whose pixels have all ended take no slot");
}

void Array::Stats::describe(StatsVisitor& visitor) const {
    visitor.count("tiles", tiles, "tiles", "Tiles worked on.");
    visitor.count("splats", splats, "splats", "Splats swept over.");
    visitor.count("splats_abandoned", abandoned, "splats",
                  "Splats fetched after every pixel of their tile had ended.");
    visitor.count("rows_skipped", rows_skipped, "rows", "Rows left out by skip_ended.");
}

Array::Array(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
             RenderJob& job, const ArrayShare& share)
    : sc_core::sc_module(name), in("in"), context_free("context_free"), tile_done("tile_done"),
      tile_state("tile_state"), config_(config), job_(job), share_(share), self_(time),
      part_(job.record_part(job.tile_size)), live_in_row_(job.tile_size) {
    DEGS_HAS_PROCESS(Array);
    SC_THREAD(run);
    self_.show(*this, stats_.busy);
}

void Array::end_of_elaboration() {
    in->connect_reader(self_);
    context_free->connect_reader(self_);
    tile_done->connect_writer(self_);
    tile_state->connect_writer(self_);
}

void Array::run() {
    while (start_tile()) {
        for (bool last = false; !last;) {
            const SplatChunk& chunk = in->arrive(self_);
            last = chunk.last;
            take(chunk);
            in->drop(self_);
        }
        if (!reported_) {
            report_tile();
        }
    }
    in->drop(self_);
    tile_done->put(self_, {kNoTile, false});
    tile_state->put(self_, {kNoTile, false});
    self_.finish();
}

/// Waits for the first splats of the next tile, then for a context. False if there is no such tile.
bool Array::start_tile() {
    number_ = in->arrive(self_).tile;
    if (number_ == kNoTile) {
        return false;
    }
    context_ = context_in_turn(stats_.tiles, share_.contexts, share_.first_context);
    if (stats_.tiles++ >= static_cast<std::uint64_t>(share_.contexts)) {
        const Cycle ready = self_.local();
        context_free->get(self_);
        blocked_ += self_.local() - ready;
    }
    tile_ = &job_.tiles[number_];
    live_ = static_cast<int>(tile_->pixels());
    live_in_row_.assign(live_in_row_.size(), tile_->image_columns().size());
    reported_ = false;
    return true;
}

void Array::take(const SplatChunk& chunk) {
    const std::uint32_t* list = job_.frame_of(*tile_).tile_splats.data() + chunk.first;
    std::uint32_t taken = 0;
    for (; taken < chunk.count && live_ > 0; ++taken) {
        sweep(job_.first_splat[tile_->frame] + list[taken]);
    }
    stats_.splats += taken;
    stats_.abandoned += chunk.count - taken;
    if (taken == 0) { // a cycle to throw it away
        self_.advance();
    }
}

void Array::sweep(std::uint32_t splat) {
    const PixelRange rows = job_.path->tested_rows(splat, tile_->columns(), tile_->rows());
    const Cycle begin = self_.local();
    PixelTest test;
    test.splat = splat;
    const PixelRange columns = tile_->image_columns();
    test.mask = bits_between(columns.first, columns.last + 1);
    test.x = tile_->x;
    test.context = context_;
    // Once a tile is reported, its context may hold another: not even the rest of the splat is
    // swept.
    for (test.y = rows.first; test.y <= rows.last && live_ > 0; ++test.y) {
        test.row = test.y - tile_->y;
        if (config_.skip_ended && live_in_row_[test.row] == 0) {
            stats_.rows_skipped++;
        } else {
            execute(test);
        }
    }
    if (self_.local() == begin) { // a cycle to see that no row takes a slot
        self_.advance();
    }
}

/// The slot of a row. Pixel values come from the data path; here they only take time.
void Array::execute(PixelTest& test) {
    const Cycle now = self_.local();
    const BlendOutcome outcome = job_.path->test(test);
    const std::uint64_t useful = __builtin_popcount(outcome.useful);
    const std::uint64_t terminated = __builtin_popcount(outcome.terminated);
    account_idle();
    add(Slot::Useful, now, now + 1, useful);
    add(Slot::Terminated, now, now + 1, terminated);
    add(Slot::Boundary, now, now + 1, width() - useful - terminated); // also outside the image
    stats_.window.include(now);
    if (part_ != nullptr) {
        part_->work(number_, now, now + 1);
    }
    self_.work(1, stats_.busy);
    free_ = self_.local();
    const int ended = __builtin_popcount(outcome.ended);
    live_in_row_[test.row] -= ended;
    live_ -= ended;
    if (live_ == 0 && !reported_) {
        report_tile();
    }
}

/// Idle cycles count once a slot follows. Who waited for a context did so last.
void Array::account_idle() {
    const Cycle now = self_.local();
    if (!stats_.window.empty()) {
        add(Slot::Starved, free_, now - blocked_, (now - blocked_ - free_) * width());
        add(Slot::Blocked, now - blocked_, now, blocked_ * width());
    }
    blocked_ = 0;
}

void Array::add(Slot slot, Cycle from, Cycle to, std::uint64_t count) {
    stats_.slots[slot] += count;
    if (part_ != nullptr) {
        part_->add(slot, number_, from, to, count);
    }
}

void Array::report_tile() {
    const Cycle written = self_.local() + config_.latency_cycles;
    tile_state->put_at(self_, {number_, live_ == 0}, written);
    tile_done->put_at(self_, {number_, live_ == 0}, written);
    reported_ = true;
}

} // namespace degs::row_sweep
