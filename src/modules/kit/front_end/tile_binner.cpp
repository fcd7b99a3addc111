// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/tile_binner.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs {

void TileBinner::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("pairs_per_cycle", pairs_per_cycle, 1, 1024,
                    "tile-list entries per cycle; 8 are a burst of 64 B [assumed]");
    visitor.integer("writes_in_flight", writes_in_flight, 1, 1024,
                    "chunk writes not yet acknowledged by memory [assumed]");
    visitor.choice("entries", entries, {"stream", "combined", "entries"},
                   "how list entries reach memory; stream: one behind the other in whole bursts "
                   "[assumed]; combined: grouped by tile in buffer_bytes; entries: a burst each");
    visitor.integer("buffer_bytes", buffer_bytes, 64, 1 << 24,
                    "bytes for entries that wait to be grouped, in two halves [assumed]");
    visitor.integer("head_bytes", head_bytes, 0, 1 << 24,
                    "bytes on the chip for the ends of the lists, 4 per tile; those of further "
                    "tiles are in memory [assumed]");
    if (entries != ListWriting::Combined) {
        visitor.unused("buffer_bytes", "entries", "only combined entries wait to be grouped");
    }
    if (entries == ListWriting::Stream) {
        visitor.unused("head_bytes", "entries", "a stream needs no ends of lists");
    }
    visitor.boolean("keep_lists", keep_lists,
                    "sorted lists stay in memory for the next frame, so that only new entries are "
                    "written and sorted (Neo, ASPLOS 2026) [assumed: no]");
}

int TileBinner::Config::sram_bytes() const {
    switch (entries) {
    case ListWriting::Combined:
        return buffer_bytes + head_bytes;
    case ListWriting::Entries:
        return head_bytes;
    default:
        return 0;
    }
}

TileBinner::TileBinner(const sc_core::sc_module_name& name, const Config& config,
                       const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                       ListChanges& changes, int chunk, std::size_t inputs, std::size_t outputs)
    : sc_core::sc_module(name), in("in", inputs), out("out", outputs), splats("splats", time),
      lists("lists", time), config_(config), traffic_(traffic), job_(job), changes_(changes),
      follows_entries_(config.entries != ListWriting::Stream || config.keep_lists), chunk_(chunk),
      self_(time), acknowledged_(config.writes_in_flight, 0) {
    if (config.entries != ListWriting::Stream) {
        heads = std::make_unique<MemoryPort>("heads", time);
    }
    DEGS_HAS_PROCESS(TileBinner);
    SC_THREAD(run);
    self_.show(*this, stats_.busy);
}

void TileBinner::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    for (auto& port : out) {
        port->connect_writer(self_);
    }
}

std::uint64_t TileBinner::sram_bytes_moved() const {
    constexpr std::uint64_t kReadAndWritten = 2;
    const bool waits = config_.entries == ListWriting::Combined;
    const std::uint64_t entries = waits ? stats_.entries * traffic_.list_entry_bytes : 0;
    const std::uint64_t ends = (stats_.groups - stats_.far_heads) * kListHeadBytes;
    return kReadAndWritten * (entries + ends);
}

void TileBinner::run() {
    std::uint32_t views = 0;
    for (std::uint32_t f = 0; job_.has_frame(self_, f); f += views) {
        views = job_.views_of(f);
        views_.resize(views, {{}, ListWrites(traffic_, config_.entries)});
        for (std::uint32_t v = 0; v < views; ++v) {
            begin(f + v, views_[v]);
        }
        const std::uint64_t chunks = (job_.frames[f]->gaussians + chunk_ - 1) / chunk_;
        for (std::uint64_t c = 0; c < chunks; ++c) {
            for (View& view : views_) {
                bin(in[c % in.size()]->get(self_), view);
            }
        }
        for (std::uint32_t v = 0; v < views; ++v) {
            flush(views_[v].waiting, views_[v]);
            self_.wait_for_memory(last_write_); // lists are read back from memory
            stats_.frame_binned = self_.local();
            frames_binned_.push_back(self_.local());
            frames_binned_.drop_before(job_.first_dated());
            for (auto& port : out) {
                port->put(self_, f + v);
            }
        }
    }
    self_.finish();
}

void TileBinner::begin(std::uint32_t frame, View& view) {
    view.map = job_.map(frame, traffic_);
    if (follows_entries_) {
        changes_.mark(frame, written_);
        view.writes.begin(*job_.frames[frame], written_);
    }
}

