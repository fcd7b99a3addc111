// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/preparation_dates.hpp"

#include <algorithm>

namespace degs {

PreparationDates::PreparationDates(const ProjectionUnit::Config& projection,
                                   const TileBinner::Config& binning, const MemoryRate& memory)
    : projection_latency_(projection.latency_cycles), memory_(memory),
      units_(projection.count,
             {RingDates(projection.chunks_in_flight), RingDates(projection.chunks_in_flight),
              RingDates(projection.chunks_ahead)}),
      writes_(binning.writes_in_flight) {}

// A chunk has the place of the one before until a step takes it; its colours are read when it has
// been projected.
void PreparationDates::add(const Chunk& chunk) {
    Unit& unit = units_[next_];
    next_ = next_ + 1 == units_.size() ? 0 : next_ + 1;
    served_ = std::max(served_, unit.fetched.oldest()) + memory_.stream_cycles(chunk.bytes);
    const double fetched = std::max(served_ + memory_.latency, unit.projector);
    unit.fetched.replace_oldest(fetched);
    unit.projector = std::max(fetched + chunk.projecting, unit.projected.oldest());
    const double coloured = unit.projector + std::max(projection_latency_, memory_.latency);
    const double shaded = std::max(coloured, unit.shader);
    unit.projected.replace_oldest(shaded);
    unit.shader = std::max(shaded + chunk.shading, unit.binned.oldest());
    const double taken = std::max(unit.shader, binner_);
    unit.binned.replace_oldest(taken);
    binner_ = std::max(taken + chunk.binning, writes_.oldest());
    acknowledged_ = std::max(served_, binner_) + memory_.latency;
    writes_.replace_oldest(acknowledged_);
}

} // namespace degs
