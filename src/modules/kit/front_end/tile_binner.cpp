// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/tile_binner.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"

namespace degs {

void TileBinner::Config::describe(ConfigVisitor& visitor) {
    visitor.integer(
        "pairs_per_cycle", pairs_per_cycle, 1, 1024,
        "tile-list entries per cycle; 8 x 8 B keeps one 64 B burst per cycle [assumed]");
    visitor.integer("writes_in_flight", writes_in_flight, 1, 1024,
                    "chunk writes not yet acknowledged by memory [assumed]");
}

TileBinner::TileBinner(const sc_core::sc_module_name& name, const Config& config,
                       const TrafficConfig& traffic, const Timebase& time, const RenderJob& job,
                       int chunk, std::size_t inputs, std::size_t outputs)
    : sc_core::sc_module(name), in("in", inputs), out("out", outputs), splats("splats", time),
      lists("lists", time), config_(config), traffic_(traffic), job_(job), chunk_(chunk),
      self_(time), acknowledged_(config.writes_in_flight, 0) {
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

void TileBinner::run() {
    for (std::uint32_t f = 0; job_.has_frame(self_, f); ++f) {
        const MemoryMap map = job_.map(f, traffic_);
        const std::uint64_t chunks = (job_.frames[f]->gaussians + chunk_ - 1) / chunk_;
        for (std::uint64_t c = 0; c < chunks; ++c) {
            bin(in[c % in.size()]->get(self_), map);
        }
        self_.wait_for_memory(last_write_); // lists are read back from memory: they must be there
        stats_.frame_binned = self_.local();
        frames_binned_.push_back(self_.local());
        for (auto& port : out) {
            port->put(self_, f);
        }
    }
    self_.finish();
}

void TileBinner::bin(const ProjectedChunk& chunk, const MemoryMap& map) {
    const Cycle rate = config_.pairs_per_cycle;
    const Cycle busy = std::max<Cycle>(1, (chunk.tile_pairs + rate - 1) / rate);
    self_.work(busy, stats_.busy);
    Completion& oldest = acknowledged_[writes_++ % acknowledged_.size()];
    self_.wait_for_memory(oldest);
    const std::uint64_t record = traffic_.splat_bytes;
    const std::uint64_t entry = traffic_.list_entry_bytes;
    const std::uint64_t run = map.splats + chunk.first_visible * record;
    const bool in_a_row = job_.places[chunk.frame].of_visible() == nullptr;
    const Completion splats_done =
        in_a_row ? splats.write(self_, run, chunk.visible * record)
                 : splats.write(self_, run,
                                job_.visible_records(chunk.frame, traffic_, chunk.first_visible,
                                                     chunk.visible));
    const Completion lists_done =
        lists.write(self_, map.lists + job_.pairs_before(chunk.frame, chunk.first_visible) * entry,
                    chunk.tile_pairs * entry);
    oldest = latest(splats_done, lists_done);
    last_write_ = latest(last_write_, oldest);
}

} // namespace degs