void TileBinner::bin(const ProjectedChunk& chunk, View& view) {
    const MemoryMap& map = view.map;
    const Cycle rate = config_.pairs_per_cycle;
    const Cycle busy = std::max<Cycle>(1, (chunk.tile_pairs + rate - 1) / rate);
    stats_.pairs += chunk.tile_pairs;
    self_.work(busy, stats_.busy);
    self_.wait_for_memory(acknowledged_[writes_ % acknowledged_.size()]);
    const Completion splats_done = write_splats(chunk, map);
    if (config_.entries != ListWriting::Stream) {
        acknowledge(splats_done);
        take_entries(chunk, view);
        return;
    }
    const std::uint64_t first = entries_before(chunk.frame, view, chunk.first_visible);
    const std::uint64_t count =
        entries_before(chunk.frame, view, chunk.first_visible + chunk.visible) - first;
    const std::uint64_t entry = traffic_.list_entry_bytes;
    acknowledge(latest(splats_done, lists.write(self_, map.lists + first * entry, count * entry)));
}

Completion TileBinner::write_splats(const ProjectedChunk& chunk, const MemoryMap& map) {
    const std::uint64_t record = traffic_.splat_bytes;
    const std::uint64_t run = map.splats + chunk.first_visible * record;
    const bool in_a_row = job_.places[chunk.frame].of_visible() == nullptr;
    return in_a_row ? splats.write(self_, run, chunk.visible * record)
                    : splats.write(self_, run,
                                   job_.visible_records(chunk.frame, traffic_, chunk.first_visible,
                                                        chunk.visible));
}

void TileBinner::acknowledge(const Completion& write) {
    acknowledged_[writes_++ % acknowledged_.size()] = write;
    last_write_ = latest(last_write_, write);
}

void TileBinner::take_entries(const ProjectedChunk& chunk, View& view) {
    view.waiting += entries_before(chunk.frame, view, chunk.first_visible + chunk.visible) -
                    entries_before(chunk.frame, view, chunk.first_visible);
    if (config_.entries == ListWriting::Entries) {
        flush(view.waiting, view);
        return;
    }
    const std::uint64_t half = config_.buffer_bytes / 2 / traffic_.list_entry_bytes;
    const std::uint64_t room = std::max<std::uint64_t>(1, half / views_.size());
    while (view.waiting > room) {
        flush(room, view);
    }
}

// A burst takes the time of as many entries as fit into it, however many it has. Single entries
// take the time that binning them has taken, too; a buffer is emptied while its other half fills.
void TileBinner::flush(std::uint64_t entries, View& view) {
    if (entries == 0) {
        return;
    }
    view.waiting -= entries;
    const MemoryMap& map = view.map;
    const ListWrites::Batch& batch = view.writes.next(entries);
    stats_.entries += entries;
    stats_.groups += batch.tiles.size();
    stats_.bursts += batch.bursts.size();
    const Cycle rate = config_.pairs_per_cycle;
    const std::uint64_t slots =
        batch.bursts.size() * ceil_div(traffic_.burst_bytes, traffic_.list_entry_bytes);
    const Cycle cycles = ceil_div<Cycle, Cycle>(slots, rate);
    if (config_.entries == ListWriting::Combined) {
        self_.advance_to(drained_);
        drained_ = self_.local() + cycles;
    } else {
        self_.work(cycles - ceil_div<Cycle, Cycle>(entries, rate), stats_.busy);
    }
    self_.wait_for_memory(acknowledged_[writes_ % acknowledged_.size()]);

    ScatteredRecords ends;
    ends.base = map.list_heads;
    ends.stride = ends.bytes = kListHeadBytes;
    ends.burst = traffic_.burst_bytes;
    far_heads_.clear();
    const std::size_t near_heads = config_.head_bytes / kListHeadBytes / views_.size();
    for (const std::uint32_t tile : batch.tiles) {
        if (tile >= near_heads) {
            far_heads_.push_back(tile);
        }
    }
    ends.numbers = far_heads_.data();
    ends.count = far_heads_.size();
    stats_.far_heads += ends.count;
    Completion done;
    if (ends.count != 0) {
        self_.wait_for_memory(heads->read(self_, ends)); // where to write
        done = heads->write(self_, ends.base, ends);
    }
    ScatteredRecords bursts;
    bursts.base = map.lists;
    bursts.stride = bursts.bytes = bursts.burst = traffic_.burst_bytes;
    bursts.numbers = batch.bursts.data();
    bursts.count = batch.bursts.size();
    acknowledge(latest(done, lists.write(self_, bursts.base, bursts)));
}

} // namespace degs
