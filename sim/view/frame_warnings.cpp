// SPDX-License-Identifier: Apache-2.0
#include "sim/view/frame_warnings.hpp"

#include <algorithm>

#include "base/ratio.hpp"
#include "scene/cameras/lens_terms.hpp"
#include "sim/text/words.hpp"
#include "splat/pixels/saturation.hpp"

namespace degs::sim {

namespace {

/// `of` names what saturates, splats or pixels, of which there are `all`; `how` is the verb.
std::string saturation_words(const Saturation& found, std::size_t all, const std::string& of,
                             const std::string& how) {
    return "Stage " + found.stage + " saturates: " + grouped(found.splats) + " of " + grouped(all) +
           " " + of + " (" + three_digits(100 * ratio_of(found.splats, all)) + " %) " + how + " " +
           three_digits(found.limit) + ", the largest value of " + found.format +
           "; ':" + found.stage + "=FORMAT' at the end of pipeline.numbers sets another.";
}

} // namespace

std::vector<std::string> saturation_warnings(const DataPathOptions& options,
                                             const FrameWorkload& frame) {
    std::vector<std::string> warnings;
    for (const Saturation& found : saturated_stages(options, frame)) {
        warnings.push_back(saturation_words(found, frame.splats.size(), "splats", "lie beyond"));
    }
    return warnings;
}

std::vector<std::string> saturation_warnings(const DataPathOptions& options, const Image& image) {
    std::optional<Saturation> sum = end_of_sums(options);
    if (!sum) {
        return {};
    }
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        const float* const rgb = &image.rgb[3 * i];
        sum->splats += *std::max_element(rgb, rgb + 3) < sum->limit ? 0 : 1;
    }
    if (sum->splats == 0) {
        return {};
    }
    return {saturation_words(*sum, image.pixels(), "pixels", "reach")};
}

std::vector<std::string> near_plane_warnings(const CullCounts& culled,
                                             const ProjectionOptions& options,
                                             std::uint64_t gaussians) {
    if (culled.near_in_view == 0) {
        return {};
    }
    return {"The near plane at z = " + decimal_text(options.near_plane) + " removes " +
            grouped(culled.near_in_view) + " of " + grouped(gaussians) +
            " Gaussians, although they lie inside the view; pipeline.rules.near, or --near of "
            "commands without a configuration, sets another plane."};
}

std::vector<std::string> near_plane_warnings(const FrameWorkload& frame) {
    return near_plane_warnings(frame.culled, frame.projection, frame.gaussians);
}

void WorstNearPlane::add(const FrameWorkload& frame) {
    if (frame.culled.near_in_view > most_) {
        most_ = frame.culled.near_in_view;
        sentences_ = near_plane_warnings(frame);
    }
}

std::vector<std::string> lens_warnings(const Camera& camera, const ProjectionOptions& options) {
    constexpr double kWorthAWarning = 0.01; // px
    const double moved = corner_shift(camera);
    // Phrased so that a distortion that is not a number is mentioned, too.
    if (options.lens == LensRule::Camera || moved < kWorthAWarning) {
        return {};
    }
    return {"The lens of camera " + std::to_string(camera.id) + " (" + camera.lens.name() +
            ") is left out, because pipeline.rules.lens or --lens is pinhole; it moves a corner of "
            "the image by " +
            three_digits(moved) + " px."};
}

} // namespace degs::sim
