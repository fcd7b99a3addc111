// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int base_error = 1;
} // namespace own
