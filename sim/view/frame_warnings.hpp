// SPDX-License-Identifier: Apache-2.0
// What a reader should know of frames and their images, in sentences.
#pragma once

#include <string>
#include <vector>

#include "splat/images/image.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs::sim {

/// One sentence for each number format of the data path that splats of `frame` leave.
std::vector<std::string> saturation_warnings(const DataPathOptions& options,
                                             const FrameWorkload& frame);
/// A sentence if the colours of pixels have reached the end of the format of their sums.
std::vector<std::string> saturation_warnings(const DataPathOptions& options, const Image& image);
/// A sentence if the near plane removes Gaussians that lie inside the view, with the key that moves
/// it.
std::vector<std::string> near_plane_warnings(const CullCounts& culled,
                                             const ProjectionOptions& options,
                                             std::uint64_t gaussians);
std::vector<std::string> near_plane_warnings(const FrameWorkload& frame);
/// The sentence on the near plane for the frame of a path that loses the most Gaussians.
class WorstNearPlane {
public:
    void add(const FrameWorkload& frame);
    const std::vector<std::string>& sentences() const { return sentences_; }

private:
    std::uint64_t most_ = 0;
    std::vector<std::string> sentences_;
};
/// A sentence for a lens whose distortion the rules leave out, if that moves a corner of the image
/// by a hundredth of a pixel or more.
std::vector<std::string> lens_warnings(const Camera& camera, const ProjectionOptions& options);

} // namespace degs::sim
