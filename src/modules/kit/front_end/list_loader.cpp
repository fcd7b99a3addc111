// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/list_loader.hpp"

#include "tlm/has_process.hpp"

namespace degs {

ListLoader::ListLoader(const sc_core::sc_module_name& name, const TrafficConfig& traffic,
                       const Timebase& time, const RenderJob& job, const SorterTiles& tiles)
    : sc_core::sc_module(name), start("start"), out("out"), lists("lists", time), traffic_(traffic),
      job_(job), tiles_(tiles), self_(time) {
    DEGS_HAS_PROCESS(ListLoader);
    SC_THREAD(run);
    self_.show(*this);
}

void ListLoader::end_of_elaboration() {
    start->connect_reader(self_);
    out->connect_writer(self_);
}

void ListLoader::run() {
    const std::uint64_t entry = traffic_.list_entry_bytes;
    std::uint32_t frames_started = 0;
    const auto take_starts = [&](std::uint32_t frames) {
        for (; frames_started < frames; ++frames_started) {
            start->get(self_);
        }
    };
    // The messages of frames before the tile would pile up before a unit that never has a tile.
    const auto pass = [&](const JobTile& tile) { take_starts(tile.frame); };
    while (tiles_.next(self_, pass)) {
        const JobTile& tile = job_.tiles[tiles_.tile()];
        take_starts(tile.frame + 1);
        const MemoryMap map = job_.map(tile.frame, traffic_);
        out->reserve(self_);
        const Completion ready =
            lists.read(self_, map.lists + tile.first * entry, tile.count * entry);
        out->put_at(self_, tiles_.tile(), ready);
        self_.advance();
    }
    self_.finish();
}

} // namespace degs
