// SPDX-License-Identifier: Apache-2.0
// The pictures of a comparison and that of a memory, 800 px wide, in colours that people with
// any colour vision can distinguish (M. Okabe, K. Ito, Color Universal Design, 2008).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "modules/kit/job/slot_account.hpp"

namespace degs::sim {

/// One colour for each of kSlotClasses, in every picture.
constexpr std::array<const char*, kSlotClasses.size()> kSlotColours{
    "#009e73", "#e69f00", "#d55e00", "#cc79a7", "#f0e442",
    "#a9a1d8", "#56b4e9", "#0072b2", "#999999"};

struct SlotBar {
    std::string label; ///< left of the bar
    std::string note;  ///< right of it
    /// By class, sum 1.
    std::array<double, kSlotClasses.size()> shares;
    /// From the start of the run: first task, end of the last one, end of the frame.
    double first_ms = 0, last_ms = 1, end_ms = 1;
};

struct SlotGroup {
    std::string heading;
    std::vector<SlotBar> bars;
};

/// Horizontal bars as long as a frame takes, one group below the other, each with its own axis of
/// time. The classes share out the part between the first task and the last.
std::string slots_svg(const std::string& title, const std::vector<SlotGroup>& groups);

struct UtilizationLine {
    std::string label;
    std::vector<std::pair<int, double>> points; ///< PEs (> 0), share 0 .. 1; any order
};

struct UtilizationPanel {
    std::string heading;
    std::vector<UtilizationLine> lines; ///< every panel has the same labels
};

/// Utilization over the number of PEs, which doubles from tick to tick; two panels side by side.
std::string utilization_svg(const std::string& title, const std::vector<UtilizationPanel>& panels);

/// The designs in one measure on one view, or in its mean over the views.
struct RatioGroup {
    std::string label;
    std::vector<std::optional<double>> ratios; ///< by design; a missing one leaves a gap
};

struct RatioPanel {
    std::string heading; ///< the measure, and what 1 is
    std::vector<RatioGroup> groups;
};

/// Vertical bars from 0, one panel below the other, with a line at 1.
std::string ratios_svg(const std::string& title, const std::vector<std::string>& designs,
                       const std::vector<RatioPanel>& panels);

/// How a design is shown among others.
struct FrontMark {
    bool on_front = false; ///< no other beats it
    bool baseline = false;
    bool within = true; ///< the limits
};

/// A design in two goals, both > 0.
struct FrontPoint {
    double x = 0, y = 0;
    FrontMark mark{};
};

/// Designs in two goals on logarithmic axes with the front of those that nobody beats; in the order
/// of x, the best first. The labels say which values are better.
std::string front_svg(const std::string& title, const std::string& x_label,
                      const std::string& y_label, const std::vector<FrontPoint>& points,
                      const std::string& best = "nobody is better in both");

/// A design in three goals or more, all > 0.
struct ManyGoals {
    std::vector<double> goals;
    FrontMark mark{};
};

/// A small chart for every pair of goals, on logarithmic axes that a column and a row share. The
/// labels of the goals say which values are better.
std::string front_pairs_svg(const std::string& title, const std::vector<std::string>& labels,
                            const std::vector<ManyGoals>& designs);

/// A point of a load-latency curve; shares of the peak.
struct LoadPoint {
    double offered = 0, carried = 0;
    double mean_ns = 0, p95_ns = 0;
};

/// Mean and 95th percentile of the latency over the load that is carried.
std::string load_latency_svg(const std::string& title, const std::vector<LoadPoint>& points);

} // namespace degs::sim
