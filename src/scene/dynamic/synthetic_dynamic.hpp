// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/dynamic/spacetime.hpp"
#include "scene/synthetic/synthetic.hpp"

namespace degs {

/// Profile of the synthetic scene that changes over time.
constexpr const char* kSyntheticDynamic = "dynamic";

/// A table with things on it in front of a wall, all still, and on it a ball that flies in an arc,
/// a column that sways and turns, and steam, puffs of which appear and fade; see
/// docs/dynamic-scenes.md. The same on every platform with IEEE arithmetic.
SpacetimeCloud make_spacetime(const SyntheticSpec& spec);

} // namespace degs
