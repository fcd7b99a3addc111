// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/visible_text.hpp"
#include "config/config_words.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/simulation/frame_changes.hpp"
#include "sim/text/output_columns.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

std::string digits(const std::optional<double>& value) {
    return value ? three_digits(*value) : "";
}

std::string fixed_ratio(const std::optional<double>& value) {
    return value ? percent(*value / 100, 2) : "";
}

std::string share(const std::optional<double>& value) {
    return value ? percent(*value) : "";
}

std::string whole(const std::optional<int>& value) {
    return value ? std::to_string(*value) : "";
}

std::string decibels(const std::optional<double>& value) {
    return value ? (*value > 1e9 ? "identical" : percent(*value / 100)) : "";
}

std::string megabytes(const Measures& m) {
    const auto& read = m[Measure::DramRead];
    const auto& written = m[Measure::DramWritten];
    return read && written ? three_digits((*read + *written) * 1e-6) : "";
}

/// Shares of the slots, then of the whole frame.
std::vector<std::string> slot_cells(const Measures& m, const std::vector<std::size_t>& classes) {
    std::vector<std::string> cells;
    cells.reserve(classes.size() + 1);
    for (const std::size_t c : classes) {
        cells.push_back(share(m[slot_measure(kSlotClasses[c].slot)]));
    }
    cells.push_back(share(m[Measure::FrameUtilization]));
    return cells;
}

std::vector<std::string> ratio_cells(const Measures& m) {
    return {fixed_ratio(m[Measure::LatencyRatio]), fixed_ratio(m[Measure::LatencyRatioPerArea]),
            fixed_ratio(m[Measure::ThroughputRatio]),
            fixed_ratio(m[Measure::ThroughputRatioPerArea])};
}

std::vector<std::string> joined(std::vector<std::string> head,
                                const std::vector<std::string>& middle,
                                const std::vector<std::string>& tail = {}) {
    head.insert(head.end(), middle.begin(), middle.end());
    head.insert(head.end(), tail.begin(), tail.end());
    return head;
}

const std::vector<std::string> kRatioHeadings{"speed ×", "per mm²", "path ×", "per mm²"};

/// With half of the interval, if it is an estimate.
std::string cycles_cell(const ComparisonRow& row) {
    const std::optional<double>& cycles = row.measures[Measure::Cycles];
    if (!cycles) {
        return "";
    }
    const bool known = row.cycles_low && row.cycles_high && *cycles > 0;
    return scaled(*cycles) +
           (known ? " ±" + percent((*row.cycles_high - *row.cycles_low) / 2 / *cycles) + " %" : "");
}

std::string time_table(const Comparison& comparison, std::size_t view) {
    TextTable table(joined({"", "PEs", "tile", "cycles", "ms", "fps", "path fps", "DRAM MB", "mm²"},
                           kRatioHeadings, {"PSNR dB"}));
    for (const ComparisonRow& row : comparison.rows) {
        const ComparedConfig& config = comparison.configs[row.config];
        const Measures& m = row.measures;
        if (row.view == view) {
            table.add(joined({config.name, whole(config.pes), whole(config.tile_size),
                              cycles_cell(row), digits(m[Measure::LatencyMs]),
                              digits(m[Measure::Fps]), digits(m[Measure::ThroughputFps]),
                              megabytes(m), fixed_ratio(m[Measure::AreaMm2])},
                             ratio_cells(m), {decibels(m[Measure::PsnrDb])}));
        }
    }
    return table.text();
}

/// What the frame was limited by, as far as busy shares tell.
std::string limits_table(const Comparison& comparison, std::size_t view) {
    TextTable table({"of the frame, %", "preprocessing", "DRAM busy", "limited by"});
    for (const ComparisonRow& row : comparison.rows) {
        const Measures& m = row.measures;
        if (row.view == view) {
            const auto& cycles = m[Measure::Cycles];
            const auto& before = m[Measure::PreprocessingCycles];
            const bool known = cycles && before && *cycles > 0 && !comparison.array_only;
            table.add({comparison.configs[row.config].name, known ? percent(*before / *cycles) : "",
                       share(m[Measure::DramUtilization]), row.limited_by});
        }
    }
    return table.text();
}

