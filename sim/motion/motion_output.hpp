// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "sim/motion/motion.hpp"

namespace degs::sim {

/// Words about what was rendered, for headings.
struct MotionWords {
    std::string scene, size;        ///< "flowers", "640×427"
    bool estimated = false;         ///< by the analytic model
    std::optional<double> eyes_m{}; ///< distance of the two views of each frame, m; empty: one view
};

/// "640×427", or "2 × 640×427" for eyes.
std::string size_words(const MotionWords& words);

/// A table in words: for terminals and for the page.
struct MotionTable {
    std::vector<std::string> headings;
    std::vector<std::vector<std::string>> rows;
};
/// Percentiles of the latency, by design.
MotionTable latency_table(const Motion& motion);
/// What displays show, by rate and design.
MotionTable display_table(const Motion& motion);

nlohmann::ordered_json motion_json(const MotionWords& words, const Motion& motion);
/// A row for each frame, a column for each design.
std::string motion_csv(const Motion& motion);
/// Tables for the terminal.
std::string motion_text(const MotionWords& words, const Motion& motion);

/// Latency over the time of the path, with what is in time at which rate.
std::string motion_latency_svg(const MotionWords& words, const Motion& motion);
/// Shares of the refreshes that show a new image, by rate and design.
std::string motion_refresh_svg(const MotionWords& words, const Motion& motion);
/// Both pictures and the numbers; needs nothing else.
std::string motion_page(const MotionWords& words, const Motion& motion);

} // namespace degs::sim
