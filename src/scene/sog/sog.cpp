// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/sog.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/visible_text.hpp"
#include "scene/files/activation_scan.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/scene_folder.hpp"
#include "scene/sog/sog_files.hpp"
#include "scene/sog/sog_meta.hpp"
#include "scene/sog/webp_image.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMaxImageBytes = std::uint64_t{1} << 30;
constexpr std::uint64_t kPixelsPerByte = 16;   ///< of the archive; real scenes have 0.1
constexpr std::uint64_t kFreePixels = 1 << 16; ///< allowed in any case
constexpr std::uint64_t kMaxPalette = 1 << 16; ///< labels have 16 bits
constexpr int kPaletteColumns = 64;            ///< entries per row of the palette's image
constexpr std::array<int, 4> kRest{0, 3, 8, 15};

/// Inverse of sign(x) ln(|x| + 1).
double unfolded(double value) {
    return std::copysign(std::expm1(std::abs(value)), value);
}

/// Names of all images that the scene has.
std::vector<std::string> image_names(const SogMeta& meta) {
    std::vector<std::string> names{meta.means_low, meta.means_high, meta.scales, meta.quats,
                                   meta.sh0};
    if (meta.degree != 0) {
        names.insert(names.end(), {meta.centroids, meta.labels});
    }
    return names;
}

class SogReader {
public:
    explicit SogReader(const std::string& path) : path_(path), files_(open_sog_files(path)) {}

    SceneContent read() {
        meta_ = parse_sog_meta(path_, files_->meta());
        limit_ = files_->bytes(image_names(meta_)) * kPixelsPerByte + kFreePixels;
        if (meta_.count == 0 || meta_.count > limit_) {
            fail_file(path_, "its meta.json claims " + std::to_string(meta_.count) +
                                 " Gaussians; allowed are 1 to " + std::to_string(limit_) +
                                 " in an archive of this size.");
        }
        read_means();
        read_scales();
        read_rotations();
        RgbaImage palette, labels;
        if (meta_.degree != 0) {
            palette = open_palette();
            labels = image(meta_.labels);
        }
        read_colours();
        if (meta_.degree > 0) {
            read_rest(palette, labels);
        }
        if (std::string note = activated_note(content_.cloud, meta_.logits); !note.empty()) {
            content_.notes.push_back(std::move(note));
        }
        content_.traits.antialiased = meta_.antialiased;
        take_render_model("model", meta_.model, content_);
        if (unread_) {
            content_.notes.push_back("Its images have room for many more than the " +
                                     std::to_string(meta_.count) +
                                     " Gaussians of its meta.json; what lies behind these was not "
                                     "read.");
        }
        if (lossy_) {
            content_.notes.emplace_back("An image of the archive was compressed with losses, which "
                                        "SOG forbids; its values are not those of the scene.");
        }
        return std::move(content_);
    }

private:
    /// One with a pixel for each Gaussian.
    RgbaImage image(const std::string& name) {
        RgbaImage decoded = open(name, limit_);
        if (decoded.pixels() < meta_.count) {
            fail_file(path_, "its image '" + visible_name(name) + "' has " +
                                 std::to_string(decoded.pixels()) + " pixels, fewer than its " +
                                 std::to_string(meta_.count) + " Gaussians.");
        }
        constexpr std::uint64_t kPaddedRows = 4; // sides are multiples of 4
        const std::uint64_t row = std::max(decoded.width, 1);
        unread_ = unread_ || decoded.pixels() - meta_.count >= kPaddedRows * row;
        return decoded;
    }

    RgbaImage open(const std::string& name, std::uint64_t limit) {
        RgbaImage decoded = decode_webp(path_, name, files_->read(name, kMaxImageBytes), limit);
        lossy_ = lossy_ || decoded.lossy;
        return decoded;
    }

    static std::string visible_name(const std::string& name) {
        return visible(name.substr(0, 100));
    }

    /// Each entry is a row of pixels, one per coefficient.
    RgbaImage open_palette() {
        RgbaImage palette = open(meta_.centroids, kMaxPalette * kRest[3]);
        const auto rest =
            std::find(kRest.begin() + 1, kRest.end(), palette.width / kPaletteColumns);
        const int degree = static_cast<int>(rest - kRest.begin());
        if (palette.width % kPaletteColumns != 0 || rest == kRest.end() ||
            (meta_.degree > 0 && meta_.degree != degree)) {
            fail_file(path_,
                      "its image '" + visible_name(meta_.centroids) + "' is " +
                          std::to_string(palette.width) +
                          " pixels wide; a palette of degree 1, 2 or 3 has 192, 512 or 960.");
        }
        meta_.degree = degree;
        const std::uint64_t entries = std::uint64_t{kPaletteColumns} * palette.height;
        meta_.palette = meta_.palette == 0 ? entries : std::min(meta_.palette, entries);
        return palette;
    }

