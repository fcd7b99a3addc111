// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_initiator_socket.h>

#include "degs/request_info.hpp"

namespace degs::sim {

/// Memory traffic of one processor core: cache lines at an even rate, as many in flight as its
/// cache allows. When memory is slower than the rate the core falls behind and does not catch up.
/// Data have no values and lines no owner: two cores never wait for each other.
class CpuTraffic : public sc_core::sc_module {
public:
    enum class Pattern { Stream, Random };
    struct Config {
        Pattern pattern = Pattern::Stream;
        int reads_per_write = 2;               ///< on average, in random order; 0: reads only
        int lines_in_flight = 32;              ///< misses that the caches allow
        std::uint64_t begin = 0, bytes = 1024; ///< memory that is touched
        unsigned seed = 1;
        unsigned qos = 0; ///< of its accesses, 0 to 15
    };
    static constexpr unsigned int kLineBytes = 64;

    tlm_utils::simple_initiator_socket<CpuTraffic> out;

    CpuTraffic(const sc_core::sc_module_name& name, const Config& config);

    /// Sets the rate from now on, 1e9 B/s; 0 stops the traffic.
    void set_rate(double gb_per_s);
    std::uint64_t bytes_moved() const { return bytes_moved_; }
    std::uint64_t errors() const { return errors_; }

private:
    void run();
    void move_line();
    std::uint64_t next_address();

    Config config_;
    double rate_ = 0;
    std::mt19937_64 random_;
    std::uint64_t next_line_ = 0;
    std::uint64_t moved_ = 0; // lines
    std::uint64_t bytes_moved_ = 0;
    std::uint64_t errors_ = 0;
    std::vector<sc_core::sc_time> done_; // ring: when the latest lines were there
    std::vector<unsigned char> line_;
    RequestInfo info_;
    sc_core::sc_event rate_changed_;
};

} // namespace degs::sim
