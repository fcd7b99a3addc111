// SPDX-License-Identifier: Apache-2.0
// Estimates the totals of a frame from the counters of the groups of a sample.
#pragma once

#include <cstddef>
#include <vector>

#include "splat/frame/tile_work.hpp"

namespace degs::sim {

/// Counts of the groups: each amount is scaled with the size that varies with it most closely.
class GroupTotals {
public:
    /// What was counted once and is known: the edges of the frame and its preprocessing.
    explicit GroupTotals(std::vector<double> known) : known_(std::move(known)) {}

    /// Amounts of a group and the work of all the tiles that it simulated.
    void add(std::vector<double> amounts, const TileWork& work);
    std::size_t groups() const { return amounts_.size(); }
    void add_known(const std::vector<double>& amounts);

    /// Totals of the frame; `rest`: the work of the tiles that are not known. `left_out`: a group
    /// to do without, or groups() for none.
    std::vector<double> totals(const TileWork& rest, std::size_t left_out) const;

private:
    /// Position of the size whose ratio to the amount differs least between the groups.
    std::size_t best_size(std::size_t amount) const;

    std::vector<double> known_;
    std::vector<std::vector<double>> amounts_;
    std::vector<TileWork> work_;
};

} // namespace degs::sim
