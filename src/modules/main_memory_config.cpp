// SPDX-License-Identifier: Apache-2.0
#include "modules/main_memory_config.hpp"

namespace degs {

void MainMemoryConfig::describe(ConfigVisitor& visitor) {
    visitor.choice(
        "model", model, {"bus", "lpddr5"},
        "bus: one data bus with latency, bandwidth_gb_per_s and latency_ns count; lpddr5: "
        "channels, banks and rows, the section of that name counts");
    Memory::Config::describe(visitor);
    visitor.section("lpddr5", lpddr5, "the keys of configs/memory/*.yaml");
}

} // namespace degs
