// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "modules/kit/analytic/front_end_load.hpp"
#include "modules/kit/analytic/ring_dates.hpp"

namespace degs {

/// Projection Units and Tile Binner without cycles, chunk by chunk of Gaussians: chunks differ in
/// what is visible of them, so that now memory, now projection, now binning is the slowest. Memory
/// serves all that a chunk moves when it serves its geometry.
class PreparationDates {
public:
    struct Chunk {
        double projecting = 0, shading = 0, binning = 0; ///< cycles of a unit, and of the binner
        double bytes = 0;                                ///< moved to and from memory
    };

    PreparationDates(const ProjectionUnit::Config& projection, const TileBinner::Config& binning,
                     const MemoryRate& memory);
    /// The next chunk, which goes to the next unit in turn.
    void add(const Chunk& chunk);
    /// The date at which the lists may be read.
    double end() const { return acknowledged_; }

private:
    struct Unit {
        RingDates fetched, projected, binned; ///< places for chunks behind each step
        double projector = 0, shader = 0;     ///< when they are free
    };
    double projection_latency_;
    MemoryRate memory_;
    std::vector<Unit> units_;
    std::size_t next_ = 0;
    RingDates writes_; ///< acknowledgements
    double served_ = 0, binner_ = 0, acknowledged_ = 0;
};

} // namespace degs
