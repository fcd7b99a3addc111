// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/quantized_pixels.hpp"

#include <algorithm>

#include "splat/pixels/quantized_lanes.hpp"

namespace degs {
namespace {

class LanePixels final : public QuantizedPixels {
public:
    explicit LanePixels(const NumberSet& set)
        : numbers_(set), blend_(quantized_blend_function(numbers_.family)),
          test_(quantized_test_function(numbers_.family)) {}

    void set(std::size_t index, const QuantizedSplat& splat) override {
        splats_.resize(std::max(splats_.size(), index + 1));
        splats_[index] = {static_cast<float>(splat.a), static_cast<float>(splat.colour[0]),
                          static_cast<float>(splat.colour[1]), static_cast<float>(splat.colour[2]),
                          static_cast<float>(splat.q_inside)};
    }
    void clear(std::size_t first, std::size_t count) override { pixels_.clear(first, count); }
    BlendOutcome blend(const BlendTask& task, bool refuse, std::size_t first) override {
        return blend_(task, splats_[task.splat], numbers_, refuse, pixels_, first);
    }
    BlendOutcome test(std::uint32_t splat, std::uint32_t mask, const double* q, bool refuse,
                      std::size_t first) override {
        TestedPixels tested;
        tested.mask = mask;
        std::transform(q, q + 32, tested.q, [](double each) { return each; });
        return test_(tested, splats_[splat], numbers_, refuse, pixels_, first);
    }
    PixelValue read(std::size_t pixel) const override { return pixels_.read(pixel); }
    void write(std::size_t pixel, const PixelValue& value) override { pixels_.write(pixel, value); }

private:
    LaneNumbers numbers_;
    QuantizedBlendFunction blend_;
    QuantizedTestFunction test_;
    PixelPlanes<float> pixels_;
    std::vector<BlendRecord<float>> splats_;
};

/// The definition, for formats that lanes of floats cannot carry.
class ScalarPixels final : public QuantizedPixels {
public:
    explicit ScalarPixels(const QuantizedRow& row) : row_(row) {}

    void set(std::size_t index, const QuantizedSplat& splat) override {
        splats_.resize(std::max(splats_.size(), index + 1));
        splats_[index] = splat;
    }
    void clear(std::size_t first, std::size_t count) override { pixels_.clear(first, count); }
    BlendOutcome blend(const BlendTask& task, bool refuse, std::size_t first) override {
        const QuantizedSplat& splat = splats_[task.splat];
        BlendOutcome outcome;
        for (std::uint32_t left = task.mask; left != 0; left &= left - 1) {
            const int i = __builtin_ctz(left);
            const double q = row_.q(splat.a, task.g0, task.d0, task.offset + i);
            const bool drawn = !(row_.set().q_mask && q > splat.q_inside);
            update(splat, q, drawn, refuse, first, i, outcome);
        }
        return outcome;
    }
    BlendOutcome test(std::uint32_t splat, std::uint32_t mask, const double* q, bool refuse,
                      std::size_t first) override {
        BlendOutcome outcome;
        for (std::uint32_t left = mask; left != 0; left &= left - 1) {
            const int i = __builtin_ctz(left);
            update(splats_[splat], q[i], q[i] <= splats_[splat].q_inside, refuse, first, i,
                   outcome);
        }
        return outcome;
    }
    PixelValue read(std::size_t pixel) const override { return pixels_.read(pixel); }
    void write(std::size_t pixel, const PixelValue& value) override { pixels_.write(pixel, value); }

private:
    void update(const QuantizedSplat& splat, double q, bool drawn, bool refuse, std::size_t first,
                int i, BlendOutcome& outcome) {
        const std::size_t at = first + i;
        const std::uint32_t bit = 1U << i;
        bool blended = false;
        if (drawn && pixels_.live[at] != 0) {
            QuantizedPixel pixel{pixels_.transmittance[at],
                                 {pixels_.r[at], pixels_.g[at], pixels_.b[at]}};
            row_.blend(row_.alpha(splat, q), splat.colour, pixel);
            const bool ends = pixel.transmittance < 1e-4;
            blended = !(ends && refuse);
            pixels_.live[at] = ends ? 0 : 1;
            outcome.ended |= ends ? bit : 0;
            if (blended) {
                pixels_.transmittance[at] = pixel.transmittance;
                pixels_.r[at] = pixel.rgb[0];
                pixels_.g[at] = pixel.rgb[1];
                pixels_.b[at] = pixel.rgb[2];
                pixels_.updates[at]++;
            }
        }
        std::uint32_t& part = !(q <= splat.q_inside) ? outcome.boundary
                              : blended              ? outcome.useful
                                                     : outcome.terminated;
        part |= bit;
    }

    const QuantizedRow& row_;
    PixelPlanes<double> pixels_;
    std::vector<QuantizedSplat> splats_;
};

} // namespace

std::unique_ptr<QuantizedPixels> make_quantized_pixels(const QuantizedRow& row) {
    if (lanes_can(row.set())) {
        return std::make_unique<LanePixels>(row.set());
    }
    return std::make_unique<ScalarPixels>(row);
}

} // namespace degs
