// SPDX-License-Identifier: Apache-2.0
// Numbers and rows of results as JSON and CSV write them.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "sim/results/comparison.hpp"

namespace degs::sim {

template <class Value>
nlohmann::ordered_json value_or_null(const std::optional<Value>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

/// As degs::number_json(), which is of infinity and of what is not a number. Counts are written as
/// such, what does not exist is null.
nlohmann::ordered_json number_json(const std::optional<double>& value);

/// Puts a measure into a run: its name with '/' for '.' is the place.
void put_measure(nlohmann::ordered_json& run, Measure measure, const std::optional<double>& value);

/// Puts the numbers of single buffers and blocks into a run likewise.
void put_parts(nlohmann::ordered_json& run, const ComparisonRow& row);
/// The names of all of them, in the order in which rows first have them; the headings of their
/// columns in CSV; and the cells of a row.
std::vector<std::string> part_names(const std::vector<ComparisonRow>& rows);
std::string part_headings(const std::vector<std::string>& names);
std::string part_cells(const ComparisonRow& row, const std::vector<std::string>& names);

nlohmann::ordered_json view_json(const ComparedView& view);

/// Share of the tiles and interval of the cycles, for a run that was a sample; else nothing.
void put_sampling(nlohmann::ordered_json& run, const ComparisonRow& row);
/// The columns of these in CSV, behind all others and only if a row was a sample: headings, and the
/// cells of a row.
bool any_sampled(const std::vector<ComparisonRow>& rows);
std::string sampling_headings();
std::string sampling_cells(const ComparisonRow& row);

/// Quoted if it must be, with quotes doubled (RFC 4180), and with an apostrophe in front of what
/// programs for tables would calculate. Characters that do things to a terminal are written as
/// their codes.
std::string csv_cell(const std::string& text);
/// As number_json(), but empty if it does not exist.
std::string csv_number(const std::optional<double>& value);

} // namespace degs::sim
