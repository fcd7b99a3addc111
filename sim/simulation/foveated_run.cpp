// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/foveated_run.hpp"

namespace degs::sim {
namespace {

/// The images of the levels of image `number`, where `image_at` is that of a view of the frame.
template <class ImageAt>
std::vector<const Image*> levels_at(const FoveationFacts& facts, std::size_t number,
                                    const ImageAt& image_at) {
    const std::size_t count = facts.images[number].view.levels.size();
    std::vector<const Image*> images;
    for (std::size_t level = 0; level < count; ++level) {
        images.push_back(&image_at(number * count + level));
    }
    return images;
}

} // namespace

void put_foveation(const FoveatedViews& views, RunResult& result) {
    FoveationFacts& facts = result.foveation.emplace();
    facts.asked = views.asked;
    const auto drawn = [&](std::size_t view) -> const Image& {
        return result.accelerator.images[view];
    };
    for (const FoveatedView& view : views.images) {
        FoveatedImage& image = facts.images.emplace_back();
        image.view = view; // levels_at() counts its levels
        image = foveated_image(view, levels_at(facts, facts.images.size() - 1, drawn));
    }
    result.camera = views.images.front().camera;
}

void judge_foveation(RunResult& result, const std::vector<Reference>& levels,
                     const std::vector<Reference>& full) {
    FoveationFacts& facts = *result.foveation;
    const auto reference = [&](std::size_t view) -> const Image& { return levels[view].image; };
    for (std::size_t i = 0; i < facts.images.size(); ++i) {
        judge(facts.images[i], levels_at(facts, i, reference), full[i].image);
    }
    result.error = facts.images.front().error;
}

std::uint64_t drawn_pixels(const RunResult& result) {
    std::uint64_t pixels = result.views.empty() ? result.workload.pixels : 0;
    for (const ViewFacts& view : result.views) {
        pixels += view.workload.pixels;
    }
    return pixels;
}

} // namespace degs::sim
