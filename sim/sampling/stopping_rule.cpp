// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/stopping_rule.hpp"

#include <algorithm>

#include "base/ratio.hpp"

namespace degs::sim {
namespace {

/// The share of the tiles at which the interval will be as narrow as was asked for: its square
/// falls with the number of tiles, but for the correction that a finite number of them brings.
double share_needed(double share, double reached, double within) {
    const double odds = share / (1 - share) * (reached / within) * (reached / within);
    return odds / (1 + odds);
}

} // namespace

std::size_t warm_up_tiles(int contexts) {
    return std::size_t{2} + contexts;
}

SampleSizes sizes_for(int contexts, std::size_t tiles) {
    SampleSizes sizes;
    const std::size_t warm = warm_up_tiles(contexts);
    sizes.edge = 4 * warm;
    sizes.block = tiles >= 400 ? 4 : tiles >= 200 ? 2 : 1;
    // The states in which a pipeline fills and empties must be few beside the others; but the first
    // look should not come later than a frame needs.
    sizes.group = std::max(2 * sizes.block, std::min(10 * sizes.block, tiles / 75));
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

Verdict judge_sample(const SamplingRequest& request, double share, double reached, bool more) {
    if (request.share > 0) {
        return share >= request.share || !more ? Verdict::Enough : Verdict::More;
    }
    if (reached <= request.within) {
        return Verdict::Enough;
    }
    // The first looks are uncertain, so that what seems a little too much is still tried.
    constexpr double kBenefitOfDoubt = 1.5;
    const bool hopeless =
        !more || share > kMostShare ||
        share_needed(share, reached, request.within) > kBenefitOfDoubt * kMostShare;
    return hopeless ? Verdict::Hopeless : Verdict::More;
}

} // namespace degs::sim
