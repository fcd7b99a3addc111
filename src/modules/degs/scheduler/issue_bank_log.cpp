// SPDX-License-Identifier: Apache-2.0
// What a bank writes into a log (docs/block-log.md).
#include <utility>

#include "modules/degs/scheduler/issue_bank.hpp"

namespace degs {

// The facts are what somebody who replays the bank has to know.
void IssueBank::start_log() {
    const PackingUnit::Config& packing = packing_.config();
    const std::pair<const char*, std::int64_t> facts[] = {
        {"inputs", static_cast<std::int64_t>(streams_.front().inputs.size())},
        {"tile_size", job_.tile_size},
        {"bank", index_},
        {"banks", config_.banks},
        {"segment_length", config_.segment_length},
        {"segments_per_cycle", config_.segments_per_cycle},
        {"spans_per_cycle", spans_per_cycle_},
        {"issue_width", config_.issue_width},
        {"select_cycles", config_.select_cycles},
        {"reuse_cycles", config_.reuse_cycles},
        {"scoreboard", config_.scoreboard},
        {"termination", static_cast<int>(config_.termination)},
        {"scan", static_cast<int>(config_.scan)},
        {"queue_depth", config_.queue_depth},
        {"streams", config_.streams},
        {"granted", config_.granted},
        {"contexts", contexts_},
        {"first_context", config_.first_context},
        {"tiles_in_flight", config_.tiles_of(contexts_)},
        {"feature_entries", config_.feature_entries},
        {"open_splats", config_.open_splats},
        {"fill_cycles", config_.fill.cycles},
        {"fill_ports", config_.fill.ports.ports},
        {"fill_sram_banks", config_.fill.ports.sram_banks},
        {"packet_tasks", packing.width},
        {"packet_latency", packing.latency_cycles},
        {"packets_waiting", packing.depth},
        {"packets_per_cycle", packing.packets_per_cycle},
        {"reorganisation", packing.reorganisation},
        {"packet_ports", packing.ports.limited()}};
    for (const auto& [name, value] : facts) {
        log_->set(name, value);
    }
    for (std::size_t i = 0; i < in.size(); ++i) {
        in[i].ring().log_takes(*log_, "span", i);
    }
    for (std::size_t i = 0; i < context_free.size(); ++i) {
        context_free[i].ring().log_takes(*log_, "context_free", i);
    }
    terminations_->log_takes(*log_, "terminated");
    packing_.out.ring().log_puts(*log_, "packet");
    tile_log_.emplace(*log_);
    trace_ = trace_ == nullptr ? &logged_issues_ : trace_;
    trace_->log_to(*log_);
}

} // namespace degs
