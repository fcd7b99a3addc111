// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "splat/frame/pixel_rules.hpp"
#include "splat/frame/sigma_points.hpp"
#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"
#include "splat/model/pixel_box.hpp"
#include "splat/numbers/projection_numbers.hpp"

namespace degs {

/// By what splats are ordered, near to far: view z (original 3DGS rasteriser), or the Euclidean
/// distance of the mean to the camera (KHR_gaussian_splatting).
enum class SplatOrder { Depth, Distance };

/// How Gaussians become ellipses: by the Jacobian of a pinhole (EWA splatting, the original 3DGS
/// rasteriser), or by sigma points that go through the camera's lens (3DGUT), see Unscented.
enum class ProjectionRule { Linear, Unscented };

/// Whose lens projects: the camera's, or none, which leaves distortion out.
enum class LensRule { Camera, Pinhole };

/// A cut at this q or beyond is none: alpha is below 1/255 from q = 2 ln 255 = 11.08 on.
constexpr double kNoCut = 12;

/// Constants of the projection; the defaults are those of the original 3DGS rasteriser, in double.
struct ProjectionOptions {
    double near_plane = 0.2; ///< scene units; splats at or before it are dropped
    double dilation = 0.3;   ///< px^2, low-pass filter added to both variances
    /// Linear: times tan(fov/2) of the camera's raster; limits x/z and y/z in the Jacobian only.
    /// Unscented: times the radius of the raster's corner; limits sigma points only.
    double jacobian_clamp = 1.3;
    double alpha_min = 1.0 / 255.0; ///< support threshold (paper Eq. 7)
    double cut = kNoCut;            ///< largest q at which a splat is drawn, the limit included
    SplatOrder order = SplatOrder::Depth;
    ProjectionRule rule = ProjectionRule::Linear;
    LensRule lens = LensRule::Camera;
    SigmaPoints sigma; ///< of an unscented projection
    /// Opacities are multiplied by sqrt(max(kLeastCompensation, det before / det after dilation)),
    /// so that splats thinner than a pixel keep their weight when the low-pass filter widens them
    /// (Mip-Splatting; option `antialiasing` of the original code).
    bool compensated = false;
    ProjectionNumbers numbers; ///< in which formats, and what lists are sorted by
};

/// The smallest ratio of determinants that counts, as in the original code.
constexpr double kLeastCompensation = 0.000025;

/// A Gaussian on the screen, in the format that projected it; a and opacity fit b, c, det and Q_th
/// before the cut.
/// q(x, y) = A dx^2 + 2 B dx dy + C dy^2 with dx = x - mu_x; pixel (i, j) of the camera's raster is
/// sampled at integer (i, j) (mu is shifted by -0.5 accordingly).
struct ProjectedSplat {
    double mu_x = 0, mu_y = 0;              ///< px
    double cov_a = 0, cov_b = 0, cov_c = 0; ///< dilated covariance xx, xy, yy; px^2
    double det = 0;               ///< of the dilated covariance, by Cauchy-Binet; px^4, > 0
    double opacity = 0;           ///< 0..1, compensated if the options say so
    double q_threshold = 0;       ///< Q_th = min(2 ln(opacity / alpha_min), cut), >= 0
    double q_cut_off = 0;         ///< 2 ln(opacity / alpha_min) - Q_th: 0 unless the cut is nearer
    double colour[3] = {0, 0, 0}; ///< >= 0, not clamped above
    double depth = 0;             ///< what it is ordered by, scene units; see SplatOrder
    std::uint32_t id = 0;         ///< index in the cloud

    /// Largest q inside: Q_th, with kCutMargin where a cut ends the splat. Pixel tests and
    /// everything that bounds them use this one.
    double q_end() const { return q_cut_off > 0 ? q_threshold + kCutMargin : q_threshold; }
    double conic_a() const { return cov_c / det; }
    double conic_b() const { return -cov_b / det; }
    double conic_c() const { return cov_a / det; }
};

/// Why a Gaussian produced no splat. Degenerate: a result is not finite in the projection's format,
/// or det is not positive (only possible without dilation, or where squares vanish in the format).
enum class Cull { None, Near, Transparent, Degenerate, OffScreen };

/// Tolerance of every conservative pixel test, px: far above the rounding of a coordinate (about
/// 1e-16 of its magnitude), far below anything that matters. Grows with huge coordinates.
inline double pixel_slack(double magnitude) {
    return 1e-6 + 1e-12 * magnitude;
}

/// The pixel centres of `bounds` within the bounding box mu +- sqrt(Q_th cov) of the ellipse,
/// widened by `pixel_slack`; safe against coordinates far beyond the range of int.
PixelBox pixel_box(const ProjectedSplat& splat, const PixelBox& bounds);

/// Projects and shades the Gaussians of a scene for one camera, in the format of the options. The
/// mean's offset from the camera is formed in double and rounded once: a scene is stored relative
/// to an origin near its cameras, and world offsets of 1e7 must not swallow small splats. Scales,
/// rotations, opacities, SH coefficients and constants are rounded once; so is every operation.
///
/// Not modelled: pixel boxes and tile covers in a format of their own; they are worked out in
/// double from the splat as it was rounded.
class Projector {
public:
    virtual ~Projector() = default;

    /// Projects Gaussian `index` wherever it lands; OffScreen only means that no sigma
    /// point lies near the image (unscented). For tile modes that decide visibility by themselves.
    /// On Cull::None `out` is complete except for its colour. Linear is EWA splatting (paper Eq.
    /// 1-3) with the determinant formed without cancellation: det = |u x v|^2 + d (|u|^2 + |v|^2) +
    /// d^2 with u, v the rows of J R S and d the dilation.
    virtual Cull project_anywhere(std::size_t index, ProjectedSplat& out) const = 0;

    /// View-dependent colour max(0, 0.5 + sum c_k Y_k(dir)), per channel. None, or Degenerate if a
    /// channel is not finite (black then).
    virtual Cull shade(std::size_t index, ProjectedSplat& out) const = 0;

    /// OffScreen means: no pixel centre of the image lies inside the ellipse's bounding box.
    Cull project(std::size_t index, ProjectedSplat& out) const;
    /// Does so for any part of the raster.
    Cull project(std::size_t index, const PixelBox& bounds, ProjectedSplat& out) const;

protected:
    explicit Projector(const Camera& camera) : image_(camera.window()) {}

private:
    PixelBox image_;
};

/// Throws InputError, which names the keys, for a distorted lens that is to be projected linearly,
/// and for sigma points of negative weight.
void check_projection(const Camera& camera, const ProjectionOptions& options);

/// The cloud outlives the projector. Throws as check_projection() does.
std::unique_ptr<Projector> make_projector(const GaussianCloud& cloud, const Camera& camera,
                                          const ProjectionOptions& options);

/// A projector with every operation computed in double and rounded afterwards, whatever the format;
/// fp32 is the machine's own to the bit. For tests.
std::unique_ptr<Projector> make_rounding_projector(const GaussianCloud& cloud, const Camera& camera,
                                                   const ProjectionOptions& options);

/// Single Gaussians, see Projector.
Cull project_anywhere(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
                      const ProjectionOptions& options, ProjectedSplat& out);
Cull project(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
             const ProjectionOptions& options, ProjectedSplat& out);
Cull shade(const GaussianCloud& cloud, std::size_t index, const Camera& camera, ProjectedSplat& out,
           const ProjectionOptions& options = {});

} // namespace degs
