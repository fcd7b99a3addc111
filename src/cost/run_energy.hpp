// SPDX-License-Identifier: Apache-2.0
// The energy of a run, from the activity of its blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cost/bill_of_materials.hpp"
#include "stats/statistics.hpp"

namespace degs::cost {

/// What a block has done in a run.
struct Activity {
    std::string block;     ///< name in the bill of materials
    double operations = 0; ///< cycles of work of its units, or bytes read and written
};

struct RunFacts {
    std::vector<Activity> activity; ///< of every block, once
    double seconds = 0;             ///< of the run, modelled
    std::uint64_t frames = 1;
    std::uint64_t pixels = 0; ///< of all frames
    bool array_only = false;  ///< the front end was not built
    std::optional<double> dram_nj;
};

struct BlockEnergy {
    std::string name, sentence;
    double dynamic_nj = 0, leakage_nj = 0;
    double power_w = 0; ///< mean over the run
    void describe(StatsVisitor& visitor) const;
};

/// Energy of a run: dynamic energy of what was done, leakage of the area over the time, and the
/// memory. A front end that was not built has neither.
class RunEnergy {
public:
    RunEnergy() = default;
    /// Throws std::logic_error if a block has no activity or two, if an activity has no block, and
    /// if the parts do not add up to the whole.
    RunEnergy(const BillOfMaterials& bill, const RunFacts& facts);

    const std::vector<BlockEnergy>& blocks() const { return blocks_; }
    double dynamic_nj() const { return dynamic_nj_; }
    double leakage_nj() const { return leakage_nj_; }
    const std::optional<double>& dram_nj() const { return dram_nj_; }
    double total_nj() const { return dynamic_nj_ + leakage_nj_ + dram_nj_.value_or(0); }
    std::optional<double> nj_per_frame() const;
    std::optional<double> nj_per_pixel() const;
    std::optional<double> average_power_w() const;

    /// The section `energy` of a report.
    void describe(StatsVisitor& visitor) const;

private:
    void check(const BillOfMaterials& bill, const RunFacts& facts) const;

    std::vector<BlockEnergy> blocks_;
    double dynamic_nj_ = 0, leakage_nj_ = 0;
    std::optional<double> dram_nj_;
    double seconds_ = 0;
    std::uint64_t frames_ = 0, pixels_ = 0;
    bool array_only_ = false;
};

} // namespace degs::cost
