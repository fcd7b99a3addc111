// SPDX-License-Identifier: Apache-2.0
#include "splat/transform/cloud_transform.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "splat/transform/sh_rotation.hpp"

namespace degs {
namespace {

constexpr double kShear = 1e-4;         ///< largest cosine between two columns
constexpr double kUniform = 1e-6;       ///< largest relative difference of their lengths
constexpr double kSameRotation = 1e-12; ///< sine of half the angle below which nothing rotates

glm::dvec3 column_lengths(const glm::dmat3& m) {
    return {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
}

glm::dmat3 unit_columns(const glm::dmat3& m) {
    return {glm::normalize(m[0]), glm::normalize(m[1]), glm::normalize(m[2])};
}

/// Makes the columns orthogonal by rotations from the right (one-sided Jacobi). The columns of the
/// result are the left singular vectors, times the singular values. Small values keep their
/// relative accuracy, which an eigen-decomposition of the product with the transpose would lose.
glm::dmat3 orthogonal_columns(glm::dmat3 a) {
    constexpr int kSweeps = 30; // 5 are enough for every matrix seen
    constexpr double kOrthogonal = 1e-15;
    constexpr std::array<std::array<int, 2>, 3> kPairs{{{0, 1}, {0, 2}, {1, 2}}};
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        bool turned = false;
        for (const auto& [p, q] : kPairs) {
            const double pp = glm::dot(a[p], a[p]);
            const double qq = glm::dot(a[q], a[q]);
            const double pq = glm::dot(a[p], a[q]);
            if (!(std::abs(pq) > kOrthogonal * std::sqrt(pp) * std::sqrt(qq))) {
                continue;
            }
            const double zeta = (qq - pp) / (2 * pq);
            const double t =
                std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1 + zeta * zeta));
            const double c = 1 / std::sqrt(1 + t * t);
            const glm::dvec3 old = a[p];
            a[p] = c * (old - t * a[q]);
            a[q] = c * (t * old + a[q]);
            turned = true;
        }
        if (!turned) {
            break;
        }
    }
    return a;
}

/// A right-handed orthonormal system along orthogonal columns; those of length 0 (a disc, a line)
/// may point anywhere.
glm::dmat3 system_along(const glm::dmat3& columns, const glm::dvec3& lengths) {
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int i, int j) { return lengths[i] > lengths[j]; });
    const auto [longest, middle, shortest] = order;
    glm::dmat3 axes(1.0);
    if (!(lengths[longest] > 0)) {
        return axes;
    }
    axes[longest] = columns[longest] / lengths[longest];
    glm::dvec3 second = columns[middle];
    if (!(lengths[middle] > 0)) {
        const glm::dvec3& n = axes[longest];
        second = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    }
    second -= glm::dot(second, axes[longest]) * axes[longest];
    axes[middle] = glm::normalize(second);
    const double sign = (middle - longest + 3) % 3 == 1 ? 1 : -1;
    axes[shortest] = sign * glm::cross(axes[longest], axes[middle]);
    return axes;
}

glm::dquat quaternion(const glm::vec4& wxyz) {
    return {wxyz.x, wxyz.y, wxyz.z, wxyz.w};
}

glm::vec4 stored(const glm::dquat& q) {
    return glm::dvec4(q.w, q.x, q.y, q.z);
}

/// What a map does to a Gaussian apart from its mean.
class ShapeMap {
public:
    explicit ShapeMap(const glm::dmat3& linear)
        : linear_(linear), rotation_(glm::quat_cast(rotation_of(linear))) {
        const glm::dvec3 lengths = column_lengths(linear);
        const double least = std::min({lengths.x, lengths.y, lengths.z});
        const double most = std::max({lengths.x, lengths.y, lengths.z});
        uniform_ = most - least <= kUniform * most;
        factor_ = std::cbrt(lengths.x * lengths.y * lengths.z);
        rotates_ = std::abs(rotation_.x) > kSameRotation || std::abs(rotation_.y) > kSameRotation ||
                   std::abs(rotation_.z) > kSameRotation;
    }
    bool rotates() const { return rotates_; }

