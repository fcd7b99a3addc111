// SPDX-License-Identifier: Apache-2.0
// The two pictures of a comparison and that of a memory, 800 px wide, in colours that people with
// any colour vision can tell apart (M. Okabe, K. Ito, Color Universal Design, 2008).
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace degs::sim {

/// One class of slots: its key in reports and its colour in every picture.
struct SlotClass {
    const char* key;
    const char* colour;
};
/// In the order of all reports and pictures.
constexpr std::array<SlotClass, 7> kSlotClasses{{
    {"useful", "#009e73"},
    {"boundary", "#e69f00"},
    {"terminated", "#d55e00"},
    {"conflict", "#cc79a7"},
    {"starved", "#56b4e9"},
    {"blocked", "#0072b2"},
    {"drain", "#999999"},
}};

struct SlotBar {
    std::string label;            ///< left of the bar
    std::string note;             ///< right of it
    std::array<double, 7> shares; ///< by class, sum 1
};

struct SlotGroup {
    std::string heading;
    std::vector<SlotBar> bars;
};

/// Horizontal bars of 100 % of the PE-cycles, one group below the other.
std::string slots_svg(const std::string& title, const std::vector<SlotGroup>& groups);

struct UtilizationLine {
    std::string label;
    std::vector<std::pair<int, double>> points; ///< PEs (> 0), share 0 .. 1; any order
};

struct UtilizationPanel {
    std::string heading;
    std::vector<UtilizationLine> lines; ///< the same labels in every panel
};

/// Utilization over the number of PEs, which doubles from tick to tick; two panels side by side.
std::string utilization_svg(const std::string& title, const std::vector<UtilizationPanel>& panels);

/// A point of a load-latency curve; shares of the peak.
struct LoadPoint {
    double offered = 0, carried = 0;
    double mean_ns = 0, p95_ns = 0;
};

/// Mean and 95th percentile of the latency over the load that is carried.
std::string load_latency_svg(const std::string& title, const std::vector<LoadPoint>& points);

} // namespace degs::sim
