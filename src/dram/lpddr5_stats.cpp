// SPDX-License-Identifier: Apache-2.0
// The numbers of a memory by name. Those that `degs memory` measures have the names of
// memory.json.
#include "base/ratio.hpp"
#include "dram/lpddr5.hpp"

namespace degs::dram {

void Lpddr5::Stats::describe(StatsVisitor& v) const {
    v.count("reads", reads, "requests", "Reads that were answered.");
    v.count("writes", writes, "requests", "Writes that were answered.");
    v.count("bytes_read", bytes_read, "bytes", "Of these reads, in whole bursts.");
    v.count("bytes_written", bytes_written, "bytes", "Of these writes, in whole bursts.");
    v.count("bytes", bytes_read + bytes_written, "bytes", "bytes_read + bytes_written.");
    v.section("latency_ns", reads != 0 ? read_latency : write_latency,
              "From a request to its answer: of reads, or of writes if there are no reads.");
    v.section("write_latency_ns", write_latency, "The same of writes; posted writes answer early.");
}

void Lpddr5::describe(std::size_t initiator, StatsVisitor& v) const {
    stats_[initiator].describe(v);
}

void Lpddr5::describe(StatsVisitor& v) {
    const Stats sum = total();
    const double peak = config_.peak_gb_per_s();
    const double seconds = sc_core::sc_time_stamp().to_seconds();
    const std::uint64_t bytes = sum.bytes_read + sum.bytes_written;
    const double gb_per_s = rate_of(bytes, 1e9 * seconds);
    const Energy spent = energy();
    sum.describe(v);
    v.real("peak_gb_per_s", peak, "GB/s", "Data rate x width of the bus.");
    v.real("bandwidth_gb_per_s", gb_per_s, "GB/s", "bytes / simulated_us / 1000.");
    v.real("bandwidth_fraction", gb_per_s / peak, "share", "bandwidth_gb_per_s / peak_gb_per_s.");
    v.real("simulated_us", 1e6 * seconds, "us", "Time of the simulation so far.");
    commands().describe(v);
    v.section("transfers", transfers(sc_core::sc_time_stamp()),
              "What has become of the bytes of all requests so far.");
    v.begin_section("energy", "Energy of the DRAM by event.");
    spent.describe_with_unit(v);
    v.real("pj_per_bit", mean_of(1e3 * spent.total_nj(), 8 * bytes), "pJ/bit",
           "total_nj for each bit of the requests.");
    v.real("mean_power_w", seconds > 0 ? 1e-9 * spent.total_nj() / seconds : 0.0, "W",
           "total_nj / simulated_us / 1000.");
    v.end_section();
}

} // namespace degs::dram
