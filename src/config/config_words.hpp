// SPDX-License-Identifier: Apache-2.0
// Words for values in configuration errors and documentation.
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
/// Returns 'text' in quotes, on one line and of bounded length, whatever a file contains.
std::string quote(const std::string& text);

/// `text` as it is written between the bars of a Markdown table.
std::string markdown_cell(std::string text);

/// Returns "1 to 64", "at least 1", "at most 64" or "any"; a bound at the end of its type does not
/// count.
std::string range(std::int64_t low, std::int64_t high);
std::string range(double low, double high);

/// Returns the candidate that `word` most likely misspells; empty if more than a third of the
/// letters differ for all of them.
std::string nearest(const std::string& word, const std::vector<std::string>& candidates);

/// Returns the only candidate whose description in `doc` ("candidate: description; ...") has
/// `word`, one of at least four letters; else an empty text.
std::string described(const std::string& word, const std::vector<std::string>& candidates,
                      const std::string& doc);

} // namespace degs::config_words
