// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace own {
constexpr int tlm_memory = 1;
} // namespace own
