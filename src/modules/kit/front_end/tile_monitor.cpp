// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/tile_monitor.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"

namespace degs {

void TileMonitor::Config::describe(ConfigVisitor& visitor) {
    visitor.boolean(
        "cancel", cancel,
        "stop fetching a tile whose pixels have all ended; false parses lists to the end");
    visitor.integer("latency_cycles", latency_cycles, 1, 4096,
                    "cycles from the last slice's report to the fetchers [assumed]");
    if (!cancel) {
        visitor.unused("latency_cycles", "cancel", "cancel is false");
    }
}

TileMonitor::TileMonitor(const sc_core::sc_module_name& name, const Config& config,
                         const Timebase& time, const RenderJob& job, int slices,
                         std::size_t listeners, bool granted)
    : sc_core::sc_module(name), in("in", slices), out("out", listeners), config_(config), job_(job),
      granted_(granted), self_(time) {
    DEGS_HAS_PROCESS(TileMonitor);
    SC_THREAD(run);
    self_.show(*this);
}

void TileMonitor::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    for (auto& port : out) {
        port->connect_writer(self_);
    }
}

void TileMonitor::run() {
    std::uint64_t rounds = 0;
    while ((granted_ || !job_.over(rounds)) && take_reports()) {
        ++rounds;
    }
    self_.finish();
}

// Takes one report of every slice. False if there are no more. Slices may end tiles in different
// orders.
bool TileMonitor::take_reports() {
    for (auto& port : in) {
        const SliceReport report = port->get(self_);
        if (report.tile == kNoTile) {
            return false;
        }
        Watched& tile = watched(report.tile);
        tile.reports++;
        tile.all_ended = tile.all_ended && report.all_ended;
    }
    const auto complete = [this](const Watched& tile) { return tile.reports == in.size(); };
    for (const Watched& tile : watched_) {
        if (complete(tile)) {
            end_tile(tile);
        }
    }
    watched_.erase(std::remove_if(watched_.begin(), watched_.end(), complete), watched_.end());
    return true;
}

TileMonitor::Watched& TileMonitor::watched(TileNumber number) {
    for (Watched& tile : watched_) {
        if (tile.number == number) {
            return tile;
        }
    }
    return watched_.emplace_back(Watched{number, 0, true});
}

void TileMonitor::end_tile(const Watched& tile) {
    stats_.tiles++;
    if (tile.all_ended && config_.cancel) {
        stats_.tiles_cancelled++;
        for (auto& port : out) {
            port->put(self_, tile.number);
        }
    }
}

} // namespace degs
