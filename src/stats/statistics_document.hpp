// SPDX-License-Identifier: Apache-2.0
// The statistics of a run on their way out: into results and into the manual.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "stats/statistics.hpp"

namespace degs {

/// One row: a section (without unit and value), or a number.
struct Statistic {
    std::string path; ///< hierarchical name, e.g. "stages.span.rows"
    std::string unit;
    std::string sentence;
    bool section = false;
    StatValue value;
};

using DescribeStats = std::function<void(StatsVisitor&)>;
/// The statistics that this run has.
std::vector<Statistic> list_statistics(const DescribeStats& describe);
/// The statistics that any run of the kind may have.
std::vector<Statistic> document_statistics(const DescribeStats& describe);

/// Values nested by section; what does not exist is null, infinity the string "inf".
nlohmann::ordered_json statistics_json(const std::vector<Statistic>& list);

/// The statistic of this name. Throws InputError, which suggests a name, if there is none.
const Statistic& find_statistic(const std::vector<Statistic>& list, const std::string& path);
/// The section of this name and all that is in it, or the single statistic that `path` names. An
/// empty path stands for all. Throws InputError likewise.
std::vector<Statistic> statistics_in(const std::vector<Statistic>& list, const std::string& path);

/// Numbers that neighbouring sections have in common, "busy" of every stage, once: "stages.*.busy",
/// at the place of the first.
std::vector<Statistic> shared_once(const std::vector<Statistic>& list);

/// A Markdown table of key, unit and meaning; keys without the prefix `section`.
std::string statistics_markdown(const std::vector<Statistic>& list, const std::string& section);
/// "path [unit]", then the sentence, indented; lines of at most 80 characters where words permit.
std::string statistics_text(const std::vector<Statistic>& list);

} // namespace degs
