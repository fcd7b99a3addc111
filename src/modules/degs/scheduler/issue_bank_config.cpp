// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/issue_bank.hpp"

namespace degs {

void IssueBank::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("banks", banks, 1, 64,
                    "Issue Banks, Packing Units and array slices (paper Table III)");
    visitor.integer("queue_segments_per_pe", queue_segments_per_pe, 0, kMostSegmentsPerPe,
                    "segments waiting per bank and PE of its slice; 0: what packing.bytes leaves "
                    "beside packing.lead_packets [assumed]");
    visitor.integer(
        "segment_bytes", segment_bytes, 1, 256,
        "bytes per waiting segment, part of packing.bytes: g0 4, d0 4, G_ID 2, mask and "
        "link 2 [assumed]");
    visitor.integer("segment_length", segment_length, 1, 32,
                    "px, stride of the Segmenter (paper: 1 x 16)");
    visitor.integer("segments_per_cycle", segments_per_cycle, 1, 64,
                    "segments cut and queued per bank and cycle [assumed]");
    visitor.integer("issue_width", issue_width, 1, 64,
                    "segments issued per bank and cycle [assumed]");
    visitor.integer("select_cycles", select_cycles, 0, 8,
                    "cycles from the choice of the segments of a cycle to their packing; 0: they "
                    "are chosen and packed one after the other in one cycle [assumed]");
    visitor.integer(
        "reuse_cycles", reuse_cycles, 1, 64,
        "cycles between two updates of a segment (paper: 4); not below array.writeback_cycles");
    visitor.integer("tiles", tiles, 0, 64,
                    "tiles whose segments may wait in a bank, with one tile stream; 0: as many as "
                    "have a context, and at least 2, so that the next tile waits there for its "
                    "context [assumed]");
    visitor.boolean("scoreboard", scoreboard,
                    "enforce reuse_cycles; false: a pixel that comes again before its write-back "
                    "reads the older state, and the image is wrong");
    visitor.choice(
        "termination", termination, {"segment", "task", "pixel"},
        "what is skipped: all segments of a region of segment_length pixels that has ended "
        "(paper), segments whose own pixels have all ended, or single ended pixels");
    visitor.choice("scan", scan, {"round_robin", "oldest", "deepest"},
                   "which ready conflict domain issues first [assumed]");
}

} // namespace degs
