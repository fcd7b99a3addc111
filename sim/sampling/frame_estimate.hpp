// SPDX-License-Identifier: Apache-2.0
// The result of a whole frame from that of a sample, with intervals.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"
#include "sim/sampling/group_totals.hpp"
#include "sim/sampling/regression.hpp"
#include "sim/sampling/sampled_run.hpp"

namespace degs::sim {

/// What some tiles have of the blending window.
struct WindowPart {
    SlotAccount slots;       ///< PE-cycles of the tiles
    std::uint64_t total = 0; ///< PE-cycles of the window that go by for them; over all tiles, all
    WindowPart& operator+=(const WindowPart& other) {
        slots += other.slots;
        total += other.total;
        return *this;
    }
};

/// PE-cycles and dates of tasks are recorded tile by tile, so the time and the totals of the
/// classes come from a regression over blocks. Other counters exist for a whole group only, and are
/// scaled. Whatever follows from both has the interval of the jackknife that leaves out one group
/// at a time.
class FrameEstimate {
public:
    /// `blocks`: the work of the blocks that the sample is drawn from; `confidence`: of its
    /// intervals, 0 .. 1.
    FrameEstimate(const AcceleratorConfig& config, const FrameWorkload& frame,
                  const std::vector<TileWork>& blocks, double confidence = kConfidence);

    /// After preprocessing and the first tiles of the frame.
    void begin(const AcceleratorResult& head);
    void add_block(std::size_t block, std::size_t group, const WindowPart& measured);
    /// Counters before and after a group, and the work of all the tiles that it simulated.
    void add_group(const AcceleratorResult& earlier, const AcceleratorResult& after,
                   const TileWork& simulated);
    /// The last tiles: counters before and after them, what the tiles at both ends of the frame
    /// have of the window, and the work of the tiles that came before the last ones to warm up.
    void end(const AcceleratorResult& earlier, const AcceleratorResult& after,
             const WindowPart& edges, const TileWork& warm_up);

    /// Half of the interval over the value, as far as the sample has come.
    double relative_half_width(const std::string& path) const;
    /// The estimated result of a frame with so many tiles that list a splat.
    AcceleratorResult whole_frame(std::size_t tiles) const;
    /// The intervals of all numbers of the report from `timing` to `dram`, and of `energy`.
    std::vector<ReportInterval> intervals() const;

private:
    static constexpr std::size_t kTotal = kSlotClasses.size(); ///< measure of the regression
    using Slots = std::array<double, kSlotClasses.size() + 1>;
    Slots edge_slots() const;
    Slots slots_without(std::size_t group) const;
    AcceleratorResult frame_of(const Slots& slots, const std::vector<double>& amounts) const;
    AcceleratorResult frame_without(std::size_t group) const;
    /// The total of the tiles between the ends of the frame, with what the order of the tiles may
    /// cost.
    Estimate own_total(std::size_t measure) const;
    /// The interval that the regression gives itself; width 0 if `path` is not of its kind.
    double own_half_width(const std::string& path) const;
    double jackknife(const std::vector<double>& without) const;
    double known_share() const;

    const AcceleratorConfig& config_;
    std::uint64_t pixels_ = 0;
    std::size_t blocks_ = 0;
    double confidence_;
    RegressionEstimator regression_;
    GroupTotals totals_;
    TileWork rest_ = kNoWork;
    AcceleratorResult raw_; ///< the latest counters of the sample
    WindowPart edges_;
};

} // namespace degs::sim
