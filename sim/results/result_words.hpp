// SPDX-License-Identifier: Apache-2.0
// Numbers and rows of results as JSON and CSV write them.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "sim/results/comparison.hpp"

namespace degs::sim {

/// As degs::number_json(), which is of infinity and of what is not a number. Counts are written as
/// such, what does not exist is null.
nlohmann::ordered_json number_json(const std::optional<double>& value);

/// Puts a measure into a run: its name with '/' for '.' is the place.
void put_measure(nlohmann::ordered_json& run, Measure measure, const std::optional<double>& value);

/// Puts the numbers of single buffers and blocks into a run likewise.
void put_parts(nlohmann::ordered_json& run, const ComparisonRow& row);
/// The headings of their columns in CSV.
std::string part_headings(const std::vector<std::string>& names);
/// The names of all stages or parts, in the order in which rows first have them; and the cells of a
/// row in CSV.
std::vector<std::string> names_of(const std::vector<ComparisonRow>& rows,
                                  NamedNumbers RunNumbers::*list);
std::string named_cells(const ComparisonRow& row, NamedNumbers RunNumbers::*list,
                        const std::vector<std::string>& names);

/// The columns in CSV that say what was run on which view: headings, and the cells of a row.
std::string run_headings();
std::string run_cells(const Comparison& comparison, const ComparisonRow& row);

nlohmann::ordered_json view_json(const ComparedView& view);

/// `interval`: that of the cycles of an estimate or a sample, and the share of the tiles that were
/// sampled; else nothing.
void put_interval(nlohmann::ordered_json& run, const ComparisonRow& row);
/// The columns of these in CSV, behind all others and only if a row has an interval: headings, and
/// the cells of a row.
bool any_interval(const std::vector<ComparisonRow>& rows);
std::string interval_headings();
std::string interval_cells(const ComparisonRow& row);

/// Quoted if it must be, with quotes doubled (RFC 4180), and with an apostrophe in front of what
/// programs for tables would calculate. Characters that do things to a terminal are written as
/// their codes.
std::string csv_cell(const std::string& text);
/// As number_json(), but empty if it does not exist.
std::string csv_number(const std::optional<double>& value);

} // namespace degs::sim
