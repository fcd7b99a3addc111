// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int modules_config = 1;
} // namespace own
