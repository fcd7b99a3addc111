// SPDX-License-Identifier: Apache-2.0
#include "baselines/gbu/tile_engine.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"

namespace degs::gbu {
namespace {

constexpr int kLaneBlock = 32; // pixels that DataPath::test() takes at a time

std::uint32_t first_bits(int count) {
    return count >= kLaneBlock ? ~0U : (1U << count) - 1U;
}

} // namespace

void TileEngine::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("row_pes", row_pes, 1, 1024,
                    "Row PEs per engine; PE k serves the tile rows k, k + row_pes, ... (GBU: 8 for "
                    "16 rows) [assumed]");
    visitor.integer("queue_depth", queue_depth, 1, 4096,
                    "row entries waiting in front of a Row PE; GBU does not say [assumed]");
    visitor.integer(
        "rows_per_cycle", rows_per_cycle, 0, 1024,
        "rows of a splat that Row Generation of an engine solves per cycle, and that its area "
        "counts [assumed]; 0: all at once, in the area of Table I (docs/readings.md)");
    visitor.integer("generation_latency", generation_latency, 0, 4096,
                    "cycles from a splat's record to its row entries; 8 in an HLS rebuild");
    visitor.integer("row_pe_latency", row_pe_latency, 1, 4096,
                    "cycles from a pixel's slot to written-back state; 10 in an HLS rebuild");
    visitor.integer("termination_cycles", termination_cycles, 1, 4096,
                    "cycles from the slot that ends a row to Row Generation [assumed]");
    visitor.boolean("end_probe", end_probe,
                    "an entry's end is found by one failing check (DeGS paper, Sec. II-B); false: "
                    "it is computed with its start [assumed]");
}

TileEngine::TileEngine(const sc_core::sc_module_name& name, const Config& config,
                       const Timebase& time, RenderJob& job, int first_context, int contexts)
    : sc_core::sc_module(name), in("in"), context_free("context_free"), tile_done("tile_done"),
      tile_state("tile_state"), config_(config), job_(job), first_context_(first_context),
      contexts_(contexts), self_(time), pes_(config.row_pes),
      loaded_(pes_.size() * config.queue_depth, 0), rows_(job.tile_size) {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        pe_of_row_.push_back(row % pes_.size());
    }
    DEGS_HAS_PROCESS(TileEngine);
    SC_THREAD(run);
    prepare_record();
}

void TileEngine::prepare_record() {
    self_.show(*this, "", config_.row_pes);
    TimeSeries* const busy = self_.track() == nullptr ? nullptr : &self_.track()->state("busy");
    SlotPart* const part = job_.record_part(config_.row_pes);
    if (busy != nullptr || part != nullptr) {
        record_.emplace(part, busy, pes_.size());
    }
    if (part != nullptr) {
        job_.recorder->at_close([this] {
            if (!stats_.window.empty()) {
                record_->close(number_, stats_.window.last + 1);
            }
        });
    }
}

void TileEngine::end_of_elaboration() {
    in->connect_reader(self_);
    context_free->connect_reader(self_);
    tile_done->connect_writer(self_);
    tile_state->connect_writer(self_);
}

void TileEngine::run() {
    for (TileNumber number = next_chunk().tile; number != kNoTile; number = next_chunk().tile) {
        start_tile(number);
        work();
        finish_tile();
    }
    in->drop(self_);
    tile_done->put(self_, {kNoTile, false});
    tile_state->put(self_, {kNoTile, false});
    self_.finish();
}

// Generation is a pipeline: what has long been there has passed through it up to the last stage.
const SplatChunk& TileEngine::next_chunk() {
    in->wait_for_item(self_);
    const Cycle generated = in->head_date() + config_.generation_latency;
    const SplatChunk& chunk = in->arrive(self_);
    self_.advance_to(generated);
    return chunk;
}

void TileEngine::start_tile(TileNumber number) {
    number_ = number;
    tile_ = &job_.tiles[number];
    take_context();
    const PixelRange rows = tile_->image_rows();
    live_rows_ = rows.size();
    started_ = self_.local();
    last_end_ = 0;
    ended_ = kNever;
    reported_ = false;
    for (int row = 0; row < job_.tile_size; ++row) {
        const bool inside = rows.holds(row);
        rows_[row] = {inside ? kNever : 0, inside ? tile_->image_columns().size() : 0};
    }
}

void TileEngine::take_context() {
    const std::uint64_t contexts = contexts_;
    context_ = first_context_ + context_in_turn(stats_.tiles, contexts_);
    if (stats_.tiles >= contexts) {
        const Cycle ready = self_.local();
        context_free->get(self_);
        blocked_ += stats_.window.empty() ? 0 : (self_.local() - ready) * pes_.size();
        if (record_ && !stats_.window.empty()) {
            record_->block(ready, self_.local());
        }
    }
}

// Works on the present tile. Once it is abandoned, its remaining chunks are dropped, one per cycle.
void TileEngine::work() {
    const std::uint32_t first_splat = tile_->first_splat;
    const FrameWorkload& frame = job_.frame_of(*tile_);
    for (bool last = false; !last;) {
        const Cycle ready = self_.local();
        const SplatChunk& chunk = next_chunk();
        last = chunk.last;
        stats_.input_wait += abandoned() ? 0 : self_.local() - ready;
        std::uint32_t taken = 0;
        for (; taken < chunk.count && !abandoned(); ++taken) {
            generate(first_splat + frame.tile_splats[chunk.first + taken]);
        }
        stats_.splats += taken;
        stats_.splats_abandoned += chunk.count - taken;
        if (taken == 0) {
            self_.advance();
        }
        in->drop(self_);
    }
}

