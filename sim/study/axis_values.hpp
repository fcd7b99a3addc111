// SPDX-License-Identifier: Apache-2.0
// Values of one key as a study lists them.
#pragma once

#include <vector>

#include "sim/study/axis.hpp"

namespace degs::sim {

/// An interval "LOW..HIGH" or "LOW..HIGH log", from which values are drawn.
std::optional<Draw> read_interval(const ConfigNode& node);

/// Reads a value, a range ("16KB..256KB x2", "1..8 +1") or a list of these. Throws InputError.
std::vector<AxisValue> read_values(const ConfigNode& node);

} // namespace degs::sim
