// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_target_socket.h>

#include "config/config.hpp"
#include "tlm/process.hpp"

namespace degs {

/// A memory with one shared data bus: every transaction occupies it for bytes / bandwidth and is
/// answered `latency` later. Requests are served in the order of their dates (kernel time plus
/// annotated delay); equal dates by socket index. Banks, rows and refresh are not modelled here, so
/// that scattered records cost as many bytes in one run.
///
/// LT target: b_transport() returns within the cycle of the request with the rest of the response
/// time annotated, so that an initiator may keep several requests in flight. Contents are kept
/// in pages that exist only where something was written.
class Memory : public sc_core::sc_module {
public:
    struct Config {
        double bandwidth_gb_per_s = 204.8; ///< 1e9 B/s; LPDDR5-6400 x 256 bit (paper, Sec. V-A)
        double latency_ns = 100.0;         ///< request to last byte, unloaded, without the transfer
        int access_bytes = 64;             ///< granularity; a partial access costs a whole one
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        std::uint64_t reads = 0, writes = 0;             ///< transactions
        std::uint64_t bytes_read = 0, bytes_written = 0; ///< as occupied on the bus
        double busy_ns = 0;                              ///< data bus occupied
        sc_core::sc_time last_answer;
        double waited_ns = 0; ///< sum over transactions: date to start of transfer
    };

    sc_core::sc_vector<tlm_utils::simple_target_socket_tagged<Memory>> in;

    Memory(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
           std::size_t initiators);

    const Stats& stats(std::size_t initiator) const { return stats_[initiator]; }
    Stats total() const;

private:
    static constexpr std::uint64_t kPageBytes = 4096;
    struct Request {
        sc_core::sc_time date;
        std::size_t initiator = 0;
        std::uint64_t sequence = 0;
        tlm::tlm_generic_payload* payload = nullptr;
        sc_core::sc_time done;
        bool served = false;
    };
    void transport(int initiator, tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    unsigned int debug(int initiator, tlm::tlm_generic_payload& payload);
    void serve_until(const sc_core::sc_time& date);
    void serve(Request& request);
    void copy(const tlm::tlm_generic_payload& payload);
    void copy_run(bool write, std::uint64_t address, unsigned char* data, std::uint64_t bytes);

    Config config_;
    sc_core::sc_time half_cycle_;
    std::uint64_t* activations_; // see Timebase
    double units_per_ns_;
    double bus_free_ = 0; // kernel time units; fractional, because a burst is not a whole number
    std::uint64_t sequence_ = 0;
    std::vector<Request*> pending_;
    std::vector<Stats> stats_;
    std::unordered_map<std::uint64_t, std::array<unsigned char, kPageBytes>> pages_;
};

/// Marks a payload whose bytes stand for data that the model does not materialise: the memories of
/// this project then take the time of the access and keep nothing. Other memories may ignore it.
struct TimingOnly : tlm::tlm_extension<TimingOnly> {
    tlm_extension_base* clone() const override { return new TimingOnly; }
    void copy_from(const tlm_extension_base&) override {}
};

} // namespace degs