    void apply(glm::vec3& scale, glm::vec4& rotation) const {
        if (!uniform_) {
            apply_general(scale, rotation);
            return;
        }
        scale = factor_ == 1 ? glm::dvec3(scale) : factor_ * glm::dvec3(scale);
        if (rotates_) {
            rotation = stored(rotation_ * quaternion(rotation));
        }
    }

private:
    /// A quaternion of length 0 stays as it is: sanitize() drops it.
    void apply_general(glm::vec3& scale, glm::vec4& rotation) const {
        const glm::dquat q = quaternion(rotation);
        const double length = glm::length(q);
        if (!(length > 0)) {
            return;
        }
        const glm::dmat3 axes = linear_ * glm::mat3_cast(q / length);
        const glm::dmat3 columns = orthogonal_columns(
            {axes[0] * double{scale.x}, axes[1] * double{scale.y}, axes[2] * double{scale.z}});
        const glm::dvec3 lengths = column_lengths(columns);
        scale = lengths;
        rotation = stored(glm::quat_cast(system_along(columns, lengths)));
    }

    glm::dmat3 linear_;
    glm::dquat rotation_;
    double factor_ = 1;
    bool uniform_ = true, rotates_ = false;
};

/// Missing coefficients are 0.
void append_sh(const GaussianCloud& from, GaussianCloud& to) {
    const std::size_t have = from.sh_coefficients() * 3;
    const std::size_t want = to.sh_coefficients() * 3;
    if (have == want) {
        to.sh.insert(to.sh.end(), from.sh.begin(), from.sh.end());
        return;
    }
    for (std::size_t i = 0; i < from.size(); ++i) {
        to.sh.insert(to.sh.end(), from.sh_of(i), from.sh_of(i) + have);
        to.sh.resize(to.sh.size() + want - have);
    }
}

} // namespace

TransformDefect find_transform_defect(const glm::dmat3& linear) {
    const glm::dvec3 lengths = column_lengths(linear);
    if (!std::isfinite(lengths.x + lengths.y + lengths.z)) {
        return TransformDefect::NonFinite;
    }
    // Lengths whose product of three is a normal double; smaller columns count as 0.
    constexpr double kShortest = 1e-100;
    if (!(lengths.x > kShortest && lengths.y > kShortest && lengths.z > kShortest)) {
        return TransformDefect::Singular;
    }
    const glm::dmat3 axes = unit_columns(linear);
    const double cosine =
        std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[0], axes[2])),
                  std::abs(glm::dot(axes[1], axes[2]))});
    const double volume = glm::determinant(axes);
    if (std::abs(volume) < kShear) {
        return TransformDefect::Singular;
    }
    if (cosine > kShear) {
        return TransformDefect::Sheared;
    }
    return volume < 0 ? TransformDefect::Mirrored : TransformDefect::None;
}

const char* explain(TransformDefect defect) {
    switch (defect) {
    case TransformDefect::NonFinite:
        return "is not finite";
    case TransformDefect::Singular:
        return "is singular";
    case TransformDefect::Mirrored:
        return "mirrors";
    case TransformDefect::Sheared:
        return "shears";
    case TransformDefect::None:
        break;
    }
    return "";
}

glm::dmat3 rotation_of(const glm::dmat3& linear) {
    return glm::mat3_cast(glm::normalize(glm::quat_cast(unit_columns(linear))));
}

void append_transformed(const GaussianCloud& from, const Affine& map, GaussianCloud& to) {
    const std::size_t first = to.size();
    to.scales.insert(to.scales.end(), from.scales.begin(), from.scales.end());
    to.rotations.insert(to.rotations.end(), from.rotations.begin(), from.rotations.end());
    to.opacities.insert(to.opacities.end(), from.opacities.begin(), from.opacities.end());
    append_sh(from, to);
    to.means.reserve(first + from.size());
    const ShapeMap shape(map.linear);
    for (std::size_t i = 0; i < from.size(); ++i) {
        to.means.push_back(map.linear * from.means[i] + map.translation);
        shape.apply(to.scales[first + i], to.rotations[first + i]);
    }
    if (from.sh_degree == 0 || !shape.rotates()) {
        return;
    }
    const ShRotation turn(to.sh_degree, rotation_of(map.linear));
    const std::size_t pitch = to.sh_coefficients() * 3;
    for (std::size_t i = first; i < to.size(); ++i) {
        turn.apply(to.sh.data() + i * pitch);
    }
}

} // namespace degs
