// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "base/byte_order.hpp"
#include "base/parallel.hpp"
#include "scene/files/activation_scan.hpp"
#include "scene/ply/compressed_ply.hpp"
#include "scene/ply/ply_camera.hpp"
#include "scene/ply/ply_comments.hpp"
#include "scene/ply/ply_header.hpp"
#include "scene/ply/ply_rows.hpp"
#include "scene/ply/ply_splat_layout.hpp"
#include "scene/ply/ply_values.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

constexpr std::size_t kReadBytes = 4 << 20; ///< worth the start of a thread
constexpr std::size_t kStripRows = 64; ///< converted column by column while they fit the L1 cache

/// One scalar of the file and where it goes: `to` is the value of the first Gaussian.
template <class To>
struct Binding {
    PlyColumn column;
    To* to;
    std::size_t pitch; ///< values between neighbouring Gaussians
};

class CloudReader {
public:
    CloudReader(InputFile& file, const PlyHeader& header, const PlySplatLayout& layout)
        : rows_(file, header, *layout.vertex), count_(layout.vertex->count), scales_(layout.scales),
          rgb_(layout.rgb) {
        allocate(layout);
        bind(layout);
    }

    GaussianCloud read() {
        const std::size_t block = std::max<std::size_t>(1, kReadBytes / rows_.row_bytes());
        std::vector<char> bytes(std::min(block, std::max<std::size_t>(count_, 1)) *
                                rows_.row_bytes());
        for (std::size_t first = 0; first < count_; first += block) {
            const std::size_t rows = std::min(block, count_ - first);
            rows_.read(bytes.data(), rows);
            parallel_ranges(rows, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; i += kStripRows) {
                    convert(bytes.data() + i * rows_.row_bytes(), first + i,
                            std::min(kStripRows, end - i));
                }
            });
        }
        rows_.finish();
        return std::move(cloud_);
    }
    /// The note on what read() returned; empty if the values look as the format has them.
    std::string note_of(const GaussianCloud& cloud) const {
        ActivationScan scan;
        scan.add_scale(scales_activated_ ? 0 : -1);
        scan.add_opacity(opacities_activated_ ? 0 : -1);
        return activated_note(scan, cloud);
    }

