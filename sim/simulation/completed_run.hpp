// SPDX-License-Identifier: Apache-2.0
// What the result of run_frames() gets from the view: its scene, its foveated images and the
// references.
#pragma once

#include <functional>

#include "sim/simulation/run_result.hpp"
#include "sim/view/foveated_view.hpp"
#include "sim/view/reference.hpp"

namespace degs::sim {

/// Puts in the scene, whose notes become the first warnings.
void put_scene(const SceneFacts& scene, RunResult& result);

/// Composes the images of the first frame from those of its views, which are the levels of `views`,
/// image by image.
void put_foveation(const FoveatedViews& views, RunResult& result);

/// Finds the error of the image of a view, the first of which is 0.
using ImageComparison =
    std::function<ImageError(std::size_t view, const Image& reference, const Image& test)>;
/// compare_images()
ImageError error_of_view(std::size_t view, const Image& reference, const Image& test);

/// Fills in the references of the first frame, and the errors of its images against them.
void judge(RunResult& result, const References& references,
           const ImageComparison& compare = error_of_view);

} // namespace degs::sim
