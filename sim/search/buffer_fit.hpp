// SPDX-License-Identifier: Apache-2.0
// Which buffers of a design are larger than its views need.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim/search/search_step.hpp"
#include "sim/study/axis.hpp"
#include "sim/sweep/design_space.hpp"

namespace degs::sim {

/// An axis for every buffer of a design whose bytes are a key and not among the `fixed` ones, from
/// its own size downwards: 1, 3/4, 1/2, 3/8, 1/4 and so on, as far as these are whole bytes.
std::vector<Axis> buffer_axes(const RunConfig& design, const std::vector<std::string>& fixed);

/// Makes buffers smaller as long as the design is within the limits of the plan, of which the first
/// tells how much is lost: each alone, by half or else by the next size, then all together that
/// may be smaller alone. Where that is too much, the one that loses most alone waits. A buffer is
/// small enough once the next size alone breaks a limit: others only shrink beside it.
class BufferFit : public SearchSteps {
public:
    /// The space has the axes of buffer_axes() and one design; it adds to the plan, which has this
    /// design. Both outlive this object.
    BufferFit(DesignSpace& space, const StudyPlan& plan);

    std::optional<Step> next() override;
    void take(const StepResults& results) override;

    /// The smallest design that was found; that as it stands if nothing was.
    std::size_t smallest() const { return variant_; }
    /// What was found of it; empty if it failed.
    const DesignVerdict& verdict() const { return verdicts_.at(variant_); }
    /// Designs that were simulated.
    std::size_t simulated() const { return verdicts_.size(); }
    const StepResults& results() const { return results_; }

private:
    struct Shrinking {
        std::size_t axis = 0;
        Genes place; ///< with this axis smaller
    };
    /// What each axis that may still be smaller would be alone.
    std::vector<Shrinking> singles() const;
    /// The axis is tried by a smaller step from now on, or not any more.
    void refuse(std::size_t axis);
    /// The verdict on a place; null if it is not known yet. It is not within the limits if it
    /// cannot be built or failed.
    const DesignVerdict* verdict_on(const Genes& place);
    /// Runs the places, with all that ran before.
    Step step_of(const std::vector<Genes>& places);

    DesignSpace& space_;
    const StudyPlan& plan_;
    Genes place_;
    std::size_t variant_ = 0;
    std::vector<std::size_t> steps_; ///< positions by which an axis shrinks next; 0: it does not
    std::map<std::size_t, DesignVerdict> verdicts_; ///< by variant
    std::vector<std::size_t> asked_;                ///< variants of the last step
    StepResults results_;                           ///< of the last step: of all
};

} // namespace degs::sim
