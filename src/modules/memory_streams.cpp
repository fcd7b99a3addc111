// SPDX-License-Identifier: Apache-2.0
#include "modules/memory_streams.hpp"

#include <algorithm>

namespace degs {

void MemoryStreams::build(const char* name, const MainMemoryConfig& config, const Timebase& time,
                          const BuildOptions& options) {
    if (options.gateway != nullptr) {
        gateway_ = options.gateway;
        gateway_->connect(ports_, names_);
        return;
    }
    const auto bind = [this](auto& sockets) {
        for (std::size_t i = 0; i < ports_.size(); ++i) {
            ports_[i]->out.bind(sockets[i]);
        }
    };
    if (config.model == MemoryModel::Lpddr5 && !options.array_only) {
        peak_gb_per_s_ = config.peak_gb_per_s();
        lpddr5_ = std::make_unique<dram::Lpddr5>(name, config.lpddr5, time, ports_.size());
        bind(lpddr5_->in);
        return;
    }
    Memory::Config bus = config;
    peak_gb_per_s_ = bus.bandwidth_gb_per_s;
    if (options.array_only) {
        constexpr double kEverything = 1e12; // a frame takes less than a cycle
        bus.bandwidth_gb_per_s = kEverything;
        bus.latency_ns = 0;
        peak_gb_per_s_ = 0;
    }
    bus_ = std::make_unique<Memory>(name, bus, time, ports_.size());
    bind(bus_->in);
}

MemoryStreams::Traffic MemoryStreams::traffic(std::size_t initiator) const {
    const auto plain = [](const auto& stats) {
        return Traffic{stats.reads, stats.writes, stats.bytes_read, stats.bytes_written};
    };
    if (gateway_ != nullptr) {
        return plain(gateway_->stats(initiator));
    }
    return lpddr5_ ? plain(lpddr5_->stats(initiator)) : plain(bus_->stats(initiator));
}

MemoryStreams::Traffic MemoryStreams::total() const {
    Traffic sum;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
        const Traffic t = traffic(i);
        sum.reads += t.reads;
        sum.writes += t.writes;
        sum.bytes_read += t.bytes_read;
        sum.bytes_written += t.bytes_written;
    }
    return sum;
}

double MemoryStreams::busy_ns() const {
    if (bus_) {
        return bus_->total().busy_ns;
    }
    const Traffic sum = total();
    return peak_gb_per_s_ > 0
               ? static_cast<double>(sum.bytes_read + sum.bytes_written) / peak_gb_per_s_
               : 0;
}

void MemoryStreams::collect(AcceleratorResult& result) const {
    for (std::size_t i = 0; i < names_.size(); ++i) {
        const Traffic stats = traffic(i);
        auto stream = std::find_if(result.streams.begin(), result.streams.end(),
                                   [&](const StreamUse& s) { return s.name == names_[i]; });
        if (stream == result.streams.end()) {
            stream = result.streams.insert(stream, StreamUse{names_[i], 0, 0, 0, {}});
        }
        stream->bytes_read += stats.bytes_read;
        stream->bytes_written += stats.bytes_written;
        stream->requests += stats.reads + stats.writes;
        if (lpddr5_) {
            stream->read_latency.add(lpddr5_->stats(i).read_latency);
        }
    }
    result.memory_gb_per_s = peak_gb_per_s_;
    const double run_ns = static_cast<double>(result.cycles) / result.clock_ghz;
    if (run_ns > 0 && peak_gb_per_s_ > 0) {
        result.memory_utilization = busy_ns() / run_ns;
    }
    if (lpddr5_) {
        const auto& accesses = lpddr5_->commands().accesses;
        const std::uint64_t all = accesses[0] + accesses[1] + accesses[2];
        const auto hits = static_cast<double>(accesses[static_cast<int>(dram::RowState::Hit)]);
        result.row_hit_rate = all == 0 ? 0 : hits / static_cast<double>(all);
        result.dram_energy = lpddr5_->energy();
    }
}

} // namespace degs
