// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/supply/gaussian_buffer.hpp"

namespace degs {

void GaussianBufferConfig::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 256, 1 << 30, "bytes (paper Table I: 72 KB)");
    visitor.real("sort_share", sort_share, 0.05, 0.95,
                 "share of the buffer for lists being sorted [assumed]");
    ports.describe(
        visitor, "splats written, and splats read, per cycle and SRAM bank; 0: unlimited [assumed]",
        "SRAM banks of a part that Slicing Units share [assumed]");
    visitor.choice("temporary", temporary, {"sliced", "spans"},
                   "how long a chunk of splats keeps its place: until the last is sliced "
                   "[assumed], or until all spans are made (paper, Sec. IV-A)");
}

} // namespace degs
