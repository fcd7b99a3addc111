// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int cost_technology = 1;
} // namespace own
