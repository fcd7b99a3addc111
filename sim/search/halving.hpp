// SPDX-License-Identifier: Apache-2.0
// A search by successive halving: all designs on small images, the better part on larger ones, what
// is left on the images that were asked for (K. Jamieson, A. Talwalkar, Non-stochastic Best Arm
// Identification, AISTATS 2016).
#pragma once

#include <cstddef>
#include <vector>

#include "sim/search/searcher.hpp"

namespace degs::sim {

struct HalvingOptions {
    int rungs = 3;         ///< images have 1 / 2^(rungs - 1) of their sides in the first
    int share = 3;         ///< one of so many designs goes on to the next rung
    std::size_t least = 8; ///< designs that go on at least
};

class Halving final : public Searcher {
public:
    /// The plan lists all designs, and outlives this object.
    Halving(const StudyPlan& plan, const HalvingOptions& options);

    std::optional<Step> next() override;
    void take(const Rung& rung) override;
    const std::vector<Rung>& rungs() const override { return rungs_; }
    Facts facts() const override;

private:
    const StudyPlan& plan_;
    HalvingOptions options_;
    std::vector<std::size_t> variants_; ///< that go on
    std::vector<Rung> rungs_;
};

} // namespace degs::sim
