// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "splat/frame/frame_workload.hpp"

namespace degs {

/// The order in which the splat records of a frame lie in memory. `Index`: that of their Gaussians
/// in the scene. `Morton`: that of the Morton code of the Gaussian's position, so that neighbours
/// in space are neighbours in memory.
enum class RecordOrder { Index, Morton };

/// Where each splat record of a frame lies among the records of the frame.
class RecordPlaces {
public:
    RecordPlaces(const FrameWorkload& frame, RecordOrder order);

    /// The places of the records, by splat.
    const std::uint32_t* of_splats() const { return of_splats_.data(); }
    /// The places by the Gaussian's rank among the visible ones in scene order; nullptr: the place
    /// is the rank.
    const std::uint32_t* of_visible() const {
        return of_visible_.empty() ? nullptr : of_visible_.data();
    }

private:
    std::vector<std::uint32_t> of_splats_, of_visible_;
};

/// Ranks of positions in the order of their Morton codes: 21 bits per axis of the smallest cube
/// with sides parallel to the axes that holds all of them. Equal codes keep their order.
std::vector<std::uint32_t> morton_ranks(const std::vector<glm::vec3>& positions);

} // namespace degs
