// SPDX-License-Identifier: Apache-2.0
// A page with the plots and the table of many runs, which needs no network.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/results/comparison.hpp"

namespace degs::sim {

/// What a page says about a comparison beyond the comparison.
struct PageFacts {
    std::string title;
    bool swept = false; ///< the keys are axes, else those in which the configurations differ
    std::vector<std::string> keys; ///< one column each
    struct Axis {
        std::string name;
        std::vector<std::size_t> keys; ///< positions in `keys`; they change together
    };
    std::vector<Axis> axes; ///< of more than one key
    struct Variant {
        std::string design;
        std::vector<std::optional<std::string>> values; ///< in the order of `keys`
        std::vector<std::optional<double>> goals{};     ///< over all views
        bool on_front = false;
        std::string within{}; ///< "yes", the limits that are broken, or empty: unknown
    };
    struct Goal {
        std::string name;
        bool larger_is_better = false;
    };
    std::vector<Goal> goals;
    bool limited = false;            ///< whether there are limits
    std::vector<Variant> variants;   ///< in the order of the configurations
    std::vector<std::size_t> points; ///< numbers from 1, by row
    std::vector<std::pair<std::string, std::string>> skipped; ///< what, and why
    std::vector<std::pair<std::string, std::string>> failed;
    std::size_t missing = 0;
    std::string picture{}; ///< SVG of latency over bandwidth, if the study varies it
    std::string spent{};   ///< what a search has spent: "60 designs estimated, 12 simulated"
};

constexpr const char* kPageFile = "index.html";

/// The page: measures of the host are left out, so that it depends only on what was simulated.
std::string study_page(const PageFacts& facts, const Comparison& comparison);

/// The text with `&`, `<` and `>` as HTML writes them.
std::string html_escaped(const std::string& text);

} // namespace degs::sim