/// A table of the energies of frames, from the rows of a view or from the means.
std::string energy_table(const Comparison& comparison, const std::vector<ComparisonRow>& rows,
                         std::size_t view) {
    TextTable table({"energy of a frame", "mJ", "nJ per pixel", "W", "energy ×", "per mm²"});
    constexpr double kMjPerNj = 1e-6;
    for (const ComparisonRow& row : rows) {
        const Measures& m = row.measures;
        const std::optional<double>& nj = m[Measure::NjPerFrame];
        if (row.view == view) {
            table.add({comparison.configs[row.config].name, nj ? digits(*nj * kMjPerNj) : "",
                       digits(m[Measure::NjPerPixel]), digits(m[Measure::AveragePowerW]),
                       fixed_ratio(m[Measure::EnergyRatio]),
                       fixed_ratio(m[Measure::EnergyRatioPerArea])});
        }
    }
    return table.text();
}

/// Positions in kSlotClasses; a rare class only if a run has it.
std::vector<std::size_t> slot_classes(const Comparison& comparison) {
    std::vector<std::size_t> classes;
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        const auto occurs = [c](const ComparisonRow& row) {
            return row.measures[slot_measure(kSlotClasses[c].slot)].value_or(0) > 0;
        };
        if (!kSlotClasses[c].rare ||
            std::any_of(comparison.rows.begin(), comparison.rows.end(), occurs)) {
            classes.push_back(c);
        }
    }
    return classes;
}

std::string slots_table(const Comparison& comparison, std::size_t view) {
    std::vector<std::string> headings{"PE-cycles, %"};
    const std::vector<std::size_t> classes = slot_classes(comparison);
    for (const std::size_t c : classes) {
        headings.emplace_back(kSlotClasses[c].name);
    }
    headings.emplace_back("useful of the frame");
    TextTable table(headings);
    for (const ComparisonRow& row : comparison.rows) {
        if (row.view == view) {
            table.add(
                joined({comparison.configs[row.config].name}, slot_cells(row.measures, classes)));
        }
    }
    return table.text();
}

std::string means_table(const Comparison& comparison) {
    TextTable table(
        joined({"", "ms", "fps", "path fps"}, kRatioHeadings, {"useful %", "of the frame %"}));
    for (const ComparisonRow& row : comparison.means) {
        const Measures& m = row.measures;
        table.add(joined({comparison.configs[row.config].name, digits(m[Measure::LatencyMs]),
                          digits(m[Measure::Fps]), digits(m[Measure::ThroughputFps])},
                         ratio_cells(m),
                         {share(m[Measure::Utilization]), share(m[Measure::FrameUtilization])}));
    }
    return table.text();
}

/// Rows of equal_area_text(), from the rows of a view or from the means.
void add_equal_area(TextTable& table, const Comparison& comparison,
                    const std::vector<ComparisonRow>& rows, std::size_t view) {
    const std::optional<double> first = comparison.configs[comparison.baseline].area_mm2;
    constexpr double kMjPerNj = 1e-6;
    for (const ComparisonRow& row : rows) {
        const std::optional<double> own = comparison.configs[row.config].area_mm2;
        if (row.view != view || !first || !own || !(*own > 0)) {
            continue;
        }
        const Measures& m = row.measures;
        const double copies = *first / *own;
        const auto times = [](const std::optional<double>& value, double factor) {
            return value ? digits(*value * factor) : "";
        };
        table.add({comparison.configs[row.config].name, fixed_ratio(copies),
                   times(m[Measure::LatencyMs], 1 / copies),
                   times(m[Measure::ThroughputFps], copies),
                   times(m[Measure::NjPerFrame], kMjPerNj / copies),
                   fixed_ratio(m[Measure::LatencyRatioPerArea]),
                   fixed_ratio(m[Measure::ThroughputRatioPerArea]),
                   fixed_ratio(m[Measure::EnergyRatioPerArea])});
    }
}

