// SPDX-License-Identifier: Apache-2.0
#include "modules/memory_streams.hpp"

#include <algorithm>

namespace degs {

void MemoryStreams::build(const char* name, Memory::Config config, const Timebase& time,
                          bool unlimited) {
    peak_gb_per_s_ = unlimited ? 0 : config.bandwidth_gb_per_s;
    if (unlimited) {
        constexpr double kEverything = 1e12; // a frame takes less than a cycle
        config.bandwidth_gb_per_s = kEverything;
        config.latency_ns = 0;
    }
    memory_ = std::make_unique<Memory>(name, config, time, ports_.size());
    for (std::size_t i = 0; i < ports_.size(); ++i) {
        ports_[i]->out.bind(memory_->in[i]);
    }
}

void MemoryStreams::collect(AcceleratorResult& result) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
        const Memory::Stats& stats = memory_->stats(i);
        auto stream = std::find_if(result.streams.begin(), result.streams.end(),
                                   [&](const StreamUse& s) { return s.name == names_[i]; });
        if (stream == result.streams.end()) {
            stream = result.streams.insert(stream, StreamUse{names_[i], 0, 0, 0});
        }
        stream->bytes_read += stats.bytes_read;
        stream->bytes_written += stats.bytes_written;
        stream->requests += stats.reads + stats.writes;
    }
    result.memory_gb_per_s = peak_gb_per_s_;
    const double run_ns = static_cast<double>(result.cycles) / result.clock_ghz;
    if (run_ns > 0 && peak_gb_per_s_ > 0) {
        result.memory_utilization = memory_->total().busy_ns / run_ns;
    }
}

} // namespace degs
