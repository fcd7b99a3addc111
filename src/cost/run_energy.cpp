// SPDX-License-Identifier: Apache-2.0
#include "cost/run_energy.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/ratio.hpp"

namespace degs::cost {
namespace {

constexpr double kNjPerPj = 1e-3;
constexpr double kNjPerJ = 1e9;

[[noreturn]] void fail(const std::string& reason) {
    throw std::logic_error("the cost model is broken, " + reason);
}

std::vector<Activity>::const_iterator activity_of(const std::vector<Activity>& activity,
                                                  const std::string& block) {
    return std::find_if(activity.begin(), activity.end(),
                        [&block](const Activity& each) { return each.block == block; });
}

/// A share of nothing does not exist.
std::optional<double> quotient(double part, double whole) {
    return whole > 0 ? std::optional<double>(part / whole) : std::nullopt;
}

bool agree(double left, double right) {
    constexpr double kRounding = 1e-9;
    return std::abs(left - right) <= kRounding * std::max(std::abs(left), std::abs(right));
}

} // namespace

RunEnergy::RunEnergy(const BillOfMaterials& bill, const RunFacts& facts)
    : dram_nj_(facts.dram_nj), seconds_(facts.seconds), frames_(facts.frames),
      pixels_(facts.pixels), array_only_(facts.array_only) {
    for (const Block& block : bill.blocks()) {
        if (block.front_end && facts.array_only) {
            continue;
        }
        const auto activity = activity_of(facts.activity, block.name);
        if (activity == facts.activity.end()) {
            fail("nothing says what '" + block.name + "' has done");
        }
        BlockEnergy energy{block.name, block.sentence};
        energy.dynamic_nj = kNjPerPj * block.energy_pj * activity->operations;
        energy.leakage_nj = kNjPerJ * block.leakage_w * facts.seconds;
        energy.power_w =
            quotient((energy.dynamic_nj + energy.leakage_nj) / kNjPerJ, facts.seconds).value_or(0);
        dynamic_nj_ += energy.dynamic_nj;
        leakage_nj_ += energy.leakage_nj;
        blocks_.push_back(std::move(energy));
    }
    check(bill, facts);
}

// The whole by another way: from the activities to their blocks, and the mean power.
void RunEnergy::check(const BillOfMaterials& bill, const RunFacts& facts) const {
    double joules = dram_nj_.value_or(0) / kNjPerJ;
    for (const Activity& activity : facts.activity) {
        const Block& block = bill.block(activity.block);
        joules += block.energy_pj * activity.operations * 1e-12;
    }
    double watts = dram_nj_ ? quotient(*dram_nj_ / kNjPerJ, seconds_).value_or(0) : 0;
    for (const BlockEnergy& energy : blocks_) {
        joules += bill.block(energy.name).leakage_w * seconds_;
        watts += energy.power_w;
    }
    if (facts.activity.size() != blocks_.size()) {
        fail("a block has done something twice or was not built");
    }
    if (!agree(joules * kNjPerJ, total_nj()) ||
        (seconds_ > 0 && !agree(watts * seconds_ * kNjPerJ, total_nj()))) {
        fail("the energy of the run is not the sum of its parts");
    }
}

std::optional<double> RunEnergy::nj_per_frame() const {
    return frames_ == 0 ? std::nullopt : std::optional<double>(mean_of(total_nj(), frames_));
}

std::optional<double> RunEnergy::nj_per_pixel() const {
    return pixels_ == 0 ? std::nullopt : std::optional<double>(mean_of(total_nj(), pixels_));
}

std::optional<double> RunEnergy::average_power_w() const {
    return quotient(total_nj() / kNjPerJ, seconds_);
}

void BlockEnergy::describe(StatsVisitor& visitor) const {
    visitor.real("dynamic_nj", dynamic_nj, "nJ", "Energy of what it has done.");
    visitor.real("leakage_nj", leakage_nj, "nJ", "Leakage of its area over the run.");
    visitor.real("average_power_w", power_w, "W", "Both over the time of the run.");
}

void RunEnergy::describe(StatsVisitor& visitor) const {
    visitor.text("covers",
                 array_only_ ? "the rasterisation array, without front end and memory"
                             : "all blocks and the memory",
                 "What was built, and so what the numbers are of.");
    visitor.real("total_nj", total_nj(), "nJ", "The sum of the next three, of all frames.");
    visitor.real("dynamic_nj", dynamic_nj_, "nJ", "Of the blocks: what they have done.");
    visitor.real("leakage_nj", leakage_nj_, "nJ", "Of the blocks: leakage over the run.");
    visitor.real("dram_nj", dram_nj_, "nJ",
                 "Of the main memory, without controller and pins of the chip; null with "
                 "--array-only.");
    visitor.real("nj_per_frame", nj_per_frame(), "nJ", "total_nj / frames.");
    visitor.real("nj_per_pixel", nj_per_pixel(), "nJ", "total_nj / pixels of all frames.");
    visitor.real("average_power_w", average_power_w(), "W", "total_nj / time of the run in ns.");
    visitor.begin_section("blocks", "Every kind of unit and every buffer that was built.");
    for (const BlockEnergy& block : blocks_) {
        visitor.section(block.name, block, block.sentence);
    }
    visitor.end_section();
}

} // namespace degs::cost
