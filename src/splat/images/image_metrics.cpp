// SPDX-License-Identifier: Apache-2.0
#include "splat/images/image_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "base/parallel.hpp"
#include "base/ratio.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

constexpr int kRadius = 5; // px; window 11 x 11
constexpr int kTaps = 2 * kRadius + 1;
constexpr double kSigma = 1.5;      // px
constexpr double kC1 = 0.01 * 0.01; // (K1 L)^2 and (K2 L)^2 with L = 1
constexpr double kC2 = 0.03 * 0.03;
constexpr std::size_t kChannels = 3;

using Line = std::vector<double>;

/// The local sums SSIM needs, for one row of interleaved channels.
struct Moments {
    Line x, y, xx, yy, xy;
    explicit Moments(std::size_t length)
        : x(length), y(length), xx(length), yy(length), xy(length) {}
};

std::array<double, kTaps> gaussian_window() {
    std::array<double, kTaps> window{};
    double sum = 0;
    for (int tap = 0; tap < kTaps; ++tap) {
        const double distance = tap - kRadius;
        window[tap] = std::exp(-distance * distance / (2 * kSigma * kSigma));
        sum += window[tap];
    }
    for (double& weight : window) {
        weight /= sum;
    }
    return window;
}

/// Walks a band of rows of the images once, keeping the horizontally filtered rows of one window
/// height.
class StructuralSimilarity {
public:
    StructuralSimilarity(const Image& first, const Image& second)
        : first_(first), second_(second), length_(first.width * kChannels),
          padded_(length_ + 2 * kPad), row_(length_), ring_(kTaps, Moments(length_)) {}

    /// The sums of rows begin .. end - 1, to sums[begin] and after.
    void add(int begin, int end, Line& sums) {
        for (int y = std::max(begin - kRadius, 0); y < end + kRadius; ++y) {
            if (y < first_.height) {
                filter_row(y);
            }
            if (y >= begin + kRadius) {
                sums[y - kRadius] = row_sum(y - kRadius);
            }
        }
    }

private:
    static constexpr std::size_t kPad = kRadius * kChannels;

    void filter_row(int y);
    void convolve(const Line& padded, Line& out) const;
    double row_sum(int y);
    void gather(Line Moments::*plane, int y);

    const Image& first_;
    const Image& second_;
    std::array<double, kTaps> window_ = gaussian_window();
    std::size_t length_;        ///< values per row
    Moments padded_;            ///< products of one row with zeros on both sides
    Moments row_;               ///< fully filtered
    std::vector<Moments> ring_; ///< row y at y mod kTaps
};

void StructuralSimilarity::filter_row(int y) {
    const float* first = first_.rgb.data() + first_.at(0, y) * kChannels;
    const float* second = second_.rgb.data() + second_.at(0, y) * kChannels;
    for (std::size_t i = 0; i < length_; ++i) {
        const double a = first[i], b = second[i];
        padded_.x[kPad + i] = a;
        padded_.y[kPad + i] = b;
        padded_.xx[kPad + i] = a * a;
        padded_.yy[kPad + i] = b * b;
        padded_.xy[kPad + i] = a * b;
    }
    Moments& out = ring_[y % kTaps];
    convolve(padded_.x, out.x);
    convolve(padded_.y, out.y);
    convolve(padded_.xx, out.xx);
    convolve(padded_.yy, out.yy);
    convolve(padded_.xy, out.xy);
}

void StructuralSimilarity::convolve(const Line& padded, Line& out) const {
    for (std::size_t i = 0; i < length_; ++i) {
        const double* tap = padded.data() + i;
        double sum = 0;
        for (std::size_t k = 0; k < kTaps; ++k) {
            sum += window_[k] * tap[k * kChannels];
        }
        out[i] = sum;
    }
}

/// The vertical pass of one plane around row y; rows outside the image are zero.
void StructuralSimilarity::gather(Line Moments::*plane, int y) {
    Line& out = row_.*plane;
    std::fill(out.begin(), out.end(), 0.0);
    const int top = std::max(0, y - kRadius);
    const int bottom = std::min(first_.height - 1, y + kRadius);
    for (int source = top; source <= bottom; ++source) {
        const double weight = window_[source - y + kRadius];
        const Line& in = ring_[source % kTaps].*plane;
        for (std::size_t i = 0; i < length_; ++i) {
            out[i] += weight * in[i];
        }
    }
}

double StructuralSimilarity::row_sum(int y) {
    gather(&Moments::x, y);
    gather(&Moments::y, y);
    gather(&Moments::xx, y);
    gather(&Moments::yy, y);
    gather(&Moments::xy, y);
    double sum = 0;
    for (std::size_t i = 0; i < length_; ++i) {
        const double a = row_.x[i], b = row_.y[i];
        const double covariance = row_.xy[i] - a * b;
        const double variances = (row_.xx[i] - a * a) + (row_.yy[i] - b * b);
        sum += (2 * a * b + kC1) * (2 * covariance + kC2) /
               ((a * a + b * b + kC1) * (variances + kC2));
    }
    return sum;
}

double mean_similarity(const Image& first, const Image& second) {
    constexpr int kBand = 64; // rows: long against the rows of a window
    Line sums(first.height);
    parallel_blocks((first.height + kBand - 1) / kBand, [&](std::size_t block, std::size_t) {
        const int begin = static_cast<int>(block) * kBand;
        StructuralSimilarity(first, second).add(begin, std::min(begin + kBand, first.height), sums);
    });
    return mean_of(std::accumulate(sums.begin(), sums.end(), 0.0), first.rgb.size());
}

} // namespace

void check_comparable(const Image& reference, const Image& test) {
    const auto size = [](const Image& image) {
        return std::to_string(image.width) + " x " + std::to_string(image.height);
    };
    if (reference.width != test.width || reference.height != test.height) {
        throw InputError("An image of " + size(test) + " pixels cannot be compared with one of " +
                         size(reference) + "; both must have the same size.");
    }
    if (reference.pixels() == 0) {
        throw InputError("Images of " + size(test) +
                         " pixels cannot be compared; at least one pixel is needed.");
    }
}

bool PixelErrors::is_worse(double error, double than) {
    return error > than || (std::isnan(error) && !std::isnan(than));
}

double PixelErrors::add(const Image& reference, const Image& test, std::size_t pixel) {
    double largest = std::abs(double{reference.transmittance[pixel]} - test.transmittance[pixel]);
    for (std::size_t c = kChannels * pixel; c < kChannels * (pixel + 1); ++c) {
        const double error = std::abs(double{reference.rgb[c]} - test.rgb[c]);
        squares_ += error * error;
        largest = is_worse(error, largest) ? error : largest;
    }
    worst_ = is_worse(largest, worst_) ? largest : worst_;
    return largest;
}

double PixelErrors::psnr_db(std::size_t pixels) const {
    return -10 * std::log10(mean_of(squares_, kChannels * pixels));
}

ImageError compare_images(const Image& reference, const Image& test) {
    check_comparable(reference, test);
    PixelErrors errors;
    for (std::size_t pixel = 0; pixel < reference.pixels(); ++pixel) {
        errors.add(reference, test, pixel);
    }
    ImageError result;
    result.psnr_db = errors.psnr_db(reference.pixels());
    result.max_abs_error = errors.worst();
    result.ssim = mean_similarity(reference, test);
    return result;
}

} // namespace degs
