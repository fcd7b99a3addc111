// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace degs::sim {

/// The ELF file of driver/firmware, which the build compiles; empty if it had no cross compiler.
std::vector<unsigned char> built_in_firmware();

} // namespace degs::sim
