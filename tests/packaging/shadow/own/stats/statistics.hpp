// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int stats_statistics = 1;
} // namespace own
