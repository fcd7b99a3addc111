// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/span_buffer.hpp"

namespace degs {

void SpanBufferConfig::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 8, 1 << 30,
                    "bytes (paper Table I: 2 KB), split among Span Units");
    visitor.integer("row_bytes", row_bytes, 1, 256,
                    "bytes per row work item: G_ID 4, row 2, tags 2 [assumed]");
    ports.describe(visitor, "rows written and rows read per cycle and lane, which is an SRAM bank; "
                            "0: unlimited [assumed]");
}

} // namespace degs
