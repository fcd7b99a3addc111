// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int driver_driver = 1;
} // namespace own
