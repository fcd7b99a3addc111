// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "modules/kit/job/sram_ports.hpp"

namespace degs {

/// The Span Buffer (paper Table I): rows of splats between Slicing Units and Span Units.
struct SpanBufferConfig {
    int bytes = 2 * 1024;
    int row_bytes = 8;
    SramPorts ports; ///< of a lane
    void describe(ConfigVisitor& visitor);
};

} // namespace degs
