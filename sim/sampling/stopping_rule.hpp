// SPDX-License-Identifier: Apache-2.0
// How large the pieces of a sample are, when it is looked at, and when it is large enough.
#pragma once

#include <cstddef>

#include "sim/sampling/sample_design.hpp"
#include "sim/sampling/sampling_request.hpp"

namespace degs::sim {

/// Groups before the first look at the interval: fewer say too little about their own scatter.
inline constexpr std::size_t kLeastGroups = 12;
/// Above this share of simulated tiles a sample may take as long as an exact run: a tile out of
/// its order takes up to half as long again as in it, and expecting the work of all tiles up to 0.4
/// of an exact run.
inline constexpr double kMostShare = 0.4;
/// Above this share of the memory's peak, requests of other tiles hold up those of a tile: a sample
/// has fewer of them, and at other dates. Measured: docs/sampling.md.
inline constexpr double kMostMemoryUse = 0.25;
/// A tile that follows another than its neighbour finds the pipeline in another state, which
/// changes what is sampled by this share. Measured: docs/sampling.md.
inline constexpr double kPipelineError = 0.003;

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

/// The confidence of the intervals that a growing sample is looked at with. A run that ends when
/// its interval looks narrow prefers samples whose scatter is small by chance; replays of all
/// designs (docs/sampling.md) show that this costs up to 4 points, so that 95 % are left.
inline constexpr double kLookConfidence = 0.98;
/// The groups of a sample at look `number`, from 0: a quarter more than at the look before.
std::size_t groups_at_look(std::size_t number);

enum class Verdict {
    More,   ///< go on
    Enough, ///< the interval is as narrow, or the share as large, as was asked for
    Spent,  ///< as many tiles as pay have been simulated, and the interval is wider
};
/// `share`: of the tiles, so far: measured ones if a share was asked for, and else simulated ones;
/// `reached`: half of the interval over the value; `more`: whether
/// tiles are left.
Verdict judge_sample(const SamplingRequest& request, double share, double reached, bool more);

} // namespace degs::sim
