// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/span_stage.hpp"

#include <algorithm>
#include <utility>

#include "modules/degs/span_engine/span_replay.hpp"

namespace degs {

void SpanStage::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 256, "units (paper Table III: 4, 8, 16, 32)");
    visitor.boolean("parsing", parsing,
                    "solve rows (paper, Sec. III-A); false, for ablations: PEs test every pixel of "
                    "the splat's bounding box");
    visitor.choice(
        "rows", rows, {"fixed", "pool"},
        "the unit of row y of a tile: y modulo their number, or any that is free [assumed]");
    visitor.integer("rows_per_cycle", rows_per_cycle, 1, 64,
                    "scanlines that a unit takes per cycle (paper, Sec. IV-A: one)");
    visitor.integer("cycles_per_row", cycles_per_row, 1, 64,
                    "cycles per scanline and unit [assumed]");
    visitor.integer("latency_cycles", latency_cycles, 1, 256,
                    "cycles from row item to Span Vector: dy, square, LUT, two sums [assumed]");
    visitor.integer("crossbar_depth", crossbar_depth, 1, 1024,
                    "Span Vectors that wait between a unit and a bank [assumed]");
    visitor.integer("crossbar_width", crossbar_width, 0, 64,
                    "Span Vectors that a bank takes from the crossbar per cycle; 0: as many as it "
                    "can cut [assumed]");
    visitor.require(
        rows_per_cycle == 1 || cycles_per_row == 1,
        {"rows_per_cycle", "must be 1 where a row takes several cycles", "1", {"cycles_per_row"}});
}

SpanStage::SpanStage(const sc_core::sc_module_name& name, const Config& config,
                     const RenderJob& job, std::size_t inputs, std::size_t outputs,
                     std::size_t streams)
    : sc_core::sc_module(name), in("in", inputs), out("out", outputs),
      solved("solved", config.reports_rows ? inputs : 0), config_(config), job_(job),
      tiles_(job, config.granted ? streams : 0) {}

SpanStage::~SpanStage() = default;

SpanReplay* SpanStage::replay_of(const DatedFifo<RowItem>& lane) const {
    for (std::size_t i = 0; i < replays_.size(); ++i) {
        if (in[i].operator->() == &lane) {
            return replays_[i].get();
        }
    }
    return nullptr;
}

bool SpanStage::can_hand_over() {
    const auto attended = [](auto& port) { return port.ring().attended(); };
    return config_.replays && std::none_of(in.begin(), in.end(), attended) &&
           std::none_of(out.begin(), out.end(), attended);
}

void SpanStage::hand_over(std::size_t lane, Process& self, Process& bank) {
    replays_.push_back(std::make_unique<SpanReplay>(self, bank, in[lane].ring(), out[lane].ring(),
                                                    config_, stats_, tiles_));
    if (config_.reports_rows) {
        replays_.back()->report_to(solved[lane].ring());
    }
}

void SpanStage::start_of_simulation() {
    if (log_ == nullptr) {
        return;
    }
    const std::pair<const char*, std::int64_t> facts[] = {
        {"tile_size", job_.tile_size},
        {"units", config_.units_per_module()},
        {"rows_per_cycle", config_.rows_per_cycle},
        {"cycles_per_row", config_.cycles_per_row},
        {"latency_cycles", config_.latency_cycles},
        {"places", static_cast<std::int64_t>(out[0].ring().depth())},
        {"row_ports", config_.row_ports.ports}};
    for (const auto& [name, value] : facts) {
        log_->set(name, value);
    }
    for (std::size_t i = 0; i < in.size(); ++i) {
        in[i].ring().log_takes(*log_, "row", i);
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].ring().log_puts(*log_, "span", i);
        out[i].ring().log_departures(*log_, "taken", i);
    }
}

} // namespace degs
