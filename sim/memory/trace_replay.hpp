// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

#include "dram/lpddr5.hpp"
#include "sim/memory/memory_traffic.hpp"
#include "sim/memory/trace_reader.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {

/// AT initiators that replay a trace, one per channel like those of MemoryTraffic, so that a full
/// channel holds up no other; each takes its accesses in the order of the trace. With dates an
/// access leaves at its own, or as soon after as the memory takes it, and its latency counts from
/// that date. Without dates each channel has at most traffic_window() accesses in flight.
class TraceReplay : public sc_core::sc_module {
public:
    sc_core::sc_vector<tlm_utils::simple_initiator_socket_tagged<TraceReplay>> out;

    /// `clock_ghz`: of the cycles of the trace.
    TraceReplay(const sc_core::sc_module_name& name, dram::Lpddr5& memory,
                const dram::Config& config, TraceReader& trace, double clock_ghz);

    /// Runs the simulation until every access has been answered: `accesses` in all. Time, commands
    /// and energy count from the date of the first request to the last answer. May be called once.
    TrafficResult run(std::uint64_t accesses, Progress& progress);

private:
    struct Waiting {
        TraceAccess access;
        sc_core::sc_time date; // from which its latency counts, if the trace has dates
    };
    struct Idle { // commands and energy of the time before the first request
        dram::Channel::Stats commands;
        dram::Energy energy;
    };
    struct Line {                // one initiator
        bool requesting = false; // between BEGIN_REQ and END_REQ
        int under_way = 0;       // not answered
        std::deque<Waiting> waiting;
    };

    tlm::tlm_sync_enum backward(int line, tlm::tlm_generic_payload& payload, tlm::tlm_phase& phase,
                                sc_core::sc_time& delay);
    void feed();
    void send_all(std::size_t line);
    void send(std::size_t line);
    void answered(const tlm::tlm_generic_payload& payload);

    dram::Lpddr5* memory_;
    TraceReader* trace_;
    ClockDomain clock_;
    int window_;
    TraceAccess next_; // if has_next_
    bool has_next_;
    std::optional<Idle> before_;
    std::vector<Line> lines_;
    std::size_t waiting_ = 0; // accesses in all lines
    bool full_ = false;       // feed() goes on when one of them leaves
    TrafficPayloads payloads_;
    std::array<unsigned char, 64> no_data_{};
    std::uint64_t answered_ = 0;
    sc_core::sc_time last_answer_;
    sc_core::sc_event feed_event_;
    LatencyHistogram reads_, writes_;
};

} // namespace degs::sim