std::string heading(const ComparedView& view, bool estimated) {
    std::string words = view_words(view) + " · " + grouped(view.visible) + " of " +
                        grouped(view.gaussians) + " Gaussians visible";
    if (view.fragments) {
        words += " · " + scaled(*view.fragments) + " fragments";
    }
    words += estimated ? " · estimated" : "";
    return folded(visible(words), output_columns(), 2) + "\n";
}

/// A line on how much the frames differ, if there are several.
std::string changes_line(const ComparedView& view) {
    return view.changes
               ? folded("frames: " + changes_words(*view.changes), output_columns(), 2) + "\n"
               : "";
}

std::string frames_words(const Comparison& comparison) {
    const std::string count = std::to_string(comparison.frames) + " frames";
    const std::string step = config_words::number(comparison.path_step_degrees) + "° each";
    if (!comparison.has_dynamic_scene()) {
        return count + " of " + step;
    }
    const std::string changing = "the first " + count + " of a scene that changes";
    return comparison.has_camera_path() ? changing + ", of " + step + " where none does" : changing;
}

std::string legend(const Comparison& comparison) {
    if (comparison.is_estimated()) {
        return folded(
                   "all numbers are estimates of the analytic model, not simulations; speed: 1 / "
                   "latency of one frame alone; " +
                       visible(comparison.configs.front().name) + " = 1",
                   output_columns(), 2) +
               "\n";
    }
    const std::string first = visible(comparison.configs.front().name);
    std::string words = "speed: 1 / latency of one frame alone; " + first + " = 1";
    if (comparison.frames > 1) {
        words += "; path: throughput over " + frames_words(comparison) + ", " + first + " = 1";
    }
    words += "; energy: frames per joule, " + first + " = 1";
    words += comparison.array_only ? "; arrays alone, without front ends and memory" : "";
    return folded(words, output_columns(), 2) + "\n";
}

} // namespace

std::string views_text(const Comparison& comparison, std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t v = begin; v < end; ++v) {
        text += heading(comparison.views[v], comparison.is_estimated()) +
                changes_line(comparison.views[v]) + time_table(comparison, v) + "\n" +
                limits_table(comparison, v) + "\n" + energy_table(comparison, comparison.rows, v) +
                "\n";
        if (!comparison.is_estimated()) { // an estimate has no classes of slots
            text += slots_table(comparison, v) + "\n";
        }
    }
    return text;
}

std::string closing_text(const Comparison& comparison) {
    if (comparison.rows.empty()) {
        return "";
    }
    std::string text;
    if (!comparison.means.empty()) {
        text += "geometric means over " + std::to_string(comparison.views.size()) + " views\n" +
                means_table(comparison) + "\n" +
                energy_table(comparison, comparison.means, comparison.views.size()) + "\n";
    }
    for (const FailedRun& failed : comparison.failed) {
        text += "failed: " + visible(failed.sentence) + "\n";
    }
    return text + legend(comparison);
}

std::string equal_area_text(const Comparison& comparison) {
    if (comparison.rows.empty()) {
        return "";
    }
    const ComparedConfig& first = comparison.configs[comparison.baseline];
    std::string text =
        folded("at the area of " + visible(first.name) + ", " + fixed_ratio(first.area_mm2) +
                   " mm²: as if speed and frames per joule were in proportion to the area",
               output_columns(), 2) +
        "\n";
    const auto table_of = [&](const std::vector<ComparisonRow>& rows, std::size_t view,
                              const std::string& words) {
        TextTable table({words, "area ×", "ms", "path fps", "mJ", "speed ×", "path ×", "energy ×"});
        add_equal_area(table, comparison, rows, view);
        return table.text() + "\n";
    };
    for (std::size_t v = 0; v < comparison.views.size(); ++v) {
        text += table_of(comparison.rows, v, view_words(comparison.views[v]));
    }
    if (!comparison.means.empty()) {
        text += table_of(comparison.means, comparison.views.size(), "geometric means");
    }
    return text;
}

std::string comparison_text(const Comparison& comparison) {
    return views_text(comparison, 0, comparison.views.size()) + closing_text(comparison);
}

} // namespace degs::sim
