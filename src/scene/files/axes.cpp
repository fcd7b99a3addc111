// SPDX-License-Identifier: Apache-2.0
#include "scene/files/axes.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/parallel.hpp"

namespace degs {
namespace {

constexpr std::string_view kPositive = "RDF";
constexpr std::string_view kNegative = "LUB";

} // namespace

std::string Axes::name() const {
    std::string letters;
    for (int axis = 0; axis < 3; ++axis) {
        letters += signs[axis] > 0 ? kPositive[axis] : kNegative[axis];
    }
    return letters;
}

std::optional<Axes> parse_axes(std::string_view letters) {
    Axes axes;
    if (letters.size() != 3) {
        return std::nullopt;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const char letter =
            static_cast<char>(std::toupper(static_cast<unsigned char>(letters[axis])));
        if (letter != kPositive[axis] && letter != kNegative[axis]) {
            return std::nullopt;
        }
        axes.signs[axis] = letter == kPositive[axis] ? 1 : -1;
    }
    return axes;
}

/// Y_k(s * dir) against Y_k(dir), from the powers of x, y and z in each (l = 1: y z x; l = 2: xy yz
/// 2zz-xx-yy xz xx-yy; l = 3: y xyz y z x z x).
std::array<float, 16> sh_signs(const Axes& from, const Axes& to) {
    const glm::vec3 s(from.signs * to.signs);
    return {1,   s.y, s.z, s.x, s.x * s.y, s.y * s.z, 1, s.x * s.z, 1, s.y, s.x * s.y * s.z,
            s.y, s.z, s.x, s.z, s.x};
}

void convert_axes(GaussianCloud& cloud, const Axes& from, const Axes& to) {
    if (from == to) {
        return;
    }
    const glm::dvec3 s = from.signs * to.signs;
    const glm::vec3 f(s);
    const glm::vec4 turn(1, f.y * f.z, f.x * f.z, f.x * f.y); // S R S of the same reflection S
    const std::array<float, 16> basis = sh_signs(from, to);
    const int coefficients = cloud.sh_coefficients();
    parallel_ranges(cloud.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            cloud.means[i] *= s;
            cloud.rotations[i] *= turn;
            float* const sh = cloud.sh.data() + i * coefficients * 3;
            for (int k = 1; k < coefficients; ++k) {
                for (int channel = 0; channel < 3; ++channel) {
                    sh[k * 3 + channel] *= basis[k];
                }
            }
        }
    });
}

void convert_axes(std::vector<Camera>& cameras, const Axes& from, const Axes& to) {
    const glm::dvec3 s = from.signs * to.signs;
    for (Camera& camera : cameras) {
        camera.position *= s;
        for (int column = 0; column < 3; ++column) {
            camera.camera_to_world[column] *= s;
        }
    }
}

} // namespace degs
