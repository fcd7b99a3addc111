// SPDX-License-Identifier: Apache-2.0
// The words in which configuration errors and documentation speak about values.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace degs::config_words {

/// Shortest decimal text that reads back as the same double.
std::string number(double value);
std::string number(std::int64_t value);
/// "memory" + "latency_ns" = "memory.latency_ns"; the root section has the empty path.
std::string join_path(const std::string& section, const std::string& key);
std::string list(const std::vector<std::string>& words);
/// 'text' on one line and of bounded length, whatever a file may contain.
std::string quote(const std::string& text);

/// `text` as it is written between the bars of a Markdown table.
std::string markdown_cell(std::string text);

/// "1 to 64", "at least 1", "at most 64" or "any": a bound at the end of its type is no bound.
std::string range(std::int64_t low, std::int64_t high);
std::string range(double low, double high);

/// The candidate that `word` most likely misspells; empty when none is near (a third of the
/// letters).
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

} // namespace degs::config_words
