// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "degs/error.hpp"
#include "splat/frame/pixel_index.hpp"
#include "splat/frame/stored_gaussians.hpp"
#include "splat/frame/unscented.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

bool is_degenerate(const ProjectedSplat& s) {
    // One sum catches every NaN and infinity: neither can be cancelled away by finite terms.
    const double sum = std::abs(s.mu_x) + std::abs(s.mu_y) + s.cov_a + std::abs(s.cov_b) + s.cov_c +
                       s.det + s.q_threshold + s.depth;
    return !std::isfinite(sum) || !(s.det > 0);
}

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x + v.y + v.z);
}

/// Rounding leaves a, b, c and det of slightly different ellipses, far apart for needles, and an
/// opacity beside Q_th. Records are made of b, c, det and Q_th, so the others follow from these, in
/// double: bounds of tiles and rows then hold for the ellipse that is drawn.
void make_consistent(ProjectedSplat& s, double alpha_min) {
    s.cov_a = (s.det + s.cov_b * s.cov_b) / s.cov_c;
    s.opacity = alpha_min * std::exp(s.q_threshold / 2);
}

/// The constants of a view that every Gaussian needs, rounded once.
template <class Numbers>
struct ViewConstants {
    using Scalar = typename Numbers::Scalar;
    Vector3<Scalar> right, down, forward; ///< view axes in the world
    Scalar fx, fy;
    Scalar middle_x, middle_y;         ///< of the raster, px
    Scalar most_slope_x, most_slope_y; ///< limits of x/z and y/z in the Jacobian
    Scalar near_plane, dilation, alpha_min, least_compensation;
    Scalar half, one, two;

    ViewConstants(const Numbers& n, const Camera& c, const ProjectionOptions& o)
        : right(vector_in(n, c.camera_to_world[0])), down(vector_in(n, c.camera_to_world[1])),
          forward(vector_in(n, c.camera_to_world[2])), fx(n(c.fx)), fy(n(c.fy)),
          middle_x(n(c.raster_middle().x)), middle_y(n(c.raster_middle().y)),
          most_slope_x(n(o.jacobian_clamp * (2.0 * c.raster_middle().x) / (2.0 * c.fx))),
          most_slope_y(n(o.jacobian_clamp * (2.0 * c.raster_middle().y) / (2.0 * c.fy))),
          near_plane(n(o.near_plane)), dilation(n(o.dilation)), alpha_min(n(o.alpha_min)),
          least_compensation(n(kLeastCompensation)), half(n(0.5)), one(n(1.0)), two(n(2.0)) {}
};

/// The projection in the arithmetic of `Numbers`; members are rounded, locals of double are not.
template <class Numbers>
class ProjectorIn final : public Projector {
public:
    ProjectorIn(const GaussianCloud& cloud, const Camera& camera, const ProjectionOptions& options,
                Numbers numbers)
        : Projector(camera), gaussians_(cloud, options.numbers), position_(camera.position),
          n_(std::move(numbers)), k_(n_, camera, options), alpha_min_(options.alpha_min),
          cut_(options.cut < kNoCut ? value_of(n_(options.cut))
                                    : std::numeric_limits<double>::infinity()),
          order_(options.order), compensated_(options.compensated) {
        if (options.rule == ProjectionRule::Unscented) {
            unscented_.emplace(n_, camera, options.lens == LensRule::Camera ? camera.lens : Lens(),
                               options.sigma, options.near_plane, options.jacobian_clamp);
        }
    }

    Cull project_anywhere(std::size_t index, ProjectedSplat& out) const override;
    Cull shade(std::size_t index, ProjectedSplat& out) const override;

private:
    using Scalar = typename Numbers::Scalar;
    using Vector = Vector3<Scalar>;
    struct Matrix { // columns
        Vector x, y, z;
    };

