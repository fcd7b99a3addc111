// SPDX-License-Identifier: Apache-2.0
#include "modules/span_engine/tile_monitor.hpp"

namespace degs {

void TileMonitor::Config::describe(ConfigVisitor& visitor) {
    visitor.boolean(
        "cancel", cancel,
        "stop fetching a tile whose pixels have all ended; false parses lists to the end");
    visitor.integer("latency_cycles", latency_cycles, 1, 4096,
                    "cycles from the last slice's report to the fetchers [assumed]");
}

TileMonitor::TileMonitor(const sc_core::sc_module_name& name, const Config& config,
                         const Timebase& time, const RenderJob& job, int slices,
                         std::size_t listeners, bool granted)
    : sc_core::sc_module(name), in("in", slices), out("out", listeners), config_(config), job_(job),
      granted_(granted), self_(time) {
    SC_HAS_PROCESS(TileMonitor);
    SC_THREAD(run);
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
    while ((granted_ || !job_.over(stats_.tiles)) && watch_tile()) {
    }
    self_.finish();
}

// False: there are no more tiles.
bool TileMonitor::watch_tile() {
    bool all_ended = true;
    TileNumber number = kNoTile;
    for (auto& port : in) {
        const SliceReport report = port->get(self_);
        number = report.tile;
        all_ended = report.all_ended && all_ended;
    }
    if (number == kNoTile) {
        return false;
    }
    stats_.tiles++;
    if (all_ended && config_.cancel) {
        stats_.tiles_cancelled++;
        for (auto& port : out) {
            port->put(self_, number);
        }
    }
    return true;
}

} // namespace degs
