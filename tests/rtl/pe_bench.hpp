// SPDX-License-Identifier: Apache-2.0
// Drives the RTL of a PE with tasks on the pixels of a small Pixel Buffer, which takes back what
// the PE writes, and compares every result, bit by bit, with what the model gives.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "splat/pixels/quantized_pixels.hpp"
#include "tests/rtl/number_code.hpp"
#include "tests/rtl/rtl_folder.hpp"

namespace degs::rtl_test {

/// What a PE knows of a pixel.
struct PixelState {
    double transmittance = 1;
    double rgb[3] = {0, 0, 0};
    bool live = true;
};

/// A task. `fresh` replaces what the pixel was before.
struct PeOperand {
    QuantizedSplat splat;
    double g0 = 0, d0 = 0;
    int n = 0, pixel = 0;
    StopRule stop = StopRule::Refuse;
    std::optional<PixelState> fresh;
    bool of_span = false; ///< as a Span Unit makes them
};

/// A pixel's state in bits, and the class of the task that made it.
struct PeResult {
    std::uint64_t live = 1, t = 0, rgb[3] = {0, 0, 0};
    std::uint64_t useful = 0, boundary = 0, terminated = 0, ended = 0;

    int differences(const PeResult& other) const {
        int bits = 0;
        for (const std::uint64_t each :
             {live ^ other.live, t ^ other.t, rgb[0] ^ other.rgb[0], rgb[1] ^ other.rgb[1],
              rgb[2] ^ other.rgb[2], useful ^ other.useful, boundary ^ other.boundary,
              terminated ^ other.terminated, ended ^ other.ended}) {
            bits += __builtin_popcountll(each);
        }
        return bits;
    }
};
inline std::ostream& operator<<(std::ostream& out, const PeResult& result) {
    return out << std::hex << "live " << result.live << ", T " << result.t << ", sums "
               << result.rgb[0] << " " << result.rgb[1] << " " << result.rgb[2] << ", useful "
               << result.useful << ", boundary " << result.boundary << ", terminated "
               << result.terminated << ", ended " << result.ended << std::dec;
}

/// What was compared. `lanes`: what DataPath::blend does with tasks of spans, in lanes of floats,
/// against the definition.
struct PeCounts {
    std::uint64_t operands = 0, useful = 0, boundary = 0, terminated = 0, ended = 0;
    std::uint64_t at_most_alpha = 0; ///< alpha was limited to 0.99
    std::uint64_t differing_operands = 0, differing_bits = 0, lanes_compared = 0, lanes_differ = 0;
    std::uint64_t lanes_most_units = 0; ///< largest difference of a code
    std::string first;                  ///< difference
};

template <class Rtl>
class PeBench {
public:
    static constexpr int kPixels = 64;

    explicit PeBench(const QuantizedRow& row)
        : row_(row), lanes_(make_quantized_pixels(row)),
          most_alpha_(Rounder(row.set().alpha)(0.99)) {
        const InTableFolder folder;
        lanes_->clear(0, 1);
        rtl_.eval();
        buffer_.fill(code_of_state({}));
    }

    /// The task in the next cycle. Tasks of a pixel must be three cycles apart.
    void put(const PeOperand& operand) {
        drive(operand);
        if (operand.fresh) {
            model_.at(operand.pixel) = *operand.fresh;
        }
        const PeResult fresh = code_of_state(model_[operand.pixel]);
        const PeResult expected = blend(operand);
        step(true);
        waiting_[cycle_ % kStages] = {true, operand, fresh, expected};
    }
    void pause() {
        step(false);
        waiting_[cycle_ % kStages].taken = false;
    }
    const PixelState& pixel(int i) const { return model_.at(i); }
    const PeCounts& finish() {
        for (std::size_t i = 0; i < kStages; ++i) {
            pause();
        }
        return counts_;
    }

private:
    static constexpr std::size_t kStages = 11;
    static constexpr std::size_t kRead = 8;
    struct Waiting {
        bool taken = false;
        PeOperand operand;
        PeResult fresh, expected;
    };

    PeResult code_of_state(const PixelState& pixel) const {
        const NumberSet& set = row_.set();
        PeResult result;
        result.live = pixel.live ? 1 : 0;
        // The 1 that a fixed format of T does not store is its 0.
        result.t = set.transmittance.kind == NumberFormat::Kind::Fixed && pixel.transmittance == 1
                       ? 0
                       : code_of(set.transmittance, pixel.transmittance);
        for (int i = 0; i < 3; ++i) {
            result.rgb[i] = code_of(set.sum, pixel.rgb[i]);
        }
        return result;
    }

    /// The definition of a task: QuantizedRow's q, alpha and recurrence, and the stop rule.
    PeResult blend(const PeOperand& operand) {
        const QuantizedSplat& splat = operand.splat;
        PixelState& pixel = model_.at(operand.pixel);
        const PixelState before = pixel;
        const double q = row_.q(splat.a, operand.g0, operand.d0, operand.n);
        const double alpha = row_.alpha(splat, q);
        const bool inside = q <= splat.q_inside;
        bool ends = false;
        bool blended = false;
        if (pixel.live) {
            QuantizedPixel next{pixel.transmittance, {pixel.rgb[0], pixel.rgb[1], pixel.rgb[2]}};
            row_.blend(alpha, splat.colour, next);
            ends = next.transmittance < 1e-4;
            blended = !ends || operand.stop == StopRule::After;
            if (blended) {
                pixel.transmittance = next.transmittance;
                std::copy(next.rgb, next.rgb + 3, pixel.rgb);
            }
            pixel.live = !ends;
        }
        PeResult result = code_of_state(pixel);
        result.useful = inside && blended ? 1 : 0;
        result.terminated = inside && !blended ? 1 : 0;
        result.boundary = inside ? 0 : 1;
        result.ended = ends ? 1 : 0;
        count(result, alpha);
        if (operand.of_span) {
            compare_lanes(operand, before, result);
        }
        return result;
    }
    void count(const PeResult& result, double alpha) {
        ++counts_.operands;
        counts_.useful += result.useful;
        counts_.boundary += result.boundary;
        counts_.terminated += result.terminated;
        counts_.ended += result.ended;
        counts_.at_most_alpha += alpha == most_alpha_ ? 1 : 0;
    }

