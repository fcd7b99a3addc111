// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cost/technology.hpp"
#include "modules/degs/bank_logic.hpp"

namespace degs {

/// What the blocks of DeGS take. docs/cost.md argues every value.
struct DegsCostRows {
    cost::UnitRow projection{0.92, 0.60, 4}, sorting{0.02, 0.01, 4}, span_engine{0.17, 0.09, 10};
    cost::UnitRow packing_scheduler{0.07, 0.04, 8}, blending{0.88, 0.23, 64};
    QueueMemory segment_queue = QueueMemory::Sram;
    cost::PortedSramRow gaussian_buffer{{0.31, 0.01, 72 * 1024, 192}, 1, 4};
    cost::PortedSramRow feature_buffer{{0.03, 0.001, 8 * 1024, 256}, 1, 8};
    cost::PortedSramRow span_buffer{{0.04, 0.001, 2 * 1024, 128}, 1, 1};
    cost::PortedSramRow packing_buffer{{0.16, 0.02, 32 * 1024, 2240}, 2, 1};
    cost::PortedSramRow pixel_buffer{{0.12, 0.01, 16 * 1024, 1024}, 1, 32};
    void describe(cost::RowSection& section);
};

/// What an array of DeGS has done, counted by a simulation or expected by an estimate.
struct DegsWork {
    double slicing_cycles = 0, issue_cycles = 0;
    double splats_fetched = 0;      ///< records that enter the Gaussian Buffer
    double splats_sliced = 0;       ///< records that Slicing Units take from it
    double keys_moved = 0;          ///< by the sorters
    double supplied = 0;            ///< records through the Splat Supply, in and out
    double rows_sent = 0, rows = 0; ///< of splats, by Slicing Units, and solved
    double features = 0;            ///< entries written to the Feature Buffer
    double segments_issued = 0, segments_dropped = 0, packets = 0;
    double slots = 0; ///< PE-cycles with a task
};

} // namespace degs