    Matrix rotation_of(const glm::dvec4& slots) const;
    Scalar depth_of(const Scalar& x, const Scalar& y, const Scalar& z) const;
    void set_mean(const Scalar& x, const Scalar& y, const Scalar& z, ProjectedSplat& out) const;
    void set_opacity(const Scalar& opacity, ProjectedSplat& out) const;
    void cut_off(ProjectedSplat& out) const {
        out.q_cut_off = std::max(0.0, out.q_threshold - cut_);
        out.q_threshold = std::min(out.q_threshold, cut_);
    }
    ScreenCovariance<Scalar> linear_covariance(std::size_t index, const Scalar& x, const Scalar& y,
                                               const Scalar& z) const;
    std::optional<ScreenCovariance<Scalar>>
    set_unscented_mean(std::size_t index, const Vector& seen, ProjectedSplat& out) const;
    Scalar set_covariance(const ScreenCovariance<Scalar>& bare, ProjectedSplat& out) const;
    Scalar limited(const Scalar& slope, const Scalar& most) const {
        const Scalar least = n_(0.0) - most;
        return slope < least ? least : most < slope ? most : slope;
    }
    /// Row vector times matrix.
    static Vector times(const Vector& row, const Matrix& m) {
        return {dot(m.x, row), dot(m.y, row), dot(m.z, row)};
    }

    StoredGaussians gaussians_;
    glm::dvec3 position_;
    Numbers n_; // before what is made of it
    ViewConstants<Numbers> k_;
    double alpha_min_, cut_;
    SplatOrder order_;
    bool compensated_;
    std::optional<Unscented<Numbers>> unscented_; ///< none: linear
};

