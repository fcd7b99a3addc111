// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/analytic_energy.hpp"

#include "modules/kit/accelerator/accelerator_energy.hpp"

namespace degs {
namespace {

constexpr double kNjPerPj = 1e-3;
constexpr double kNsPerS = 1e9;

/// Bits that move for each activation: an activation of 1 nJ is 0.4 pJ/bit, which docs/cost.md fits
/// over designs and views.
constexpr double kBitsPerActivation = 2500;

/// By the energies of the commands: a row of every channel is open all the time, and refreshes come
/// once per interval.
double commands_nj(const dram::Config& memory, double bytes_read, double bytes_written,
                   double seconds) {
    const dram::Energy::Config& energy = memory.energy;
    const double read = 8 * bytes_read, written = 8 * bytes_written; // bits
    const double ns = kNsPerS * seconds;
    const double refreshes = ns / (memory.timing.refi * memory.timing.ck_ns());
    return kNjPerPj * (energy.read_pj_per_bit * read + energy.write_pj_per_bit * written) +
           energy.activate_nj * (read + written) / kBitsPerActivation +
           memory.channels *
               (energy.refresh_all_bank_nj * refreshes + kNjPerPj * energy.standby_open_mw * ns);
}

} // namespace

cost::RunEnergy estimated_energy(const AcceleratorConfig& config, const AnalyticModel& model,
                                 const AnalyticFrame& frame, std::uint64_t pixels) {
    cost::RunFacts facts;
    facts.activity = frame.activity;
    facts.seconds = frame.cycles / (config.clock_ghz * kNsPerS);
    facts.pixels = pixels;
    const MainMemoryConfig& memory = model.main_memory();
    const double read = frame.bytes - frame.written;
    facts.dram_nj =
        memory.model == MemoryModel::Bus
            ? bus_nj(config.cost.dram, read, frame.written, memory.peak_gb_per_s(), facts.seconds)
            : commands_nj(memory.lpddr5, read, frame.written, facts.seconds);
    return {config.bill(), facts};
}

} // namespace degs
