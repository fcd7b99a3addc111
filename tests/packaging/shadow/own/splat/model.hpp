// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int splat_model = 1;
} // namespace own
