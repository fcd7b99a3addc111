// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/memory/main_memory.hpp"

#include <algorithm>

#include "base/ratio.hpp"

namespace degs {
namespace {

constexpr const char* kOnlyPixels =
    "Only what is written to the frame buffer exists as bytes in memory; the other streams cost "
    "their time and carry no data.";

template <class Sockets>
void bind_each(const std::vector<MemoryStream>& streams, Sockets& sockets) {
    for (std::size_t i = 0; i < streams.size(); ++i) {
        streams[i].port->out.bind(sockets[i]);
    }
}

template <class Stats>
MemoryTraffic traffic_of(const Stats& stats) {
    return {stats.reads, stats.writes, stats.bytes_read, stats.bytes_written};
}

/// Sets the window over which memory is counted and returns its end: reads of cancelled tiles may
/// still be answered when the last pixel is in memory.
sc_core::sc_time set_window(AcceleratorResult& result, const sc_core::sc_time& last_answer) {
    const ClockDomain clock(result.clock_ghz);
    const sc_core::sc_time end = std::max(clock.at(result.cycles), last_answer);
    result.memory_window = clock.ceil(end);
    return end;
}

/// In cycles as they were simulated, whose length is a whole number of kernel time units.
double share_of_window(const AcceleratorResult& result, double busy_ns) {
    const std::uint64_t cycle = ClockDomain(result.clock_ghz).period().value();
    const double window_ns =
        rate_of(result.memory_window * cycle,
                static_cast<double>(sc_core::sc_time(1, sc_core::SC_NS).value()));
    return window_ns > 0 ? busy_ns / window_ns : 0;
}

/// One data bus with latency.
class BusMemory : public MainMemory {
public:
    BusMemory(const char* name, const Memory::Config& config, const Timebase& time)
        : name_(name), config_(config), time_(time) {}
    void connect(const std::vector<MemoryStream>& streams) override {
        bus_ = std::make_unique<Memory>(name_, config_, time_, streams.size());
        bind_each(streams, bus_->in);
    }
    MemoryTraffic traffic(std::size_t initiator) const override {
        return traffic_of(bus_->stats(initiator));
    }
    double peak_gb_per_s() const override { return config_.bandwidth_gb_per_s; }
    void collect(AcceleratorResult& result) const override {
        const Memory::Stats requests = bus_->total();
        set_window(result, requests.last_answer);
        result.memory_utilization = share_of_window(result, requests.busy_ns);
    }
    std::vector<std::string> explain() const override {
        return {"The memory is a shared data bus with latency: its banks, rows and refresh are not "
                "modelled, so it has no row hit rate, and its energy is that of an average "
                "LPDDR5 memory: cost.dram.",
                kOnlyPixels};
    }

private:
    const char* name_;
    Memory::Config config_;
    const Timebase& time_;
    std::unique_ptr<Memory> bus_;
};

/// For arrays alone.
class UnlimitedMemory : public BusMemory {
public:
    UnlimitedMemory(const char* name, const Timebase& time) : BusMemory(name, unlimited(), time) {}
    double peak_gb_per_s() const override { return 0; }
    void collect(AcceleratorResult& /*result*/) const override {}
    std::vector<std::string> explain() const override {
        return {"The array runs alone: its lists and records are there at once, and the memory has "
                "neither latency nor a limit of bandwidth.",
                kOnlyPixels};
    }

private:
    static Memory::Config unlimited() {
        Memory::Config config;
        config.bandwidth_gb_per_s = 1e12; // a frame takes less than a cycle
        config.latency_ns = 0;
        return config;
    }
};

/// LPDDR5 with channels, banks and rows.
class Lpddr5Memory : public MainMemory {
public:
    Lpddr5Memory(const char* name, const dram::Config& config, const Timebase& time)
        : name_(name), config_(config), time_(time) {}
    void connect(const std::vector<MemoryStream>& streams) override {
        dram_ = std::make_unique<dram::Lpddr5>(name_, config_, time_, streams.size());
        bind_each(streams, dram_->in);
    }
    MemoryTraffic traffic(std::size_t initiator) const override {
        return traffic_of(dram_->stats(initiator));
    }
    double peak_gb_per_s() const override { return config_.peak_gb_per_s(); }
    const LatencyHistogram* read_latency(std::size_t initiator) const override {
        return &dram_->stats(initiator).read_latency;
    }
    void collect(AcceleratorResult& result) const override {
        const dram::Lpddr5::Stats requests = dram_->total();
        const sc_core::sc_time end = set_window(result, requests.last_answer);
        const dram::TransferAccount bytes = dram_->transfers(end);
        result.memory_utilization = share_of_window(result, rate_of(bytes.on_bus, peak_gb_per_s()));
        result.dram_activity = dram_->activity(end);
        result.row_hit_rate = dram::hit_rate(result.dram_activity->all.accesses);
        result.dram_energy = dram_->energy(end);
        result.dram_transfers = bytes;
        result.conservation.push_back(
            {"bytes read and written = on the bus + queued + merged + forwarded",
             requests.bytes_read + requests.bytes_written, bytes.total()});
    }
    std::vector<std::string> explain() const override {
        return {"The memory is LPDDR5 with channels, banks, rows and refresh; the interconnect in "
                "front of the channels, power-down and the start of WCK are not modelled.",
                "The energy of the memory is that of its DRAM devices: the controllers and the PHY "
                "are not in it.",
                kOnlyPixels};
    }

private:
    const char* name_;
    dram::Config config_;
    const Timebase& time_;
    std::unique_ptr<dram::Lpddr5> dram_;
};

} // namespace

std::unique_ptr<MainMemory> make_main_memory(const char* name, const MainMemoryConfig& config,
                                             const Timebase& time, bool unlimited) {
    if (unlimited) {
        return std::make_unique<UnlimitedMemory>(name, time);
    }
    if (config.model == MemoryModel::Lpddr5) {
        return std::make_unique<Lpddr5Memory>(name, config.channels(), time);
    }
    return std::make_unique<BusMemory>(name, config, time);
}

} // namespace degs
