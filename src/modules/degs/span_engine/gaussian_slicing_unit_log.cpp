// SPDX-License-Identifier: Apache-2.0
// What a Slicing Unit writes into a log (docs/block-log.md) before the first event.
#include <limits>
#include <utility>

#include "modules/degs/span_engine/gaussian_slicing_unit.hpp"

namespace degs {

// The facts are what somebody who replays the unit has to know.
void GaussianSlicingUnit::start_of_simulation() {
    if (log_ == nullptr) {
        return;
    }
    const std::pair<const char*, std::int64_t> facts[] = {
        {"tile_size", job_.tile_size},
        {"module", index_},
        {"modules", modules_},
        {"units", config_.units_per_module()},
        {"rows_per_cycle", config_.rows_per_cycle},
        {"splats_per_cycle", config_.splats_per_cycle},
        {"distribution", static_cast<int>(config_.distribution)},
        {"rows", static_cast<int>(config_.rows)},
        {"skip_dead_rows", config_.skip_dead_rows},
        {"segment_length", segment_length_},
        {"inputs", static_cast<std::int64_t>(in.size())},
        {"slices", static_cast<std::int64_t>(region_ended.size())},
        {"lanes", static_cast<std::int64_t>(out.size())},
        {"granted", config_.granted},
        {"splat_ports", config_.splat_ports.limited()
                            ? config_.splat_ports.neighbours(std::numeric_limits<int>::max())
                            : 0},
        {"row_ports", config_.row_ports.ports},
        {"places", static_cast<std::int64_t>(out[0].ring().depth())}};
    for (const auto& [name, value] : facts) {
        log_->set(name, value);
    }
    for (std::size_t i = 0; i < in.size(); ++i) {
        in[i].ring().log_takes(*log_, "chunk", i);
    }
    for (std::size_t i = 0; i < region_ended.size(); ++i) {
        region_ended[i].ring().log_takes(*log_, "region_ended", i);
    }
    cancel.ring().log_takes(*log_, "cancelled");
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].ring().log_puts(*log_, "row", i);
        out[i].ring().log_departures(*log_, "taken", i);
    }
}

} // namespace degs
