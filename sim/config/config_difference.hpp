// SPDX-License-Identifier: Apache-2.0
// What two configurations have not in common: degs config --diff.
#pragma once

#include <string>
#include <vector>

#include "config/config_document.hpp"

namespace degs::sim {

/// A key with its values in two configurations; empty where a configuration has no such key.
struct KeyDifference {
    std::string path, first, second;
};

/// The keys whose values differ, in the order of `first`, then those of `second` alone.
std::vector<KeyDifference> difference(const std::vector<KeyDoc>& first,
                                      const std::vector<KeyDoc>& second);

/// A table with a column for each configuration; "-" where it has no such key. One sentence if
/// there is no difference.
std::string difference_text(const std::vector<KeyDifference>& keys, const std::string& first,
                            const std::string& second);
std::string difference_markdown(const std::vector<KeyDifference>& keys, const std::string& first,
                                const std::string& second);

} // namespace degs::sim
