// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace degs {

/// Which Gaussians a user wants of a scene that a file holds at several levels of detail. Without
/// any of them every place is shown at its finest level.
struct SceneDetail {
    std::optional<int> level;            ///< this one everywhere; 0 is the finest
    std::optional<std::uint64_t> budget; ///< the finest levels that have at most so many Gaussians

    bool asked() const { return level.has_value() || budget.has_value(); }
};

} // namespace degs
