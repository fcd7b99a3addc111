// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "splat/camera.hpp"
#include "splat/gaussian.hpp"

namespace degs {

/// Constants of the projection; the defaults are those of the original 3DGS rasteriser.
struct ProjectionOptions {
    double near_plane = 0.2;        ///< scene units; splats at or before it are dropped
    double dilation = 0.3;          ///< px^2, low-pass filter added to both variances
    double jacobian_clamp = 1.3;    ///< times tan(fov/2); limits x/z and y/z in the Jacobian only
    double alpha_min = 1.0 / 255.0; ///< support threshold (paper Eq. 7)
};

/// A Gaussian on the screen, in double precision. q(x, y) = A dx^2 + 2 B dx dy + C dy^2 with
/// dx = x - mu_x; pixel (i, j) is sampled at integer (i, j) (mu is shifted by -0.5 accordingly).
struct ProjectedSplat {
    double mu_x = 0, mu_y = 0;              ///< px
    double cov_a = 0, cov_b = 0, cov_c = 0; ///< dilated covariance xx, xy, yy; px^2
    double det = 0;               ///< of the dilated covariance, by Cauchy-Binet; px^4, > 0
    double opacity = 0;           ///< 0..1
    double q_threshold = 0;       ///< Q_th = 2 ln(opacity / alpha_min), >= 0
    double colour[3] = {0, 0, 0}; ///< >= 0, not clamped above
    double depth = 0;             ///< view z, scene units
    std::uint32_t id = 0;         ///< index in the cloud

    double conic_a() const { return cov_c / det; }
    double conic_b() const { return -cov_b / det; }
    double conic_c() const { return cov_a / det; }
};

/// Why a Gaussian produced no splat. Degenerate: a result is not finite, or det is not positive
/// (only possible without dilation).
enum class Cull { None, Near, Transparent, Degenerate, OffScreen };

/// Inclusive ranges of pixels, clipped to the image.
struct PixelBox {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
    bool empty() const { return x1 < x0 || y1 < y0; }
};

/// Tolerance of every conservative pixel test, px: far above the rounding of a coordinate (about
/// 1e-16 of its magnitude), far below anything that matters. Grows with huge coordinates.
inline double pixel_slack(double magnitude) {
    return 1e-6 + 1e-12 * magnitude;
}

/// The pixel centres within the bounding box mu +- sqrt(Q_th cov) of the ellipse, widened by
/// `pixel_slack`; safe against coordinates far beyond the range of int.
PixelBox pixel_box(const ProjectedSplat& splat, int width, int height);

/// Projects Gaussian `index` wherever it lands; never returns OffScreen. For tile modes that have
/// their own idea of visibility.
Cull project_anywhere(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
                      const ProjectionOptions& options, ProjectedSplat& out);

/// Projects Gaussian `index`; on Cull::None `out` is complete except for its colour.
/// EWA splatting (paper Eq. 1-3) with the determinant formed without cancellation:
/// det = |u x v|^2 + d (|u|^2 + |v|^2) + d^2 with u, v the rows of J R S and d the dilation.
/// OffScreen means: no pixel centre of the image lies inside the ellipse's bounding box.
Cull project(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
             const ProjectionOptions& options, ProjectedSplat& out);

/// View-dependent colour max(0, 0.5 + sum c_k Y_k(dir)), per channel, in double.
void shade(const GaussianCloud& cloud, std::size_t index, const Camera& camera,
           ProjectedSplat& out);

} // namespace degs
