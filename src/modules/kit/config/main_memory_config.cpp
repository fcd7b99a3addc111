// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/config/main_memory_config.hpp"

namespace degs {

void MainMemoryConfig::describe(ConfigVisitor& visitor) {
    visitor.choice(
        "model", model, {"bus", "lpddr5"},
        "bus: one data bus with latency; lpddr5: channels, banks and rows, with keys of its own");
    Memory::Config::describe(visitor);
    visitor.choice("layout", layout, {"index", "morton"},
                   "order of splat records in memory: that of the Gaussians, or of the Morton code "
                   "of their positions");
    visitor.choice("priority", priority, {"age", "blending"},
                   "reads that enter a channel's queues first: the older, or those of the frame "
                   "that is blended");
    visitor.real("urgent_share", urgent_share, 0.0, 1.0,
                 "share of a channel's read queue that priority: blending keeps free [assumed]");
    visitor.section("lpddr5", lpddr5, "the keys of configs/memory/*.yaml");
    if (priority == ReadPriority::Age) {
        visitor.unused("urgent_share", "priority", "memory.priority is age");
    }
    if (model == MemoryModel::Bus) {
        visitor.unused("lpddr5", "model", "memory.model is bus");
        visitor.unused("layout", "model", "memory.model is bus, which has no addresses");
        return;
    }
    constexpr const char* kReason = "memory.model is lpddr5, which has keys of its own";
    for (const char* key : {"bandwidth_gb_per_s", "latency_ns", "access_bytes"}) {
        visitor.unused(key, "model", kReason);
    }
    visitor.unused("lpddr5.controller.qos_step", "model",
                   "all reads of an accelerator have the same level; memories of platforms have "
                   "several initiators");
}

} // namespace degs
