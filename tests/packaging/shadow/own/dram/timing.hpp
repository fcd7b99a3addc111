// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int dram_timing = 1;
} // namespace own
