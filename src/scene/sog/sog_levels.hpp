// SPDX-License-Identifier: Apache-2.0
// Which level of detail each place of a streamed SOG scene is shown at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/files/scene_detail.hpp"
#include "scene/sog/sog_index.hpp"

namespace degs {

struct SogChoice {
    std::vector<SogRun> runs;       ///< one per leaf at most
    std::vector<std::string> notes; ///< full sentences: what is shown, and what is left out
};

/// Level `detail.level` of every leaf, which is nothing where a leaf has no such level. Or within a
/// budget: the finest level that fits for all leaves (a coarser leaf stays at its finest one
/// beyond, or at its coarsest), and the next finer one for as many leaves as still fit, those that
/// need the fewest more Gaussians first; `environment` Gaussians count, too. Else the finest level
/// of every leaf. InputError "<where>: ..." if no leaf has the level or no level fits.
SogChoice choose_sog_levels(const std::string& where, const SogIndex& index,
                            const SceneDetail& detail, std::uint64_t environment);

} // namespace degs