/// Rotation matrix of a quaternion in slot order w, x, y, z. Dividing by |q|^2 makes it orthonormal
/// in double although files store unit quaternions rounded to float; zero gives NaN.
template <class Numbers>
auto ProjectorIn<Numbers>::rotation_of(const glm::dvec4& slots) const -> Matrix {
    const Scalar w = n_(slots[0]), x = n_(slots[1]), y = n_(slots[2]), z = n_(slots[3]);
    const Scalar s = k_.two / (w * w + x * x + y * y + z * z);
    const Scalar one = k_.one;
    return {{one - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
            {s * (x * y - w * z), one - s * (x * x + z * z), s * (y * z + w * x)},
            {s * (x * z + w * y), s * (y * z - w * x), one - s * (x * x + y * y)}};
}

/// The distance is formed from slopes, so that no square of a world unit leaves a narrow format.
template <class Numbers>
auto ProjectorIn<Numbers>::depth_of(const Scalar& x, const Scalar& y, const Scalar& z) const
    -> Scalar {
    if (order_ == SplatOrder::Depth) {
        return z;
    }
    const Scalar slope_x = x / z, slope_y = y / z;
    return z * root_of(k_.one + slope_x * slope_x + slope_y * slope_y);
}

template <class Numbers>
void ProjectorIn<Numbers>::set_opacity(const Scalar& opacity, ProjectedSplat& out) const {
    out.opacity = value_of(opacity);
    out.q_threshold = value_of(k_.two * log_of(opacity / k_.alpha_min));
}

template <class Numbers>
void ProjectorIn<Numbers>::set_mean(const Scalar& x, const Scalar& y, const Scalar& z,
                                    ProjectedSplat& out) const {
    out.mu_x = value_of(k_.fx * x / z + k_.middle_x - k_.half);
    out.mu_y = value_of(k_.fy * y / z + k_.middle_y - k_.half);
}

/// From the rows u, v of J Rv R S (2x3). The determinant is Cauchy-Binet's sum of non-negative
/// terms; a c - b^2 loses all digits for needles. The slopes x/z and y/z are limited for the
/// Jacobian only: the linearisation is useless far outside.
template <class Numbers>
auto ProjectorIn<Numbers>::linear_covariance(std::size_t index, const Scalar& x, const Scalar& y,
                                             const Scalar& z) const -> ScreenCovariance<Scalar> {
    const Scalar slope_x = limited(x / z, k_.most_slope_x);
    const Scalar slope_y = limited(y / z, k_.most_slope_y);
    const Vector row_x = (k_.right - k_.forward * slope_x) * (k_.fx / z); // rows of J Rv
    const Vector row_y = (k_.down - k_.forward * slope_y) * (k_.fy / z);
    const Matrix rotation = rotation_of(gaussians_.rotation(index));
    const Vector scale = vector_in(n_, gaussians_.scale(index));
    const Vector u = times(row_x, rotation) * scale;
    const Vector v = times(row_y, rotation) * scale;
    const Vector normal = cross(u, v);
    return {dot(u, u), dot(u, v), dot(v, v), dot(normal, normal)};
}

template <class Numbers>
auto ProjectorIn<Numbers>::set_unscented_mean(std::size_t index, const Vector& seen,
                                              ProjectedSplat& out) const
    -> std::optional<ScreenCovariance<Scalar>> {
    const Matrix rotation = rotation_of(gaussians_.rotation(index));
    const Vector scale = vector_in(n_, gaussians_.scale(index));
    const Vector x = times(k_.right, rotation) * scale; // of the three axes, in view coordinates
    const Vector y = times(k_.down, rotation) * scale;
    const Vector z = times(k_.forward, rotation) * scale;
    const auto image =
        (*unscented_)(seen, {Vector{x.x, y.x, z.x}, Vector{x.y, y.y, z.y}, Vector{x.z, y.z, z.z}});
    if (!image) {
        return std::nullopt;
    }
    out.mu_x = value_of(image->mean.x + k_.middle_x - k_.half);
    out.mu_y = value_of(image->mean.y + k_.middle_y - k_.half);
    return image->covariance;
}

/// Dilates. Returns the factor that makes up for it, see ProjectionOptions::compensated.
template <class Numbers>
auto ProjectorIn<Numbers>::set_covariance(const ScreenCovariance<Scalar>& bare,
                                          ProjectedSplat& out) const -> Scalar {
    const Scalar d = k_.dilation;
    out.cov_a = value_of(bare.a + d);
    out.cov_b = value_of(bare.b);
    out.cov_c = value_of(bare.c + d);
    const Scalar after = bare.det + d * (bare.a + bare.c) + d * d;
    out.det = value_of(after);
    if (!compensated_) {
        return k_.one;
    }
    const Scalar ratio = bare.det / after;
    return root_of(ratio < k_.least_compensation ? k_.least_compensation : ratio);
}

template <class Numbers>
Cull ProjectorIn<Numbers>::project_anywhere(std::size_t index, ProjectedSplat& out) const {
    const glm::dvec3 offset = gaussians_.mean(index) - position_;
    const Vector rounded = vector_in(n_, offset);
    const Scalar z = dot(k_.forward, rounded);
    if (!(z > k_.near_plane)) {
        return !std::isfinite(value_of(z)) && is_finite(gaussians_.given_mean(index) - position_)
                   ? Cull::Degenerate
                   : Cull::Near;
    }
    const Scalar opacity = n_(gaussians_.opacity(index));
    out.id = static_cast<std::uint32_t>(index);
    set_opacity(opacity, out);
    if (!(out.q_threshold >= 0)) {
        return Cull::Transparent;
    }
    const Scalar x = dot(k_.right, rounded);
    const Scalar y = dot(k_.down, rounded);
    out.depth = value_of(depth_of(x, y, z));
    if (!unscented_) {
        set_mean(x, y, z, out);
    }
    const auto bare = unscented_ ? set_unscented_mean(index, {x, y, z}, out)
                                 : std::optional(linear_covariance(index, x, y, z));
    if (!bare) {
        return Cull::OffScreen;
    }
    const Scalar compensation = set_covariance(*bare, out);
    if (is_degenerate(out)) {
        return Cull::Degenerate;
    }
    if (compensated_) {
        set_opacity(opacity * compensation, out);
        if (!(out.q_threshold >= 0)) {
            return Cull::Transparent;
        }
    }
    if (!std::is_same_v<Scalar, double>) {
        make_consistent(out, alpha_min_);
    }
    cut_off(out);
    return Cull::None;
}

template <class Numbers>
Cull ProjectorIn<Numbers>::shade(std::size_t index, ProjectedSplat& out) const {
    Vector direction = vector_in(n_, gaussians_.mean(index) - position_);
    if (gaussians_.sh_degree() > 0) { // without higher bands the colour has no direction
        direction = direction * (k_.one / root_of(dot(direction, direction)));
    }
    StoredGaussians::Sh room;
    const float* const coefficients = gaussians_.sh(index, room);
    const Vector sum = evaluate_sh(n_, gaussians_.sh_degree(), coefficients, direction);
    const double rgb[] = {value_of(k_.half + sum.x), value_of(k_.half + sum.y),
                          value_of(k_.half + sum.z)};
    const bool finite = std::isfinite(rgb[0] + rgb[1] + rgb[2]);
    for (int channel = 0; channel < 3; ++channel) {
        out.colour[channel] = finite && rgb[channel] > 0 ? rgb[channel] : 0.0;
    }
    return finite ? Cull::None : Cull::Degenerate;
}

} // namespace

