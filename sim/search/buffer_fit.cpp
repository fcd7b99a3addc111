// SPDX-License-Identifier: Apache-2.0
#include "sim/search/buffer_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "base/grouped_number.hpp"
#include "config/config_document.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kHalf = 2; ///< positions between a size and its half

bool is_buffer(const KeyDoc& key) {
    const std::string end = ".bytes";
    return key.type == "integer" && key.path.size() > end.size() &&
           key.path.compare(key.path.size() - end.size(), end.size(), end) == 0 &&
           key.path.rfind("cost.", 0) != 0; // rows of a table of costs are no buffers
}

/// The sizes of a buffer, in bytes.
std::vector<double> sizes_below(double own) {
    std::vector<double> sizes;
    for (double size = own; size >= 1 && std::floor(size) == size; size /= 2) {
        sizes.push_back(size);
        if (std::floor(size * 3 / 4) != size * 3 / 4) {
            break;
        }
        sizes.push_back(size * 3 / 4);
    }
    return sizes;
}

} // namespace

std::vector<Axis> buffer_axes(const RunConfig& design, const std::vector<std::string>& fixed) {
    std::vector<Axis> axes;
    for (const KeyDoc& key : document(design)) { // of its present values
        const double own = std::strtod(key.default_value.c_str(), nullptr);
        if (!is_buffer(key) || own <= 0 ||
            std::find(fixed.begin(), fixed.end(), key.path) != fixed.end()) {
            continue;
        }
        Axis axis{key.path, "'degs buffers'", {key.path}, {}};
        for (const double size : sizes_below(own)) {
            axis.positions.push_back({AxisValue{axis.place, decimal_text(size), {}, {}}});
        }
        axes.push_back(std::move(axis));
    }
    return axes;
}

BufferFit::BufferFit(DesignSpace& space, const StudyPlan& plan)
    : space_(space), plan_(plan), place_(space.genes().size(), 0), variant_(plan.baseline),
      steps_(space.genes().size(), kHalf) {
    steps_.front() = 0; // which design it is
}

std::vector<BufferFit::Shrinking> BufferFit::singles() const {
    std::vector<Shrinking> singles;
    for (std::size_t axis = 0; axis < steps_.size(); ++axis) {
        if (steps_[axis] != 0) {
            singles.push_back({axis, place_});
            singles.back().place[axis] += steps_[axis];
        }
    }
    return singles;
}

void BufferFit::refuse(std::size_t axis) {
    steps_[axis] /= kHalf;
}

const DesignVerdict* BufferFit::verdict_on(const Genes& place) {
    static const DesignVerdict kNone;
    for (std::size_t axis = 0; axis < place.size(); ++axis) {
        if (place[axis] >= space_.genes()[axis].positions) {
            return &kNone;
        }
    }
    const std::optional<std::size_t> variant = space_.add(place).variant;
    if (!variant) {
        return &kNone;
    }
    const auto known = verdicts_.find(*variant);
    return known == verdicts_.end() ? nullptr : &known->second;
}

Step BufferFit::step_of(const std::vector<Genes>& places) {
    asked_ = {plan_.baseline};
    for (const auto& [variant, verdict] : verdicts_) {
        if (!verdict.goals.empty()) { // what failed is not tried again
            asked_.push_back(variant);
        }
    }
    for (const Genes& place : places) {
        asked_.push_back(space_.add(place).variant.value());
    }
    std::sort(asked_.begin(), asked_.end());
    asked_.erase(std::unique(asked_.begin(), asked_.end()), asked_.end());
    Step step{asked_, PartRuns::AsPlanned, ""};
    step.spent = grouped(asked_.size()) + " designs simulated";
    return step;
}

std::optional<Step> BufferFit::next() {
    if (verdicts_.empty()) {
        return step_of({});
    }
    while (verdict().is_within()) {
        std::vector<Shrinking> fit;
        std::vector<Genes> unknown;
        for (Shrinking& single : singles()) {
            const DesignVerdict* const found = verdict_on(single.place);
            if (found == nullptr) {
                unknown.push_back(single.place);
            } else if (found->is_within()) {
                fit.push_back(std::move(single));
            } else {
                refuse(single.axis);
            }
        }
        if (!unknown.empty()) {
            return step_of(unknown);
        }
        if (fit.empty() &&
            std::all_of(steps_.begin(), steps_.end(), [](std::size_t step) { return step == 0; })) {
            break;
        }
        // The one that loses least first: the last one waits where all together lose too much.
        std::stable_sort(fit.begin(), fit.end(), [&](const Shrinking& a, const Shrinking& b) {
            return verdict_on(a.place)->limits.front().value.value_or(0) >
                   verdict_on(b.place)->limits.front().value.value_or(0);
        });
        for (; !fit.empty(); fit.pop_back()) {
            Genes joint = place_;
            for (const Shrinking& single : fit) {
                joint[single.axis] = single.place[single.axis];
            }
            const DesignVerdict* const found = verdict_on(joint);
            if (found == nullptr) {
                return step_of({joint});
            }
            if (found->is_within()) {
                place_ = std::move(joint);
                variant_ = space_.add(place_).variant.value();
                break;
            }
        }
    }
    return {};
}

void BufferFit::take(const StepResults& results) {
    for (const std::size_t variant : asked_) {
        verdicts_[variant]; // of what failed nothing is known
    }
    for (const Candidate& candidate : results.candidates) {
        verdicts_[candidate.variant] = candidate.verdict;
    }
    results_ = results;
}

} // namespace degs::sim
