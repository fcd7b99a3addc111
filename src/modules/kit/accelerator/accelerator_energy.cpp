// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/accelerator/accelerator_energy.hpp"

#include "base/ratio.hpp"

namespace degs {
namespace {

/// By command if the memory has commands, else by bit and time; memory without limit has none.
std::optional<double> dram_nj(const cost::Technology::Dram& dram, const AcceleratorResult& result,
                              double seconds) {
    if (result.array_only) {
        return {};
    }
    if (result.dram_energy) {
        return result.dram_energy->total_nj();
    }
    std::uint64_t read = 0, written = 0; // bytes
    for (const StreamUse& stream : result.streams) {
        read += stream.bytes_read;
        written += stream.bytes_written;
    }
    return bus_nj(dram, real_of(read), real_of(written), result.memory_gb_per_s, seconds);
}

} // namespace

double bus_nj(const cost::Technology::Dram& dram, double bytes_read, double bytes_written,
              double gb_per_s, double seconds) {
    constexpr double kNjPerPj = 1e-3;
    constexpr double kNwPerMw = 1e6;
    constexpr double kBits = 8;
    return kNjPerPj * kBits *
               (dram.pj_per_bit * bytes_read + dram.write_pj_per_bit * bytes_written) +
           kNwPerMw * dram.standby_mw_per_gb_per_s * gb_per_s * seconds;
}

cost::RunEnergy energy_of(const AcceleratorConfig& config, const AcceleratorResult& result,
                          std::uint64_t pixels) {
    constexpr double kHzPerGhz = 1e9;
    cost::RunFacts facts;
    facts.activity = result.activity;
    facts.seconds = rate_of(result.cycles, result.clock_ghz * kHzPerGhz);
    facts.frames = result.frames.size();
    facts.pixels = pixels;
    facts.array_only = result.array_only;
    facts.dram_nj = dram_nj(config.cost.dram, result, facts.seconds);
    return {config.bill(), facts};
}

} // namespace degs