void check_projection(const Camera& camera, const ProjectionOptions& options) {
    if (options.rule == ProjectionRule::Unscented) {
        if (!options.sigma.is_sound()) {
            throw InputError("The sigma points of the unscented projection have a negative weight "
                             "or no place; alpha^2 (3 + kappa) must be above 0, and 2 - 3 / "
                             "(alpha^2 (3 + kappa)) - alpha^2 + beta at least 0.");
        }
        return;
    }
    if (options.lens == LensRule::Camera && !camera.lens.is_pinhole()) {
        throw InputError("Camera " + std::to_string(camera.id) + " has a lens with distortion (" +
                         camera.lens.name() +
                         "), which the linear projection cannot draw; "
                         "pipeline.rules.projection: unscented draws it, and pipeline.rules.lens: "
                         "pinhole leaves it out (--projection and --lens of commands without a "
                         "configuration).");
    }
}

std::unique_ptr<Projector> make_projector(const GaussianCloud& cloud, const Camera& camera,
                                          const ProjectionOptions& options) {
    check_projection(camera, options);
    using Double = MachineNumbers<double>;
    using Single = MachineNumbers<float>;
    if (options.numbers.format.is_fp64()) {
        return std::make_unique<ProjectorIn<Double>>(cloud, camera, options, Double());
    }
    if (options.numbers.format == parse_format("fp32")) {
        return std::make_unique<ProjectorIn<Single>>(cloud, camera, options, Single());
    }
    return make_rounding_projector(cloud, camera, options);
}

std::unique_ptr<Projector> make_rounding_projector(const GaussianCloud& cloud, const Camera& camera,
                                                   const ProjectionOptions& options) {
    return std::make_unique<ProjectorIn<RoundedNumbers>>(cloud, camera, options,
                                                         RoundedNumbers(options.numbers.format));
}

Cull Projector::project(std::size_t index, ProjectedSplat& out) const {
    return project(index, image_, out);
}

Cull Projector::project(std::size_t index, const PixelBox& bounds, ProjectedSplat& out) const {
    const Cull cull = project_anywhere(index, out);
    if (cull != Cull::None) {
        return cull;
    }
    return pixel_box(out, bounds).empty() ? Cull::OffScreen : Cull::None;
}

PixelBox pixel_box(const ProjectedSplat& splat, const PixelBox& bounds) {
    const double reach_x = std::sqrt(splat.q_end() * splat.cov_a);
    const double reach_y = std::sqrt(splat.q_end() * splat.cov_c);
    const double wide_x = reach_x + pixel_slack(std::abs(splat.mu_x) + reach_x);
    const double wide_y = reach_y + pixel_slack(std::abs(splat.mu_y) + reach_y);
    PixelBox box;
    box.x0 = index_within(std::ceil(splat.mu_x - wide_x), bounds.x0, bounds.x1 + 1.0);
    box.x1 = index_within(std::floor(splat.mu_x + wide_x), bounds.x0 - 1.0, bounds.x1);
    box.y0 = index_within(std::ceil(splat.mu_y - wide_y), bounds.y0, bounds.y1 + 1.0);
    box.y1 = index_within(std::floor(splat.mu_y + wide_y), bounds.y0 - 1.0, bounds.y1);
    return box;
}

Cull project_anywhere(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
                      const ProjectionOptions& options, ProjectedSplat& out) {
    return make_projector(cloud, camera, options)->project_anywhere(index, out);
}

Cull project(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
             const ProjectionOptions& options, ProjectedSplat& out) {
    return make_projector(cloud, camera, options)->project(index, out);
}

Cull shade(const GaussianCloud& cloud, std::size_t index, const Camera& camera, ProjectedSplat& out,
           const ProjectionOptions& options) {
    return make_projector(cloud, camera, options)->shade(index, out);
}

} // namespace degs
