// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/completed_run.hpp"

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

void judge_foveation(FoveationFacts& facts, const References& references) {
    const auto level = [&](std::size_t view) -> const Image& {
        return references.views[view].image;
    };
    for (std::size_t i = 0; i < facts.images.size(); ++i) {
        judge(facts.images[i], levels_at(facts, i, level), references.full[i].image);
    }
}

} // namespace

void put_scene(const SceneFacts& scene, RunResult& result) {
    result.scene = scene;
    result.warnings.insert(result.warnings.begin(), scene.notes.begin(), scene.notes.end());
}

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

ImageError error_of_view(std::size_t /*view*/, const Image& reference, const Image& test) {
    return compare_images(reference, test);
}

void judge(RunResult& result, const References& references, const ImageComparison& compare) {
    const Reference& first = references.views.front();
    result.host.render_s = first.render_s;
    result.workload.reference = first.counts;
    result.error = compare(0, first.image, result.accelerator.images.front());
    for (std::size_t v = 0; v < result.views.size(); ++v) {
        const Reference& reference = references.views[v];
        result.views[v].workload.reference = reference.counts;
        result.views[v].error =
            v == 0 ? result.error : compare(v, reference.image, result.accelerator.images[v]);
    }
    if (result.foveation) {
        judge_foveation(*result.foveation, references);
        result.error = result.foveation->images.front().error;
    }
}

} // namespace degs::sim
