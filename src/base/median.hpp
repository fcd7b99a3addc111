// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

namespace degs {

/// The mean of the two in the middle if they are even in number; empty if there are none.
std::optional<double> median_of(std::vector<double> values);

} // namespace degs
