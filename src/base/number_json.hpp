// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace degs {

/// JSON has no infinity: it is the string "inf" or "-inf". What is not a number is null.
nlohmann::ordered_json number_json(double value);

} // namespace degs
