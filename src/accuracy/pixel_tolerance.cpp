// SPDX-License-Identifier: Apache-2.0
#include "accuracy/pixel_tolerance.hpp"

#include <algorithm>
#include <cmath>

#include "splat/frame/pixel_rules.hpp"

namespace degs {
namespace {

constexpr double kPerPixel = 1.11;   ///< e^-1/2 / sqrt(0.3): steepest alpha of a dilated splat
constexpr double kAlongRow = 0.6066; ///< e^-1/2: the same times the deviation along a row
constexpr double kAlphaQ = 0.368;    ///< e^-1: largest alpha q f
constexpr double kNoAlpha = 1e-7;    ///< fainter pixels are more than a pixel outside

/// Half a unit of a format at a value.
double half_unit(const NumberFormat& format, double at) {
    return format.kind == NumberFormat::Kind::Fixed
               ? format.quantum() / 2
               : std::max(std::ldexp(std::abs(at), -format.fraction_bits - 1),
                          format.quantum() / 2);
}

/// Bound on alpha's error from all that happens to q' behind the geometry.
double of_q(const NumberSet& set) {
    const double limit = set.q_limit();
    const double per_unit = set.exponent == Exponent::Natural ? 0.5 : std::log(2.0);
    const double levels = half_unit(set.g0, limit) + 3 * half_unit(set.level, limit);
    // From a span's start on, n d0 and A n(n-1) are twice the limit each and more where alpha is 1.
    const bool start = set.base == Base::Start;
    const double terms = start ? 2 * limit : limit;
    const double sums = 4 * half_unit(set.term, terms) + 2 * half_unit(set.q, terms);
    const double first = half_unit(set.d0, 1) * (start ? terms * per_unit : kAlphaQ);
    return per_unit * (levels + sums) + first + kAlphaQ * half_unit(set.conic, 1);
}

/// ... from x = dy^2 / r_y^2 and Q_th or C'.
double of_height(const NumberSet& set) {
    const double per_unit = set.exponent == Exponent::Natural ? 0.5 : std::log(2.0);
    const double limit = set.q_limit();
    const double products = 2 * half_unit(set.square, 1);
    if (set.vertical == Vertical::FromRatio) {
        return kAlphaQ * (products + half_unit(set.inverse_radius2, 1)) +
               per_unit * 2 * (limit * half_unit(set.ratio, 1) + half_unit(set.q_threshold, limit));
    }
    return kAlphaQ * (products + half_unit(set.c_prime, 1)) +
           per_unit * 2 * half_unit(set.q_threshold, limit);
}

/// ... from where a row's ellipse is, for the splat that suffers most.
double of_place(const NumberSet& set, const FrameWorkload& work) {
    const double width = work.camera.window().x1 + 1; // of the raster, up to the image's end
    const double height = work.camera.window().y1 + 1;
    const bool coordinate = set.mean_form == Mean::Coordinate;
    double most = 0;
    for (const ProjectedSplat& s : work.splats) {
        const double rows = std::min(height, std::sqrt(s.q_end() * s.cov_c));
        const double across = std::min(std::abs(s.cov_b) / s.cov_c * rows, 2 * width);
        const double edges = 2 * half_unit(set.edge, coordinate ? width : across) +
                             half_unit(set.distance, across) + 2 * half_unit(set.square, 1);
        const double slope = half_unit(set.slope, 1) * across;
        most = std::max(most, kAlongRow * std::sqrt(s.conic_a()) * (edges + slope));
    }
    return most + kPerPixel * (2 * half_unit(set.mean, coordinate ? width : 0.5) +
                               half_unit(set.distance, coordinate ? height : 0.5));
}

double of_table(const TableSpec& spec) {
    const bool exact = spec.interpolation == Interpolation::Exact;
    const double argument =
        spec.reduction == Reduction::Binary ? kAlphaQ * 2 * half_unit(spec.argument, 1) : 0;
    return (exact ? 0 : LookupTable(spec).shape_error()) + argument + 3 * half_unit(spec.values, 1);
}

} // namespace

NumberTolerance tolerance_of(const NumberSet& set, const FrameWorkload& workload) {
    NumberTolerance tolerance;
    tolerance.alpha = of_q(set) + of_height(set) + of_place(set, workload) + of_table(set.exp) +
                      half_unit(set.alpha, 1);
    tolerance.update = half_unit(set.sum, 1) + 2 * half_unit(set.weight, 1) +
                       2 * half_unit(set.transmittance, 1) + half_unit(set.colour, 1);
    tolerance.outward = set.ends != SpanEnds::Exact;
    return tolerance;
}

double pixel_tolerance(const FrameWorkload& workload, int x, int y,
                       const NumberTolerance& numbers) {
    const int tile = workload.grid().tile_of_pixel(x, y);
    const double alpha_min = workload.projection.alpha_min;
    double left = 1; // transmittance
    double sum = 0;
    double brightest = 0;
    for (std::uint64_t i = workload.tile_begin[tile]; i < workload.tile_begin[tile + 1]; ++i) {
        const ProjectedSplat& s = workload.splats[workload.tile_splats[i]];
        const double dy = y - s.mu_y;
        const double u = x - s.mu_x - s.cov_b / s.cov_c * dy;
        const double q = s.conic_a() * u * u + dy * dy / s.cov_c;
        const double alpha = std::min(kAlphaMax, s.opacity * std::exp(-0.5 * q));
        const double least =
            alpha_min * std::exp(0.5 * (s.q_threshold + s.q_cut_off - s.q_end())); // at the edge
        if (alpha < (numbers.outward ? kNoAlpha : least - numbers.alpha)) {
            continue;
        }
        brightest = std::max({brightest, s.colour[0], s.colour[1], s.colour[2]});
        if (alpha < least + numbers.alpha) { // drawn or not
            sum += left * (alpha + numbers.alpha);
        }
        if (alpha < least) {
            continue;
        }
        sum += left * numbers.alpha + numbers.update;
        const double next = left * (1 - alpha);
        if (next < 2e-4) { // ends here or a little later
            sum += left;
        }
        if (next < kStopTransmittance) {
            break;
        }
        left = next;
    }
    return brightest * sum;
}

} // namespace degs
