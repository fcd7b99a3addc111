// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int baselines_design = 1;
} // namespace own
