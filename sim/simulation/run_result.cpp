// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/run_result.hpp"

#include <algorithm>

namespace degs::sim {

std::size_t images_of(const RunResult& result) {
    return result.foveation ? result.foveation->images.size()
                            : std::max<std::size_t>(1, result.views.size());
}

const Image& image_of(const RunResult& result, std::size_t image) {
    return result.foveation ? result.foveation->images[image].image
                            : result.accelerator.images[image];
}

const std::optional<ImageError>& error_of(const RunResult& result, std::size_t image) {
    return result.foveation       ? result.foveation->images[image].error
           : result.views.empty() ? result.error
                                  : result.views[image].error;
}

std::uint64_t drawn_pixels(const RunResult& result) {
    std::uint64_t pixels = result.views.empty() ? result.workload.pixels : 0;
    for (const ViewFacts& view : result.views) {
        pixels += view.workload.pixels;
    }
    return pixels;
}

} // namespace degs::sim