private:
    void allocate(const PlySplatLayout& layout) {
        cloud_.sh_degree = layout.sh_degree;
        cloud_.means.resize(count_);
        cloud_.scales.resize(count_);
        cloud_.rotations.resize(count_);
        cloud_.opacities.resize(count_);
        cloud_.sh.resize(count_ * cloud_.sh_coefficients() * 3);
        filters_.resize(layout.has_filter_3d ? count_ : 0);
    }

    void bind(const PlySplatLayout& layout) {
        if (count_ == 0) {
            return;
        }
        const std::string axes[] = {"x", "y", "z"};
        for (int i = 0; i < 3; ++i) {
            means_.push_back({rows_.column(axes[i]), &cloud_.means[0].x + i, 3});
        }
        for (int i = 0; i < layout.scales; ++i) {
            bind_float("scale_" + std::to_string(i), &cloud_.scales[0].x + i, 3);
        }
        for (int i = 0; i < 4; ++i) {
            bind_float("rot_" + std::to_string(i), &cloud_.rotations[0].x + i, 4);
        }
        bind_float("opacity", cloud_.opacities.data(), 1);
        if (layout.has_filter_3d) {
            bind_float("filter_3D", filters_.data(), 1);
        }
        bind_sh(layout);
    }

    /// The file is channel-major (all of red, then green, then blue), the cloud interleaved.
    void bind_sh(const PlySplatLayout& layout) {
        const std::string colours[] = {"red", "green", "blue"};
        const int coefficients = cloud_.sh_coefficients();
        const std::size_t pitch = coefficients * 3;
        for (int channel = 0; channel < 3; ++channel) {
            bind_float(layout.rgb ? colours[channel] : "f_dc_" + std::to_string(channel),
                       cloud_.sh.data() + channel, pitch);
            for (int k = 1; k < coefficients; ++k) {
                const int in_file = channel * layout.rest_coefficients + k - 1;
                bind_float("f_rest_" + std::to_string(in_file), cloud_.sh.data() + k * 3 + channel,
                           pitch);
            }
        }
    }

    void bind_float(const std::string& property, float* to, std::size_t pitch) {
        floats_.push_back({rows_.column(property), to, pitch});
    }

    void convert(const char* strip, std::size_t first, std::size_t rows) {
        for (const Binding<double>& binding : means_) {
            copy(strip, binding, first, rows);
        }
        for (const Binding<float>& binding : floats_) {
            copy(strip, binding, first, rows);
        }
        if (scales_activated_.load(std::memory_order_relaxed) ||
            opacities_activated_.load(std::memory_order_relaxed)) {
            scan(first, rows);
        }
        for (std::size_t i = first; i < first + rows; ++i) {
            activate(i);
        }
    }

    /// The first strip mostly decides.
    void scan(std::size_t first, std::size_t rows) {
        ActivationScan found;
        for (std::size_t i = first; i < first + rows; ++i) {
            found.add_opacity(cloud_.opacities[i]);
            for (int axis = 0; axis < scales_; ++axis) {
                found.add_scale(cloud_.scales[i][axis]);
            }
        }
        if (!found.scales_look_activated()) {
            scales_activated_.store(false, std::memory_order_relaxed);
        }
        if (!found.opacities_look_activated()) {
            opacities_activated_.store(false, std::memory_order_relaxed);
        }
    }

    template <class To>
    void copy(const char* strip, const Binding<To>& binding, std::size_t first, std::size_t rows) {
        const char* from = strip + binding.column.offset;
        To* to = binding.to + first * binding.pitch;
        const bool swap = rows_.swap_bytes();
        with_type(binding.column.type, [&](auto value) {
            for (std::size_t i = 0; i < rows; ++i) {
                to[i * binding.pitch] = static_cast<To>(
                    load_value<decltype(value)>(from + i * rows_.row_bytes(), swap));
            }
        });
    }

    void activate(std::size_t i) {
        glm::dvec3 scale = glm::exp(glm::dvec3(cloud_.scales[i]));
        scale.z = scales_ == 3 ? scale.z : 0;
        double opacity = 1.0 / (1.0 + std::exp(-static_cast<double>(cloud_.opacities[i])));
        if (!filters_.empty()) {
            fuse_filter(filters_[i], scale, opacity);
        }
        cloud_.scales[i] = scale;
        cloud_.opacities[i] = static_cast<float>(opacity);
        for (int channel = 0; rgb_ && channel < 3; ++channel) {
            float& dc = cloud_.sh[i * cloud_.sh_coefficients() * 3 + channel];
            dc = static_cast<float>((dc / 255.0 - 0.5) / kShY0);
        }
    }

    /// Mip-Splatting's 3D smoothing filter: a wider Gaussian of the same integral. A disc has none
    /// to keep along its normal.
    void fuse_filter(double filter, glm::dvec3& scale, double& opacity) const {
        const glm::dvec3 smoothed = glm::sqrt(scale * scale + filter * filter);
        const glm::dvec3 ratio = scale / smoothed;
        opacity *= filter == 0.0 ? 1.0 : ratio.x * ratio.y * (scales_ == 3 ? ratio.z : 1);
        scale = smoothed;
    }

    PlyRows rows_;
    std::size_t count_;
    int scales_;
    bool rgb_;
    GaussianCloud cloud_;
    std::atomic<bool> scales_activated_{true}, opacities_activated_{true};
    std::vector<float> filters_;
    std::vector<Binding<double>> means_;
    std::vector<Binding<float>> floats_;
};

} // namespace

SceneContent read_ply(const std::string& path) {
    InputFile file(path);
    const PlyHeader header = read_ply_header(file);
    SceneContent content;
    read_ply_comments(header.comments, content);
    read_ply_metadata(file, header, content);
    file.seek(header.data_begin);
    if (is_compressed_ply(header)) {
        content.cloud = read_compressed_ply(file, header);
        if (std::string note = activated_note(content.cloud); !note.empty()) {
            content.notes.push_back(std::move(note));
        }
        return content;
    }
    const PlySplatLayout layout = find_splat_layout(path, header, content.notes);
    CloudReader reader(file, header, layout);
    content.cloud = reader.read();
    if (std::string note = reader.note_of(content.cloud); !note.empty()) {
        content.notes.push_back(std::move(note));
    }
    content.traits.antialiased = content.traits.antialiased || layout.has_filter_3d;
    return content;
}

} // namespace degs
