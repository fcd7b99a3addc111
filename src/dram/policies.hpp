// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "dram/policy.hpp"

namespace degs::dram {

/// All scheduling policies with the defaults of their keys; the first one is the default.
std::vector<PolicyHolder> all_policies();

} // namespace degs::dram
