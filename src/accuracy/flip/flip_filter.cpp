// SPDX-License-Identifier: Apache-2.0
#include "accuracy/flip/flip_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "accuracy/flip/flip_colour.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr double kFeatureWidth = 0.082; // degrees; of the widest edge that is seen as one

/// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees: the publication's model of a
/// channel's contrast sensitivity.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity kAchromatic{1, 0.0047};
constexpr Sensitivity kRedGreen{1, 0.0053};
constexpr Sensitivity kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

/// exp(-x^2 / (2 sigma^2)) at whole x from -radius on.
std::vector<double> gaussian(double sigma, int radius) {
    std::vector<double> taps;
    for (int x = -radius; x <= radius; ++x) {
        taps.push_back(std::exp(-x * x / (2 * sigma * sigma)));
    }
    return taps;
}

double sum_of(const std::vector<double>& taps) {
    double sum = 0;
    for (const double tap : taps) {
        sum += tap;
    }
    return sum;
}

/// Positive taps to sum 1, negative ones to sum -1.
FlipKernels::Taps taps_of_unit_sum(const std::vector<double>& taps) {
    double positive = 0;
    double negative = 0;
    for (const double tap : taps) {
        (tap > 0 ? positive : negative) += tap;
    }
    FlipKernels::Taps out;
    for (const double tap : taps) {
        out.push_back(static_cast<float>(tap > 0 ? tap / positive : tap < 0 ? -tap / negative : 0));
    }
    return out;
}

double sigma_of(const Sensitivity& channel, double pixels_per_degree) {
    return std::sqrt(channel.b / 2) / kPi * pixels_per_degree;
}

} // namespace

FlipKernels::FlipKernels(double pixels_per_degree) {
    const double widest = sigma_of(kBlueYellow[0], pixels_per_degree);
    const double feature = 0.5 * kFeatureWidth * pixels_per_degree;
    const int sensitivity_radius = static_cast<int>(std::ceil(3 * widest));
    const int feature_radius = static_cast<int>(std::ceil(3 * feature));
    radius = std::max(sensitivity_radius, feature_radius);
    const auto taps_of = [&](double sigma, int reach) { // 0 beyond its own reach
        std::vector<double> taps = gaussian(sigma, radius);
        for (int x = -radius; x <= radius; ++x) {
            taps[x + radius] *= std::abs(x) <= reach ? 1.0 : 0.0;
        }
        return taps;
    };
    const auto channel = [&](const Sensitivity& of) {
        return taps_of(sigma_of(of, pixels_per_degree), sensitivity_radius);
    };
    achromatic = taps_of_unit_sum(channel(kAchromatic));
    red_green = taps_of_unit_sum(channel(kRedGreen));
    double mass[2];
    for (int i = 0; i < 2; ++i) {
        const double line = sum_of(channel(kBlueYellow[i]));
        mass[i] = kBlueYellow[i].a * std::sqrt(kPi / kBlueYellow[i].b) * line * line;
    }
    blue_yellow_wide = taps_of_unit_sum(channel(kBlueYellow[0]));
    blue_yellow_narrow = taps_of_unit_sum(channel(kBlueYellow[1]));
    wide_weight = static_cast<float>(mass[0] / (mass[0] + mass[1]));
    narrow_weight = 1 - wide_weight;

    const std::vector<double> bell = taps_of(feature, feature_radius);
    std::vector<double> first = bell;
    std::vector<double> second = bell;
    for (int x = -radius; x <= radius; ++x) {
        const std::size_t at = x + radius;
        first[at] *= -x;
        second[at] *= x * x / (feature * feature) - 1;
    }
    smooth = taps_of_unit_sum(bell);
    edge = taps_of_unit_sum(first);
    point = taps_of_unit_sum(second);
}

FlipFilter::FlipFilter(const Image& image, const FlipKernels& kernels)
    : image_(image), kernels_(kernels), width_(image.width), ring_(2 * kernels.radius + 1),
      across_(width_), down_(width_) {
    for (std::vector<float>& line : padded_) {
        line.resize(width_ + 2 * kernels.radius);
    }
}

