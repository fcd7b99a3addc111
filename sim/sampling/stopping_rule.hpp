// SPDX-License-Identifier: Apache-2.0
// How large the pieces of a sample are, and when it is large enough.
#pragma once

#include <cstddef>

#include "sim/sampling/sample_design.hpp"
#include "sim/sampling/sampling_request.hpp"

namespace degs::sim {

/// Groups before the first look at the interval: fewer say too little about their own scatter, and
/// a sample that looks narrow by chance ends too soon.
inline constexpr std::size_t kLeastGroups = 8;
/// Above this share of the tiles an exact run takes little longer, and is exact.
inline constexpr double kMostShare = 0.5;
/// Above this share of the memory's peak, requests of other tiles hold up those of a tile: a sample
/// has fewer of them, and at other dates. Measured: docs/sampling.md.
inline constexpr double kMostMemoryUse = 1.0 / 3;

/// Tiles that fill a pipeline with so many tile contexts: those in flight, and those whose lists
/// are read ahead of them.
std::size_t warm_up_tiles(int contexts);
/// For a frame with so many tiles that list a splat.
SampleSizes sizes_for(int contexts, std::size_t tiles);
/// Whether a frame of so many tiles that list a splat has the groups of two first looks, and,
/// unless a share is asked for, the first look costs much less than an exact run.
bool can_sample(const SamplingRequest& request, int contexts, std::size_t tiles);
/// The least number of tiles of a frame from which on all frames can be sampled.
std::size_t least_tiles(const SamplingRequest& request, int contexts);

enum class Verdict {
    More,      ///< go on
    Enough,    ///< the interval is as narrow, or the share as large, as was asked for
    Hopeless,  ///< an exact run is better
    Contended, ///< the memory is used too much for tiles to be taken out of their order
};
/// `share`: of the tiles, so far; `reached`: half of the interval over the value; `more`: whether
/// tiles are left.
Verdict judge_sample(const SamplingRequest& request, double share, double reached, bool more);

} // namespace degs::sim
