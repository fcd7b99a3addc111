// SPDX-License-Identifier: Apache-2.0
// The logic of DeGS that a register cannot divide, or whose division costs cycles that a key has.
#include <cmath>

#include "modules/degs/config.hpp"

namespace degs {
namespace {

/// The assignment with which a path of `fo4` has enough cycles, of which `spent` are needed for
/// something else; empty if the key does not go so far.
std::string cure_of(const char* key, double fo4, double fo4_per_cycle, int spent = 0) {
    constexpr double kMostCycles = 64; // of both keys
    const double cycles = spent + std::ceil(fo4 / fo4_per_cycle);
    return cycles > kMostCycles ? ""
                                : std::string(key) + "=" + std::to_string(static_cast<int>(cycles));
}

/// The fewest cycles before packing in which a bank chooses its segments fast enough.
std::string selection_cure(const BankShape& bank, const cost::LogicLaws& laws, double cycle) {
    constexpr int kMost = 3; // more registers have nothing left to divide
    for (int cycles = 1; cycles <= kMost; ++cycles) {
        if (bank.selection_fo4(laws, cycles) <= cycle) {
            return "scheduler.select_cycles=" + std::to_string(cycles);
        }
    }
    return "";
}

} // namespace

std::vector<cost::ClockLimit> DegsConfig::clock_limits() const {
    const cost::LogicLaws& laws = cost.logic;
    const double cycle = laws.fo4_per_ns / clock_ghz;
    const BankShape bank = bank_shape();
    const double loop = pipeline.numbers.base == Arithmetic::Tuned ? laws.tuned_pixel_loop_fo4
                                                                   : laws.pixel_loop_fo4;
    const double packed = laws.fo4_packing(bank.issued, bank.length);
    constexpr int kReadCycles = 1; // of packing.latency_cycles
    std::vector<cost::ClockLimit> limits;
    limits.push_back({"loop of a pixel", loop, scheduler.reuse_cycles,
                      cure_of("scheduler.reuse_cycles", loop, cycle)});
    limits.push_back({"choice of segments", bank.selection_fo4(laws, bank.select_cycles), 1,
                      selection_cure(bank, laws, cycle)});
    limits.push_back({"Packing Unit", packed, std::max(1, packing.latency_cycles - kReadCycles),
                      cure_of("packing.latency_cycles", packed, cycle, kReadCycles)});
    limits.push_back({"segment queue", laws.fo4_queue(bank.depth, bank.cut), 1, ""});
    return limits;
}

} // namespace degs
