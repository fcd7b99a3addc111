// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/degs_config.hpp"
#include "splat/data_path_renderer.hpp"
#include "splat/pixel_mask.hpp"
#include "splat/reference_renderer.hpp"
#include "splat/tile_window.hpp"
#include "tests/random/promises.hpp"

namespace degs::trials {
namespace {

/// An image and how many updates made it.
struct Expected {
    Image image;
    std::uint64_t useful = 0;
};

constexpr int kRun = 32; ///< pixels that a PixelTest can name

/// Every pixel of a tile checks every splat of its list for itself.
class CheckedTile {
public:
    CheckedTile(const FrameWorkload& work, const DataPathOptions& numbers)
        : work_(work), path_(make_data_path(numbers, work.tile_size, 1)),
          base_(path_->add_frame(work)), row_(work.tile_size) {}

    void blend(int column, int row, Expected& out) {
        box_ = pixels_of(work_, {column, row, column, row});
        for (int y = 0; y < work_.tile_size; ++y) {
            path_->begin_row(0, y);
        }
        const std::uint64_t tile = std::uint64_t(row) * work_.tiles_x + column;
        for (auto i = work_.tile_begin[tile]; i < work_.tile_begin[tile + 1]; ++i) {
            out.useful += test(base_ + work_.tile_splats[i]);
        }
        if (work_.tile_begin[tile] != work_.tile_begin[tile + 1]) {
            write(out.image);
        }
    }

private:
    std::uint64_t test(std::uint32_t splat) {
        std::uint64_t useful = 0;
        PixelTest task;
        task.splat = splat;
        for (int y = box_.y0; y <= box_.y1; ++y) {
            for (int x = box_.x0; x <= box_.x1; x += kRun) {
                task.mask = bits_between(0, std::min(kRun, box_.x1 + 1 - x));
                task.x = x;
                task.y = y;
                task.row = static_cast<std::int16_t>(y - box_.y0);
                task.column = static_cast<std::int16_t>(x - box_.x0);
                useful += __builtin_popcount(path_->test(task).useful);
            }
        }
        return useful;
    }
    void write(Image& image) {
        const int width = box_.x1 - box_.x0 + 1;
        for (int y = box_.y0; y <= box_.y1; ++y) {
            path_->read_row(0, y - box_.y0, width, row_.data());
            for (int x = 0; x < width; ++x) {
                const std::size_t at = image.at(box_.x0 + x, y);
                for (int channel = 0; channel < 3; ++channel) {
                    image.rgb[3 * at + channel] = static_cast<float>(row_[x].rgb[channel]);
                }
                image.transmittance[at] = static_cast<float>(row_[x].transmittance);
                image.fragments[at] = row_[x].updates;
            }
        }
    }

    const FrameWorkload& work_;
    std::unique_ptr<DataPath> path_;
    std::uint32_t base_;
    std::vector<PixelValue> row_;
    PixelBox box_;
};

/// What pixels that check for themselves show, as those of the coupled arrays do.
Expected checked_image(const FrameWorkload& work, const DataPathOptions& numbers) {
    Expected expected{Image(work.camera.width, work.camera.height)};
    CheckedTile tile(work, numbers);
    for (int row = 0; row < work.tiles_y; ++row) {
        for (int column = 0; column < work.tiles_x; ++column) {
            tile.blend(column, row, expected);
        }
    }
    return expected;
}

/// What solved spans show, as those of DeGS do.
Expected solved_image(const FrameWorkload& work, const DegsConfig& config) {
    DataPathRender options;
    options.numbers = config.data_path();
    options.rows_in_columns = config.slicing.rows == SlicedRows::Tile;
    DataPathRenderer renderer(work, options);
    Expected expected{renderer.render(all_tiles(work))};
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
           options.projection.is_fp64() && (!spans || options.ends == SpanEnds::Exact);
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
    const auto* degs = dynamic_cast<const DegsConfig*>(&run.config);
    const DataPathOptions numbers = run.config.data_path();
    const bool exact = is_exact(numbers, degs != nullptr);
    // Coupled arrays look at the pixels near an ellipse only. With formats of the user's own, where
    // level or q saturate, pixels farther away would pass the check, too.
    const bool knows_own_image = degs != nullptr || !numbers.set;
    std::vector<std::string> sentences;
    std::uint64_t useful = 0;
    std::uint64_t fragments = 0;
    for (std::size_t f = 0; f < run.frames.size(); ++f) {
        const FrameWorkload& work = *run.frames[f];
        const Image& image = run.result.images[f];
        if (knows_own_image) {
            const Expected expected =
                degs != nullptr ? solved_image(work, *degs) : checked_image(work, numbers);
            useful += expected.useful;
            if (!same(image, expected.image)) {
                sentences.push_back(differs(f, "its own arithmetic's", image, expected.image));
            }
        }
        ReferenceCounts counts;
        if (exact) {
            const Image reference = render_reference(work, counts);
            fragments += counts.fragments;
            if (!(degs != nullptr ? same(image, reference) : nearly_same(image, reference))) {
                sentences.push_back(differs(f, "the reference's", image, reference));
            }
        }
    }
    if (knows_own_image) {
        compare_counts("its own arithmetic", run.result.slots.useful, useful, sentences);
    }
    if (exact) {
        compare_counts("the reference", run.result.slots.useful, fragments, sentences);
    }
    return sentences;
}

} // namespace degs::trials
