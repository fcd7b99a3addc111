// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

#include "base/ratio.hpp"
#include "dram/lpddr5.hpp"
#include "sim/memory/memory_pattern.hpp"
#include "sim/memory/traffic_payloads.hpp"

namespace degs::sim {

/// Results of a measurement between its warm-up and its end.
struct TrafficResult {
    double offered = 0; ///< share of the peak; 0: as much as the memory takes
    double seconds = 0; ///< simulated
    std::uint64_t requests = 0, bytes = 0;
    LatencyHistogram reads, writes;
    dram::Channel::Stats commands;
    dram::Energy energy;
    double host_s = 0;
    std::uint64_t host_requests = 0; ///< warm-up and end included
    double gb_per_s() const { return rate_of(bytes, seconds) / 1e9; }
};

/// Requests in flight per channel that saturate it: those that fill the read queue, and those whose
/// data are on their way back.
int traffic_window(const dram::Config& config, int request_bytes);

/// AT initiators for a memory, one per channel, so that every channel has its own line of requests
/// and none waits for another's queue. In a closed loop each keeps traffic_window() requests in
/// flight, a few more than the read queue and the data bus hold. With an offered load requests come
/// at random (Poisson), and latency counts from that date, whether or not the line is free.
class MemoryTraffic : public sc_core::sc_module {
public:
    sc_core::sc_vector<tlm_utils::simple_initiator_socket_tagged<MemoryTraffic>> out;

    MemoryTraffic(const sc_core::sc_module_name& name, dram::Lpddr5& memory,
                  const dram::Config& config, const TrafficShape& shape);

    /// Runs the simulation until `requests` after a warm-up have been answered; then waits for the
    /// rest. `offered` is a share of the peak, 0 for a closed loop. May be called again.
    TrafficResult measure(std::uint64_t requests, double offered);

private:
    struct Line {                // one initiator
        bool requesting = false; // between BEGIN_REQ and END_REQ
        int under_way = 0;       // not answered
        std::deque<std::pair<TrafficItem, sc_core::sc_time>> arrived; // offered load only
    };
    struct Snapshot {
        sc_core::sc_time time;
        std::uint64_t requests = 0;
        dram::Channel::Stats commands;
        dram::Energy energy;
    };

    tlm::tlm_sync_enum backward(int line, tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                sc_core::sc_time& delay);
    void begin();
    void arrive();
    void watch();
    bool send(std::size_t line);
    void send_all(std::size_t line);
    void answered(const tlm::tlm_generic_payload& payload);
    Snapshot snapshot();

    dram::Lpddr5* memory_;
    TrafficShape shape_;
    double peak_gb_per_s_;
    int window_;
    TrafficDealer dealer_;
    std::vector<Line> lines_;
    TrafficPayloads payloads_;
    std::vector<unsigned char> no_data_;

    double offered_ = 0;
    bool sending_ = false;
    std::uint64_t answered_ = 0, first_ = 0, last_ = 0; // requests; those that are measured
    std::mt19937_64 random_{12345};
    sc_core::sc_time next_arrival_;
    sc_core::sc_event begin_event_, arrive_event_, watch_event_;
    LatencyHistogram reads_, writes_;
    std::optional<Snapshot> start_, end_;
};

} // namespace degs::sim
