// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/stopping_rule.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"

namespace degs::sim {

std::size_t warm_up_tiles(int contexts) {
    return std::size_t{2} + contexts;
}

SampleSizes sizes_for(int contexts, std::size_t tiles) {
    SampleSizes sizes;
    const std::size_t warm = warm_up_tiles(contexts);
    sizes.edge = 4 * warm;
    sizes.block = tiles >= 400 ? 4 : tiles >= 200 ? 2 : 1;
    // The states in which a pipeline fills and empties must be few beside the others; but the first
    // look should not come later than a frame needs. It then has 11 % of the blocks or 360, which
    // is enough for residuals as skew as they are (25 times the square of the skewness; Cochran,
    // Sampling Techniques, 1977).
    sizes.group = std::max(2 * sizes.block, std::min(30 * sizes.block, tiles / 110));
    return sizes;
}

bool can_sample(const SamplingRequest& request, int contexts, std::size_t tiles) {
    /// The share of the tiles that may be simulated before the first look. Beyond it the groups are
    /// few, and intervals of degs-256, which looked at 31 %, held in 80 % of the runs only.
    constexpr double kFirstLook = 0.3;
    const SampleSizes sizes = sizes_for(contexts, tiles);
    if (tiles < 2 * sizes.edge + 2 * kLeastGroups * sizes.group) {
        return false;
    }
    const std::size_t warm = warm_up_tiles(contexts);
    const std::size_t group = sizes.group + contexts * (sizes.group / sizes.block) + warm;
    return request.share > 0 ||
           ratio_of(2 * sizes.edge + warm + kLeastGroups * group, tiles) <= kFirstLook;
}

std::size_t least_tiles(const SamplingRequest& request, int contexts) {
    constexpr std::size_t kAlways = 2000; // of any frame this large a small part is enough
    std::size_t least = kAlways * warm_up_tiles(contexts);
    while (least > 1 && can_sample(request, contexts, least - 1)) {
        --least;
    }
    return least;
}

std::size_t groups_at_look(std::size_t number) {
    constexpr double kGrowth = 1.25;
    return static_cast<std::size_t>(
        std::ceil(real_of(kLeastGroups) * std::pow(kGrowth, static_cast<double>(number))));
}

Verdict judge_sample(const SamplingRequest& request, double share, double reached, bool more) {
    if (request.share > 0) {
        return share >= request.share || !more ? Verdict::Enough : Verdict::More;
    }
    return reached <= request.within      ? Verdict::Enough
           : !more || share >= kMostShare ? Verdict::Spent
                                          : Verdict::More;
}

} // namespace degs::sim
