// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/supply/gaussian_buffer.hpp"

namespace degs {

void GaussianBufferConfig::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 256, 1 << 30, "bytes (paper Table I: 72 KB)");
    visitor.real(
        "sort_share", sort_share, 0.05, 0.95,
        "share of the buffer for lists being sorted; the rest holds sorted splats [assumed]");
    ports.describe(visitor,
                   "splats written by a fetcher, and read by the Slicing Units that share a part, "
                   "per cycle and SRAM bank; 0: unlimited [assumed]",
                   "SRAM banks of such a part; splats are dealt to them in turn [assumed]");
    visitor.choice(
        "temporary", temporary, {"sliced", "spans"},
        "how long a chunk of splats keeps its place: until the last is sliced [assumed: rows carry "
        "what Span Units need], or until all spans are made (paper, Sec. IV-A)");
}

} // namespace degs
