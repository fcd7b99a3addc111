// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int platform_accelerator = 1;
} // namespace own