// The date moves to the cycle after the one in which the last row was pushed. A row that has ended
// takes no time.
void TileEngine::generate(std::uint32_t splat) {
    Cycle now = self_.local();
    int left = config_.rows_per_cycle; // rows of this cycle
    const Cycle began = now;
    const PixelRange columns = tile_->columns();
    const PixelRange rows = job_.path->tested_rows(splat, columns, tile_->rows());
    Cycle pushed = now;
    for (int y = rows.first; y <= rows.last; ++y) {
        if (rows_[y - tile_->y].ended <= now) {
            stats_.rows_skipped++;
            continue;
        }
        if (config_.rows_per_cycle != 0 && left-- == 0) {
            ++now;
            left = config_.rows_per_cycle;
            --y; // once more, because it may have ended in the meantime
            continue;
        }
        const PixelRange pixels =
            job_.path->tested_columns(splat, y, columns.first, columns.last + 1);
        if (!pixels.empty()) {
            const Entry entry{splat, y - tile_->y, pixels.first - tile_->x, pixels.size()};
            pushed = std::max(pushed, push(entry, now));
        }
    }
    pushed = std::max(pushed, now);
    stats_.generating += now + 1 - began;
    stats_.queue_wait += pushed - now;
    if (ended_ != kNever && !reported_) {
        report_tile(last_end_);
    }
    self_.advance_to(pushed + 1);
}

// The slots that the entry takes from `load` on.
template <bool Recorded>
Cycle TileEngine::execute(const Entry& entry, Cycle load) {
    Row& row = rows_[entry.row];
    PixelTest test;
    test.splat = entry.splat;
    test.y = tile_->y + entry.row;
    test.row = entry.row;
    test.context = context_;
    SlotAccount& slots = stats_.slots;
    const Cycle taken = entry.length + (config_.end_probe ? 1 : 0);
    if (Recorded) {
        record_->begin_entry(number_, pe_of_row_[entry.row], load, load + taken);
    }
    for (int done = 0; done < entry.length; done += kLaneBlock) {
        test.column = entry.column + done;
        test.x = tile_->x + test.column;
        test.mask = first_bits(entry.length - done);
        const BlendOutcome outcome = job_.path->test(test);
        slots[Slot::Useful] += __builtin_popcount(outcome.useful);
        slots[Slot::Boundary] += __builtin_popcount(outcome.boundary);
        slots[Slot::Terminated] += __builtin_popcount(outcome.terminated);
        if (Recorded) {
            record_->pixels(number_, load + done, outcome);
        }
        if (outcome.ended != 0) {
            const int ended = __builtin_popcount(outcome.ended);
            stats_.pixels_ended += ended;
            row.live -= ended;
            if (row.live == 0) {
                row_ended(row, load + done + 31 - __builtin_clz(outcome.ended));
            }
        }
    }
    stats_.entries++;
    stats_.pixels += entry.length;
    slots[Slot::Boundary] += config_.end_probe ? 1 : 0;
    if (Recorded && config_.end_probe) {
        record_->end_probe(number_, load + entry.length);
    }
    stats_.window.include({load, load + taken - 1});
    return taken;
}

// The date at which generation is done with the entry: once the cell it takes has been loaded from,
// or the row is known to have ended.
Cycle TileEngine::push(const Entry& entry, Cycle now) {
    Row& row = rows_[entry.row];
    const std::size_t index = pe_of_row_[entry.row];
    RowPe& pe = pes_[index];
    const std::size_t depth = config_.queue_depth;
    Cycle& cell = loaded_[index * depth + pe.next];
    const Cycle pushed = std::max(now, cell);
    if (row.ended <= pushed) {
        stats_.entries_dropped++;
        return row.ended;
    }
    pe.next = pe.next + 1 == depth ? 0 : pe.next + 1;
    cell = std::max(pe.free, pushed + 1);
    if (row.live == 0) {
        stats_.entries_dropped++;
    } else {
        pe.free = cell + (record_ ? execute<true>(entry, cell) : execute<false>(entry, cell));
    }
    return pushed;
}

void TileEngine::row_ended(Row& row, Cycle slot) {
    const Cycle delay = config_.termination_cycles;
    row.ended = slot + delay;
    last_end_ = std::max(last_end_, slot);
    if (--live_rows_ == 0) {
        ended_ = last_end_ + delay;
    }
}

// Reports the tile as ended, because no pixel changes any more: entries that are still executed
// find none alive.
void TileEngine::report_tile(Cycle last_slot) {
    const Cycle written = last_slot + config_.row_pe_latency;
    const bool all_ended = live_rows_ == 0;
    tile_state->put_at(self_, {number_, all_ended}, written);
    tile_done->put_at(self_, {number_, all_ended}, written);
    reported_ = true;
}

// Ends a tile. This is a barrier: all Row PEs wait for the last one.
void TileEngine::finish_tile() {
    const Cycle generated = self_.local();
    Cycle end = generated;
    for (const RowPe& pe : pes_) {
        end = std::max(end, pe.free);
    }
    for (const RowPe& pe : pes_) {
        stats_.drain_slots += end - std::max(pe.free, generated);
    }
    self_.advance_to(end);
    if (!reported_) {
        report_tile(end - 1);
    }
    stats_.tiles++;
    account_idle();
}

// Up to the last slot of work: whether the engine works again is not known yet.
void TileEngine::account_idle() {
    SlotAccount& slots = stats_.slots;
    if (stats_.window.empty() || stats_.window.last < started_) {
        return;
    }
    slots[Slot::Blocked] += blocked_;
    blocked_ = 0;
    slots[Slot::Starved] = stats_.window.cycles() * pes_.size() - slots[Slot::Useful] -
                           slots[Slot::Boundary] - slots[Slot::Terminated] - slots[Slot::Blocked];
}

} // namespace degs::gbu
