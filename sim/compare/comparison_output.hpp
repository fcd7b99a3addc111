// SPDX-License-Identifier: Apache-2.0
// A comparison for people, programs and spreadsheets.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "sim/results/comparison.hpp"
#include "sim/study/compare_request.hpp"

namespace degs::sim {

/// Whether designs are shown as they are, or as if each took the area of the first: its speed and
/// its frames per joule times the area of the first / its own.
enum class AreaScale { Own, Equal };

/// Raised whenever a key of compare.json changes its meaning, name or unit.
constexpr int kComparisonVersion = 1;

/// Tables for the terminal of the views from `begin` up to, but without, `end`.
std::string views_text(const Comparison& comparison, std::size_t begin, std::size_t end);
/// What follows the views: geometric means, failures, and what the ratios mean. Empty if no run has
/// succeeded.
std::string closing_text(const Comparison& comparison);
/// What latency, throughput and energy would be at the area of the first configuration, and their
/// ratios: a row for each view and configuration, and geometric means over several views.
std::string equal_area_text(const Comparison& comparison);
/// All views, then what follows them.
std::string comparison_text(const Comparison& comparison);
/// compare.json
nlohmann::ordered_json comparison_json(const Comparison& comparison);
/// compare.csv: a row per run, numbers in full; a cell without a number is empty.
std::string comparison_csv(const Comparison& comparison);

/// index.html; its keys are those in which the configurations differ.
std::string comparison_page(const std::vector<NamedConfig>& configs, const Comparison& comparison);

/// slots.svg; empty if no run has blended anything.
std::string slots_picture(const Comparison& comparison);
/// ratios.svg: latency, throughput and energy of every configuration against the first, by view and
/// as geometric means; empty unless several configurations were run.
std::string ratios_picture(const Comparison& comparison, AreaScale scale);
/// utilization.svg; empty unless configurations of several PE counts were run.
std::string utilization_picture(const Comparison& comparison);

} // namespace degs::sim
