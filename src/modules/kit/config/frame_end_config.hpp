// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"

namespace degs {

/// The end of a frame, which the paper leaves open and all accelerators share; see
/// docs/background-writer.md.
struct FrameEndConfig {
    int background_cycles_per_write = 1; ///< of the Background Writer
    int gate_latency_cycles = 1;         ///< from the last report of a frame to its listeners
    void describe(ConfigVisitor& visitor) {
        visitor.integer("background_cycles_per_write", background_cycles_per_write, 1, 1024,
                        "cycles from one write of background pixels to the next [assumed]");
        visitor.integer("gate_latency_cycles", gate_latency_cycles, 1, 1024,
                        "cycles from a frame's last report to who waits for it [assumed]");
    }
};

} // namespace degs
