// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace degs::sim {

/// Spearman's correlation of ranks of two lists of the same length; empty for fewer than three.
std::optional<double> rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

} // namespace degs::sim