    /// What DataPath::blend does, on a pixel of its own.
    void compare_lanes(const PeOperand& operand, const PixelState& before,
                       const PeResult& expected) {
        lanes_->set(0, operand.splat);
        ++counts_.lanes_compared;
        lanes_->write(
            0,
            {{before.rgb[0], before.rgb[1], before.rgb[2]}, before.transmittance, 0, !before.live});
        BlendTask task;
        task.g0 = operand.g0;
        task.d0 = operand.d0;
        task.splat = 0;
        task.mask = 1;
        task.offset = static_cast<std::int16_t>(operand.n);
        const BlendOutcome outcome = lanes_->blend(task, operand.stop == StopRule::Refuse, 0);
        const PixelValue value = lanes_->read(0);
        PeResult result = code_of_state(
            {value.transmittance, {value.rgb[0], value.rgb[1], value.rgb[2]}, !value.ended});
        result.useful = outcome.useful;
        result.boundary = outcome.boundary;
        result.terminated = outcome.terminated;
        result.ended = outcome.ended;
        counts_.lanes_differ += result.differences(expected) != 0 ? 1 : 0;
        const auto apart = [](std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; };
        counts_.lanes_most_units =
            std::max({counts_.lanes_most_units, apart(result.t, expected.t),
                      apart(result.rgb[0], expected.rgb[0]), apart(result.rgb[1], expected.rgb[1]),
                      apart(result.rgb[2], expected.rgb[2])});
    }

    void drive(const PeOperand& operand) {
        const NumberSet& set = row_.set();
        rtl_test::put(rtl_.g0, code_of(set.g0, operand.g0));
        rtl_test::put(rtl_.d0, code_of(set.d0, operand.d0));
        rtl_test::put(rtl_.n, operand.n & 0xFF);
        rtl_test::put(rtl_.conic, code_of(set.conic, operand.splat.a));
        rtl_test::put(rtl_.q_inside, code_of(set.q, operand.splat.q_inside));
        rtl_test::put(rtl_.red, code_of(set.colour, operand.splat.colour[0]));
        rtl_test::put(rtl_.green, code_of(set.colour, operand.splat.colour[1]));
        rtl_test::put(rtl_.blue, code_of(set.colour, operand.splat.colour[2]));
        rtl_test::put(rtl_.stops_after, operand.stop == StopRule::After ? 1 : 0);
    }

    void step(bool valid) {
        rtl_test::put(rtl_.valid, valid ? 1 : 0);
        ++cycle_;
        // The task that was taken kRead cycles ago reads its pixel before this edge.
        const Waiting& reads = waiting_[(cycle_ + kStages - kRead) % kStages];
        if (reads.taken) {
            const PeResult& state =
                reads.operand.fresh ? reads.fresh : buffer_.at(reads.operand.pixel);
            rtl_test::put(rtl_.live_8, state.live);
            rtl_test::put(rtl_.t_8, state.t);
            rtl_test::put(rtl_.red_8, state.rgb[0]);
            rtl_test::put(rtl_.green_8, state.rgb[1]);
            rtl_test::put(rtl_.blue_8, state.rgb[2]);
        }
        rtl_.clk = 0;
        rtl_.eval();
        rtl_.clk = 1;
        rtl_.eval();
        const Waiting& due = waiting_[(cycle_ + 1) % kStages];
        if (cycle_ >= kStages) {
            write_back(due);
        }
    }
    void write_back(const Waiting& due) {
        PeResult result{rtl_.live,   rtl_.t,        {rtl_.red_sum, rtl_.green_sum, rtl_.blue_sum},
                        rtl_.useful, rtl_.boundary, rtl_.terminated,
                        rtl_.ended};
        if (!due.taken) {
            EXPECT_EQ(rtl_.useful + rtl_.boundary + rtl_.terminated + rtl_.ended, 0);
            return;
        }
        buffer_.at(due.operand.pixel) = result;
        const int bits = result.differences(due.expected);
        counts_.differing_operands += bits != 0 ? 1 : 0;
        counts_.differing_bits += bits;
        if (bits != 0 && counts_.first.empty()) {
            std::ostringstream out;
            out.precision(17);
            const PeOperand& operand = due.operand;
            out << "g0 " << operand.g0 << ", d0 " << operand.d0 << ", A " << operand.splat.a
                << ", n " << operand.n << ", pixel " << operand.pixel << "\nmodel: " << due.expected
                << "\nRTL:   " << result;
            counts_.first = out.str();
        }
    }

    const QuantizedRow& row_;
    std::unique_ptr<QuantizedPixels> lanes_;
    double most_alpha_;
    Rtl rtl_;
    std::size_t cycle_ = 0;
    std::array<Waiting, kStages> waiting_;
    std::array<PixelState, kPixels> model_;
    std::array<PeResult, kPixels> buffer_;
    PeCounts counts_;
};

} // namespace degs::rtl_test