void FlipFilter::read_row(int row) {
    const std::size_t radius = kernels_.radius;
    const float* rgb = image_.rgb.data() + image_.at(0, row) * 3;
    for (std::size_t x = 0; x < width_; ++x) {
        const glm::dvec3 srgb(rgb[3 * x], rgb[3 * x + 1], rgb[3 * x + 2]);
        const glm::dvec3 colour = ycxcz_of_linear(linear_of_srgb(srgb));
        for (int channel = 0; channel < 3; ++channel) {
            padded_[channel][radius + x] = static_cast<float>(colour[channel]);
        }
    }
    for (std::vector<float>& line : padded_) {
        std::fill_n(line.begin(), radius, line[radius]);
        std::fill_n(line.end() - kernels_.radius, radius, line[radius + width_ - 1]);
    }
    Planes& planes = ring_[row % ring_.size()];
    along_row(padded_[0], kernels_.achromatic, planes.achromatic);
    along_row(padded_[1], kernels_.red_green, planes.red_green);
    along_row(padded_[2], kernels_.blue_yellow_narrow, planes.narrow);
    along_row(padded_[2], kernels_.blue_yellow_wide, planes.wide);
    along_row(padded_[0], kernels_.smooth, planes.smooth);
    along_row(padded_[0], kernels_.edge, planes.edge);
    along_row(padded_[0], kernels_.point, planes.point);
}

void FlipFilter::along_row(const std::vector<float>& padded, const FlipKernels::Taps& taps,
                           std::vector<float>& out) const {
    out.assign(width_, 0.0F);
    for (std::size_t k = 0; k < taps.size(); ++k) {
        for (std::size_t x = 0; x < width_; ++x) {
            out[x] += taps[k] * padded[x + k];
        }
    }
}

/// Adds `weight` times the plane's column filter around the current row.
void FlipFilter::along_column(std::vector<float> Planes::*plane, const FlipKernels::Taps& taps,
                              float weight, std::vector<float>& sum) const {
    for (int k = -kernels_.radius; k <= kernels_.radius; ++k) {
        const std::size_t row = std::clamp(row_ + k, 0, image_.height - 1);
        const std::vector<float>& line = ring_[row % ring_.size()].*plane;
        const float tap = weight * taps[k + kernels_.radius];
        for (std::size_t x = 0; x < width_; ++x) {
            sum[x] += tap * line[x];
        }
    }
}

const FlipRow& FlipFilter::next() {
    for (; read_ <= std::min(row_ + kernels_.radius, image_.height - 1); ++read_) {
        read_row(read_);
    }
    for (std::vector<float>* line : {&out_.y, &out_.cx, &out_.cz, &out_.edge, &out_.point}) {
        line->assign(width_, 0.0F);
    }
    along_column(&Planes::achromatic, kernels_.achromatic, 1, out_.y);
    along_column(&Planes::red_green, kernels_.red_green, 1, out_.cx);
    along_column(&Planes::narrow, kernels_.blue_yellow_narrow, kernels_.narrow_weight, out_.cz);
    along_column(&Planes::wide, kernels_.blue_yellow_wide, kernels_.wide_weight, out_.cz);
    const auto strength = [&](std::vector<float> Planes::*plane, const FlipKernels::Taps& taps,
                              std::vector<float>& out) {
        std::fill(across_.begin(), across_.end(), 0.0F);
        std::fill(down_.begin(), down_.end(), 0.0F);
        along_column(plane, kernels_.smooth, 1.0F / 116, across_); // of Y in 0 .. 1
        along_column(&Planes::smooth, taps, 1.0F / 116, down_);
        for (std::size_t x = 0; x < width_; ++x) {
            out[x] = std::hypot(across_[x], down_[x]);
        }
    };
    strength(&Planes::edge, kernels_.edge, out_.edge);
    strength(&Planes::point, kernels_.point, out_.point);
    ++row_;
    return out_;
}

} // namespace degs
