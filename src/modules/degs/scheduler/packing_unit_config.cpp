// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/packing_unit.hpp"

namespace degs {

void PackingUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer(
        "bytes", bytes, 16, 1 << 30,
        "bytes (paper Table I: 32 KB), split among banks: waiting segments, then packets");
    visitor.integer("task_bytes", task_bytes, 1, 256,
                    "bytes per task: G_ID, x, y, n, g0, d0, tags [assumed]");
    visitor.integer("lead_packets", lead_packets, 1, 65536,
                    "packets of a bank that may wait for its array slice; limits nothing while "
                    "packets_per_cycle is 1 [assumed]");
    visitor.integer("latency_cycles", latency_cycles, 1, 64,
                    "cycles from issue to execution: prefix sum and shift, buffer read [assumed]");
    visitor.integer(
        "packets_per_cycle", packets_per_cycle, 1, 64,
        "packets of a bank that can be written per cycle; a segment that completes more keeps the "
        "next ones waiting, and the array executes one per cycle [assumed]");
    visitor.boolean("reorganisation", reorganisation,
                    "compact tasks of different spans into one packet (paper, Sec. IV-B); false: "
                    "for ablations");
    segment_ports.describe(
        visitor, "segments written and segments read per cycle and bank; 0: unlimited [assumed]");
}

} // namespace degs
