// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>

#include "accuracy/data_path_renderer.hpp"
#include "splat/frame/tile_window.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/random/habits.hpp"
#include "tests/random/promises.hpp"
#include "tests/splat/pixels/checked_image.hpp"

namespace degs::trials {
namespace {

using test::BlendedImage;
using test::checked_image;

/// What the rows of splats show, solved or as wide as the splat's box.
BlendedImage image_of_rows(const FrameWorkload& work, const AcceleratorConfig& config) {
    DataPathRender options;
    options.numbers = config.data_path();
    const Habits habits = habits_of(config);
    options.rows_in_columns = habits.rows_of_tile;
    options.parsing = habits.search == Habits::Search::Solve;
    DataPathRenderer renderer(work, options);
    BlendedImage expected{renderer.render(all_tiles(work))};
    expected.useful = renderer.counts().useful;
    return expected;
}

template <class Value>
bool same(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

bool same(const Image& a, const Image& b) {
    return same(a.rgb, b.rgb) && same(a.transmittance, b.transmittance) &&
           same(a.fragments, b.fragments);
}

/// The coupled check orders its operations in another way than the reference, so that rounding to
/// float may take the last bit either way.
bool nearly_same(const Image& a, const Image& b) {
    bool near = a.fragments == b.fragments;
    for (std::size_t i = 0; near && i < a.rgb.size(); ++i) {
        const double value = b.rgb[i];
        near = std::abs(a.rgb[i] - value) <= 1e-12 + 0x1p-23 * std::abs(value);
    }
    return near;
}

std::uint64_t different_pixels(const Image& a, const Image& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.pixels(); ++i) {
        count += std::memcmp(&a.rgb[3 * i], &b.rgb[3 * i], 3 * sizeof(float)) != 0 ? 1 : 0;
    }
    return count;
}

std::string differs(std::size_t frame, const char* from, const Image& a, const Image& b) {
    return "image " + std::to_string(frame) + " differs from " + from + ": in " +
           std::to_string(different_pixels(a, b)) + " of " + std::to_string(a.pixels()) + " pixels";
}

/// Does the documentation promise the reference's image?
bool is_exact(const DataPathOptions& options, bool spans) {
    const bool fp64 = options.numbers == Arithmetic::Fp64 || options.numbers == Arithmetic::Ideal;
    return fp64 && !options.set && options.stop == StopRule::Refuse &&
           options.projection.is_reference() && (!spans || options.ends == SpanEnds::Exact);
}

/// Frames of which the wrong image of the first is enough to say.
void compare_counts(const std::string& what, std::uint64_t useful, std::uint64_t expected,
                    std::vector<std::string>& sentences) {
    if (useful != expected) {
        sentences.push_back("useful slots are not what " + what + " blends: " +
                            std::to_string(useful) + ", not " + std::to_string(expected));
    }
}

} // namespace

std::vector<std::string> wrong_images(const Finished& run) {
    if (run.result.hazards != 0) { // only without scoreboard, see broken_bounds()
        return {};
    }
    const DataPathOptions numbers = run.config.data_path();
    const Habits::Search search = habits_of(run.config).search;
    const bool parses = search == Habits::Search::Solve;
    const bool by_rows = search != Habits::Search::Test;
    const bool exact = is_exact(numbers, parses);
    // Coupled arrays look at the pixels near an ellipse only. With formats of the user's own, where
    // level or q saturate, pixels farther away would pass the check, too.
    const bool knows_own_image = by_rows || !numbers.set;
    std::vector<std::string> sentences;
    std::uint64_t useful = 0;
    std::uint64_t fragments = 0;
    for (std::size_t f = 0; f < run.frames.size(); ++f) {
        const FrameWorkload& work = *run.frames[f];
        const Image& image = run.result.images[f];
        if (knows_own_image) {
            const BlendedImage expected =
                by_rows ? image_of_rows(work, run.config) : checked_image(work, numbers);
            useful += expected.useful;
            if (!same(image, expected.image)) {
                sentences.push_back(differs(f, "its own arithmetic's", image, expected.image));
            }
        }
        ReferenceCounts counts;
        if (exact) {
            const Image reference = render_reference(work, counts);
            fragments += counts.fragments;
            if (!(parses ? same(image, reference) : nearly_same(image, reference))) {
                sentences.push_back(differs(f, "the reference's", image, reference));
            }
        }
    }
    if (knows_own_image) {
        compare_counts("its own arithmetic", run.result.fragments(), useful, sentences);
    }
    if (exact) {
        compare_counts("the reference", run.result.fragments(), fragments, sentences);
    }
    return sentences;
}

} // namespace degs::trials