    void read_means() {
        const RgbaImage low = image(meta_.means_low), high = image(meta_.means_high);
        content_.cloud.means.resize(meta_.count);
        for (std::uint64_t i = 0; i < meta_.count; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const int code = low.bytes[4 * i + axis] | high.bytes[4 * i + axis] << 8;
                content_.cloud.means[i][axis] = unfolded(
                    meta_.low[axis] + (meta_.high[axis] - meta_.low[axis]) * (code / 65535.0));
            }
        }
    }

    void read_scales() {
        const RgbaImage scales = image(meta_.scales);
        std::array<SogMeta::ByteTable, 3> linear = meta_.scale;
        for (SogMeta::ByteTable& table : linear) {
            for (float& value : table) {
                value = static_cast<float>(std::exp(static_cast<double>(value)));
            }
        }
        content_.cloud.scales.resize(meta_.count);
        for (std::uint64_t i = 0; i < meta_.count; ++i) {
            const unsigned char* const pixel = &scales.bytes[4 * i];
            content_.cloud.scales[i] = {linear[0][pixel[0]], linear[1][pixel[1]],
                                        linear[2][pixel[2]]};
        }
    }

    void read_rotations() {
        const RgbaImage quats = image(meta_.quats);
        content_.cloud.rotations.resize(meta_.count);
        std::uint64_t untagged = 0;
        for (std::uint64_t i = 0; i < meta_.count; ++i) {
            const unsigned char* const pixel = &quats.bytes[4 * i];
            constexpr int kFirstTag = 252; // of the largest component: w, x, y, z
            untagged += pixel[3] < kFirstTag ? 1 : 0;
            content_.cloud.rotations[i] = pixel[3] < kFirstTag
                                              ? glm::vec4(1, 0, 0, 0)
                                              : rotation(pixel, pixel[3] - kFirstTag);
        }
        if (untagged > 0) {
            content_.notes.push_back(std::to_string(untagged) +
                                     " rotations are of no known code; these Gaussians are not "
                                     "turned.");
        }
    }

    static glm::vec4 rotation(const unsigned char* pixel, int largest) {
        glm::dvec4 wxyz(0.0);
        double squares = 0;
        for (int i = 0; i < 4; ++i) {
            if (i != largest) {
                wxyz[i] = (*pixel++ / 127.5 - 1) * std::sqrt(0.5);
                squares += wxyz[i] * wxyz[i];
            }
        }
        wxyz[largest] = std::sqrt(std::max(0.0, 1 - squares));
        return wxyz;
    }

    void read_colours() {
        const RgbaImage sh0 = image(meta_.sh0);
        GaussianCloud& cloud = content_.cloud;
        cloud.sh_degree = std::max(meta_.degree, 0);
        const std::size_t pitch = cloud.sh_coefficients() * 3;
        cloud.opacities.resize(meta_.count);
        cloud.sh.resize(meta_.count * pitch);
        for (std::uint64_t i = 0; i < meta_.count; ++i) {
            const unsigned char* const pixel = &sh0.bytes[4 * i];
            cloud.opacities[i] = meta_.opacity[pixel[3]];
            for (int channel = 0; channel < 3; ++channel) {
                cloud.sh[i * pitch + channel] = meta_.colour[channel][pixel[channel]];
            }
        }
    }

    void read_rest(const RgbaImage& palette, const RgbaImage& labels) {
        GaussianCloud& cloud = content_.cloud;
        const std::size_t rest = kRest[meta_.degree];
        const std::size_t pitch = cloud.sh_coefficients() * 3;
        std::uint64_t unknown = 0;
        for (std::uint64_t i = 0; i < meta_.count; ++i) {
            const std::size_t label = labels.bytes[4 * i] | labels.bytes[4 * i + 1] << 8;
            if (label >= meta_.palette) {
                ++unknown; // coefficients stay 0
                continue;
            }
            const std::size_t pixel =
                label / kPaletteColumns * palette.width + label % kPaletteColumns * rest;
            float* const sh = cloud.sh.data() + i * pitch + 3;
            for (std::size_t k = 0; k < 3 * rest; ++k) {
                sh[k] = meta_.rest[palette.bytes[4 * (pixel + k / 3) + k % 3]];
            }
        }
        if (unknown > 0) {
            content_.notes.push_back(std::to_string(unknown) +
                                     " Gaussians name entries beyond the palette of spherical "
                                     "harmonics; theirs were set to 0.");
        }
    }

    std::string path_;
    std::unique_ptr<SogFiles> files_;
    SogMeta meta_;
    std::uint64_t limit_ = 0; ///< pixels of an image
    bool lossy_ = false;
    bool unread_ = false; ///< an image goes on for rows behind the Gaussians
    SceneContent content_;
};

} // namespace

SceneContent read_sog(const std::string& path) {
    return SogReader(path).read();
}

std::uint64_t sog_count(const std::string& path) {
    return parse_sog_meta(path, open_sog_files(path)->meta()).count;
}

std::vector<std::string> sog_external_files(const std::string& path) {
    std::vector<std::string> files;
    if (kind_of_json(path) == SceneJson::Sog) {
        const SogMeta meta = parse_sog_meta(path, open_sog_files(path)->meta());
        for (const std::string& name : image_names(meta)) {
            files.push_back(file_in_scene_folder(path, name, "one of its images"));
        }
    }
    return files;
}

} // namespace degs
