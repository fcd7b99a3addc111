// SPDX-License-Identifier: Apache-2.0
// Hard cases H18 and H27: Gaussians that went through an SPZ file.
#include <algorithm>
#include <cmath>
#include <new>

#include <zlib.h>

#include "accuracy/hard/hard_builder.hpp"
#include "scene/spz/spz.hpp"
#include "splat/frame/rendering_rules.hpp"

namespace degs {
namespace {

constexpr int kFractionalBits = 12; ///< of positions, which then end at 2048

std::string packed(const std::string& plain) {
    z_stream state{};
    constexpr int kGzip = 16 + MAX_WBITS;
    if (::deflateInit2(&state, 6, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::bad_alloc();
    }
    std::string out(::deflateBound(&state, plain.size()), '\0');
    state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    state.avail_in = static_cast<uInt>(plain.size());
    state.next_out = reinterpret_cast<Bytef*>(out.data());
    state.avail_out = static_cast<uInt>(out.size());
    ::deflate(&state, Z_FINISH);
    out.resize(state.total_out);
    ::deflateEnd(&state);
    return out;
}

void put_bytes(std::string& to, std::int64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) {
        to += static_cast<char>(value >> (8 * i) & 255);
    }
}

char byte_of(double value) {
    return static_cast<char>(
        static_cast<unsigned char>(std::lround(std::clamp(value, 0.0, 255.0))));
}

std::int64_t steps_of(double position) {
    constexpr std::int64_t kMost = (1 << 23) - 1;
    return std::clamp<std::int64_t>(std::llround(position * (1 << kFractionalBits)), -kMost - 1,
                                    kMost);
}

/// A file of version 2: 24-bit positions, bytes for everything else; w of a rotation is what is
/// missing to length 1. The cloud has SH degree 0.
std::string spz_of(const GaussianCloud& cloud, bool antialiased) {
    std::string bytes = "NGSP";
    put_bytes(bytes, 2, 4);
    put_bytes(bytes, static_cast<std::int64_t>(cloud.size()), 4);
    for (const int value : {0, kFractionalBits, antialiased ? 1 : 0, 0}) {
        put_bytes(bytes, value, 1);
    }
    for (const glm::dvec3& mean : cloud.means) {
        for (int axis = 0; axis < 3; ++axis) {
            put_bytes(bytes, steps_of(mean[axis]), 3);
        }
    }
    for (const float opacity : cloud.opacities) {
        bytes += byte_of(255.0 * opacity);
    }
    for (const float c : cloud.sh) {
        bytes += byte_of(255 * (0.15 * c + 0.5));
    }
    for (const glm::vec3& scale : cloud.scales) {
        for (int axis = 0; axis < 3; ++axis) {
            bytes += byte_of(16 * (std::log(double{scale[axis]}) + 10));
        }
    }
    for (const glm::vec4& q : cloud.rotations) {
        const double sign = q[0] < 0 ? -1 : 1;
        for (int i = 1; i < 4; ++i) {
            bytes += byte_of(127.5 * (sign * q[i] + 1));
        }
    }
    return packed(bytes);
}

/// The builder's scene as a reader of its file sees it, drawn as the file says.
HardScene through_spz(HardBuilder& builder, bool antialiased) {
    SceneContent content = decode_spz("hard.spz", spz_of(builder.scene.cloud, antialiased));
    builder.scene.cloud = std::move(content.cloud);
    builder.scene.projection = RenderingRules().options(content.traits.antialiased);
    return std::move(builder.scene);
}

/// Splats from far below a pixel to some pixels, all of which the low-pass filter widens.
void add_thin(HardBuilder& builder) {
    for (int i = 0; i < 120; ++i) {
        const double size = 0.05 * std::pow(1.05, i); // px, to 17
        const int row = i / 15;
        builder.add({builder.middle_x() + 4 * (i % 15) - 28,
                     builder.middle_y() + 5 * row - 20,
                     size,
                     size * (0.3 + 0.1 * (i % 7)),
                     0.3 * i,
                     0.3 + 0.005 * i,
                     {0.2 + 0.05 * (i % 9), 0.5, 0.8 - 0.05 * (i % 11)},
                     10 + 0.01 * i});
    }
}

/// Rotations that no byte can hold at length 1, opacities at both ends, positions to the last step.
void add_coarse(HardBuilder& builder) {
    for (int i = 0; i < 90; ++i) {
        const double angle = 0.7 * i;
        const double opacity = i % 9 == 0 ? 0 : i % 9 == 1 ? 1 : 0.1 * (i % 9);
        const double z = 8 + 0.02 * i;
        const double px = z / builder.scene.camera.fx;
        const int row = i / 10;
        builder.add_world({(8 * (i % 10) - 36) * px, (8 * row - 32) * px, z},
                          {9 * px, 4 * px, 2 * px},
                          {0.2 * (i % 3), std::cos(angle), std::sin(angle), 0.9}, opacity,
                          {0.1 * (i % 10), 0.3, 0.6});
    }
    // At the ends of the fixed point: outside the view, and not on its other side.
    for (const double x : {2047.9, -2048.0}) {
        builder.add_world({x, 0, 30}, {0.5, 0.5, 0.5}, {1, 0, 0, 0}, 0.9, {1, 0, 0});
    }
}

} // namespace

std::vector<HardScene> make_antialiased_case(int width, int height) {
    std::vector<HardScene> scenes;
    for (const bool antialiased : {false, true}) {
        HardBuilder builder(width, height);
        add_thin(builder);
        builder.look(builder.middle_x(), builder.middle_y(), 60);
        HardScene scene = through_spz(builder, antialiased);
        for (std::size_t i = 0; antialiased && i < scene.cloud.size(); ++i) {
            ProjectionOptions bare = scene.projection;
            bare.dilation = 0;
            bare.compensated = false;
            ProjectedSplat splat, filtered;
            project_anywhere(scene.cloud, i, scene.camera, bare, splat);
            bare.dilation = scene.projection.dilation;
            project_anywhere(scene.cloud, i, scene.camera, bare, filtered);
            const double ratio = std::max(kLeastCompensation, splat.det / filtered.det);
            scene.culled.transparent += splat.opacity * std::sqrt(ratio) < 1.0 / 255 ? 1 : 0;
        }
        scenes.push_back(std::move(scene));
    }
    return scenes;
}

// The integral of a splat over the screen is opacity times the root of the determinant.
std::string check_antialiased(const HardScene& scene, const FrameWorkload& workload) {
    ProjectionOptions bare = scene.projection;
    bare.dilation = 0;
    bare.compensated = false;
    double most_gain = 1;
    for (const ProjectedSplat& drawn : workload.splats) {
        ProjectedSplat splat;
        project_anywhere(scene.cloud, drawn.id, scene.camera, bare, splat);
        const double gain =
            drawn.opacity / splat.opacity * std::sqrt(drawn.det / splat.det); // of the integral
        if (scene.projection.compensated && std::abs(gain - 1) > 1e-9) {
            return "Splat " + std::to_string(drawn.id) + " gains weight by the low-pass filter.";
        }
        most_gain = std::max(most_gain, gain);
    }
    return scene.projection.compensated || most_gain > 10
               ? ""
               : "No splat is thin enough to need compensation.";
}

std::vector<HardScene> make_quantised_case(int width, int height) {
    HardBuilder builder(width, height);
    add_coarse(builder);
    builder.look(builder.middle_x(), builder.middle_y(), 60);
    HardScene scene = through_spz(builder, false);
    scene.culled.transparent = 10; // byte 0
    scene.culled.off_screen = 2;
    std::vector<HardScene> scenes;
    scenes.push_back(std::move(scene));
    return scenes;
}

std::string check_quantised(const HardScene& scene, const FrameWorkload& workload) {
    HardBuilder before(scene.camera.width, scene.camera.height);
    add_coarse(before);
    const GaussianCloud& wanted = before.scene.cloud;
    const double half_step = std::ldexp(0.5, -kFractionalBits);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const glm::dvec3 move = glm::abs(scene.cloud.means[i] - wanted.means[i]);
        if (std::max({move.x, move.y, move.z}) > half_step) {
            return "Gaussian " + std::to_string(i) + " has moved by more than half a step.";
        }
        if (std::abs(scene.cloud.opacities[i] - wanted.opacities[i]) > 0.5F / 255 + 1e-6F) {
            return "Gaussian " + std::to_string(i) + " has another opacity.";
        }
        if (std::abs(glm::length(glm::dvec4(scene.cloud.rotations[i])) - 1) > 1e-6) {
            return "Gaussian " + std::to_string(i) + " has a rotation of another length than 1.";
        }
    }
    const auto opaque = std::count_if(workload.splats.begin(), workload.splats.end(),
                                      [](const ProjectedSplat& s) { return s.opacity == 1; });
    return opaque == 10 ? "" : "The ten splats of byte 255 do not have an opacity of 1.";
}

} // namespace degs
