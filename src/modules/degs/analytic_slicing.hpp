// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "modules/kit/analytic/ring_dates.hpp"

namespace degs {

/// The Slicing Units of a module without cycles, see GaussianSlicingUnit: splats begin in order, in
/// the unit that is free first, and a row is sent when every older splat in work has passed it.
class AnalyticSlicing {
public:
    /// Each unit takes `splats_per_cycle` splats; a tile has `rows` rows.
    AnalyticSlicing(int units, int splats_per_cycle, int rows);

    /// Begins a tile, not before `date`. A unit sends at most so many of its rows in a cycle.
    void begin_tile(double date, std::size_t rows_per_cycle);
    /// Begins the next splat, which is there at `arrived`. Returns the date at which a unit takes
    /// it.
    double begin(double arrived);
    /// Returns the date at which row `row` of the splat may be sent.
    double send(int row);
    /// Makes all units wait until `date`, because the row finds no place in its lane before.
    void stall(double date);
    /// Ends the splat after its last row. Returns the cycles that it was in the unit.
    double end();
    /// The date at which all splats so far have been sent.
    double done() const { return done_; }

private:
    double cycles_per_splat_;    ///< at least
    std::vector<double> free_;   ///< by unit
    std::vector<double> passed_; ///< by row: when all splats so far have passed it; rising
    std::vector<double> recent_; ///< the latest rows of the splat, a cycle's worth
    std::size_t sent_ = 0;       ///< rows of the splat
    std::size_t cell_ = 0;       ///< of recent_, for the next one
    int next_row_ = 0;           ///< that the splat has not passed
    double begun_ = 0, latest_ = 0, done_ = 0;
    double stalled_ = 0, stalled_until_ = 0; ///< when the units stood still the last time
};

} // namespace degs
