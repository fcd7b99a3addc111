// SPDX-License-Identifier: Apache-2.0
// The data path of a number set is QuantizedRow, span by span and pixel by pixel.
#include "splat/quantized_data_path.hpp"

#include <cstring>

#include "splat/error.hpp"
#include "splat/number_override.hpp"
#include "splat/quantized_lanes.hpp"
#include "tests/splat/data_path_fixture.hpp"

namespace degs {
namespace {

using test::frame_of;
using test::make_splat;
using test::path_of;
using test::random_splat;

constexpr int kTile = 32;
constexpr int kX = 1984; // corner of the tile in the image
constexpr int kY = 992;

NumberSet with_ends(NumberSet set, SpanEnds ends, int delta = 0) {
    set.ends = ends;
    set.delta = delta;
    return set;
}

/// The tasks of a span, in segments of 16 px.
std::vector<BlendTask> tasks_of(const RowSpan& span) {
    std::vector<BlendTask> tasks;
    for (int column = 0; column < kTile; column += 16) {
        BlendTask task;
        task.g0 = span.g0;
        task.d0 = span.d0;
        task.splat = span.splat;
        task.row = span.y;
        task.column = static_cast<std::int16_t>(column);
        task.offset = static_cast<std::int16_t>(column - span.base);
        for (int x = span.x0; x < span.x0 + span.length; ++x) {
            task.mask |= x >= column && x < column + 16 ? 1U << (x - column) : 0U;
        }
        if (task.mask != 0) {
            tasks.push_back(task);
        }
    }
    return tasks;
}

/// A pixel by the definition.
struct Pixel {
    QuantizedPixel state;
    bool live = true;
    std::uint32_t updates = 0;

    /// Returns whether the pixel took the splat.
    bool update(const QuantizedRow& row, const QuantizedSplat& splat, double q, StopRule stop) {
        if (!live) {
            return false;
        }
        QuantizedPixel next = state;
        const NumberSet& set = row.set();
        if (set.q_mask && q > Rounder(set.q)(set.q_limit())) {
            return false;
        }
        row.blend(row.alpha(q), splat.colour, next);
        live = !(next.transmittance < 1e-4);
        if (!live && stop == StopRule::Refuse) {
            return false;
        }
        state = next;
        ++updates;
        return true;
    }
};

std::vector<ProjectedSplat> random_splats(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < count; ++i) {
        splats.push_back(random_splat(random, kX, kY, kTile));
        for (double& channel : splats.back().colour) {
            channel = static_cast<double>(random() % 1000) / 700;
        }
    }
    return splats;
}

struct Case {
    std::string name;
    std::vector<std::string> changes;
    SpanEnds ends;
    StopRule stop;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
    out << c.name;
    for (const std::string& change : c.changes) {
        out << " " << change;
    }
    return out << " " << static_cast<int>(c.ends);
}

class QuantizedPaths : public testing::TestWithParam<Case> {
protected:
    NumberSet set_ = with_ends(number_set(GetParam().name, GetParam().changes), GetParam().ends, 1);
    QuantizedRow row_{set_};
    std::vector<ProjectedSplat> splats_ = random_splats(3, 600);
    std::vector<QuantizedSplat> records_;
    std::unique_ptr<DataPath> path_;

    void SetUp() override {
        DataPathOptions options = options_of(set_);
        options.stop = GetParam().stop;
        path_ = path_of(splats_, options, kTile);
        for (const ProjectedSplat& splat : splats_) {
            records_.push_back(row_.record(splat));
        }
    }
    /// Rounded twice by lanes: differences of a unit are allowed, but rare.
    bool exact() const { return !lanes_can(set_) || GetParam().name != "tuned"; }
    void compare(const std::vector<Pixel>& expected, int y, int& different) const {
        std::vector<PixelValue> pixels(kTile);
        path_->read_row(0, y, kTile, pixels.data());
        for (int x = 0; x < kTile; ++x) {
            const PixelValue& value = pixels[static_cast<std::size_t>(x)];
            const Pixel& pixel = expected[static_cast<std::size_t>(y * kTile + x)];
            const double error = std::abs(value.transmittance - pixel.state.transmittance) +
                                 std::abs(value.rgb[0] - pixel.state.rgb[0]) +
                                 std::abs(value.rgb[2] - pixel.state.rgb[2]);
            ASSERT_LE(error, exact() ? 0 : 1e-3) << x << " " << y;
            if (exact()) {
                ASSERT_EQ(value.updates, pixel.updates);
                ASSERT_EQ(value.ended, !pixel.live);
            }
            different += static_cast<int>(error > 0);
        }
    }
};

TEST_P(QuantizedPaths, SpansAndPixelsAreTheDefinition) {
    std::vector<Pixel> expected(kTile * kTile);
    int spans = 0;
    int off_start = 0;
    for (std::uint32_t i = 0; i < splats_.size(); ++i) {
        for (int y = 0; y < kTile; ++y) {
            RowSpan span;
            const bool covered = path_->solve_row(i, kY + y, kX, kX + kTile, kY, span);
            const QuantizedSpan solved = row_.solve(records_[i], kY + y, kX, kX + kTile);
            ASSERT_EQ(covered, !solved.empty());
            if (!covered) {
                continue;
            }
            ++spans;
            ASSERT_EQ(span.splat, i);
            ASSERT_EQ(span.y, y);
            ASSERT_EQ(kX + span.x0, solved.x0);
            ASSERT_EQ(kX + span.x0 + span.length - 1, solved.x1);
            ASSERT_EQ(kX + span.base, solved.base);
            ASSERT_EQ(span.g0, solved.g0);
            ASSERT_EQ(span.d0, solved.d0);
            off_start += static_cast<int>(span.base != span.x0);
            for (const BlendTask& task : tasks_of(span)) {
                path_->blend(task);
            }
            for (int x = span.x0; x < span.x0 + span.length; ++x) {
                const double q = row_.q(records_[i].a, span.g0, span.d0, x - span.base);
                expected[static_cast<std::size_t>(y * kTile + x)].update(row_, records_[i], q,
                                                                         GetParam().stop);
            }
        }
    }
    EXPECT_GT(spans, 2000);
    EXPECT_EQ(off_start > 0, set_.base == Base::Vertex);
    int different = 0;
    for (int y = 0; y < kTile; ++y) {
        compare(expected, y, different);
    }
    EXPECT_LE(different, kTile * kTile / 3);
}

// The coupled check, too: rows are checked, pixels have their q', and both agree with it.
TEST_P(QuantizedPaths, TestsAreTheDefinition) {
    std::vector<Pixel> expected(kTile * kTile);
    const double limit = Rounder(set_.q)(set_.q_limit());
    int inside = 0;
    for (std::uint32_t i = 0; i < splats_.size(); ++i) {
        for (int y = 0; y < kTile; ++y) {
            PixelTest test;
            test.splat = i;
            test.x = kX;
            test.y = kY + y;
            test.row = static_cast<std::int16_t>(y);
            test.mask = i % 3 == 0 ? ~0U : 0x7FFF03F1U * i;
            const BlendOutcome outcome = path_->test(test);
            const QuantizedCheck check = row_.check(records_[i], kY + y);
            std::uint32_t passes = 0;
            for (int x = 0; x < kTile; ++x) {
                const double q = row_.checked_q(records_[i], check, kX + x);
                const bool row_passes =
                    set_.vertical != Vertical::FromRatio || row_.meets(records_[i], kY + y);
                if ((test.mask >> x & 1U) != 0 && row_passes && q <= limit) {
                    passes |= 1U << x;
                    expected[static_cast<std::size_t>(y * kTile + x)].update(row_, records_[i], q,
                                                                             GetParam().stop);
                }
            }
            ASSERT_EQ(outcome.useful | outcome.terminated, passes);
            ASSERT_EQ(outcome.boundary, test.mask & ~passes);
            inside += __builtin_popcount(passes);
        }
    }
    EXPECT_GT(inside, 20000);
    int different = 0;
    for (int y = 0; y < kTile; ++y) {
        compare(expected, y, different);
    }
    EXPECT_LE(different, kTile * kTile / 3);
}

// No span outside the rows and columns that are named for it, in any tile; and few rows for
// nothing.
TEST_P(QuantizedPaths, ExtentsHoldEverySpan) {
    std::uint64_t named = 0;
    std::uint64_t covered = 0;
    for (std::uint32_t i = 0; i < splats_.size(); ++i) {
        int top = 0;
        int bottom = 0;
        int left = 0;
        int right = 0;
        path_->rows(i, top, bottom);
        path_->columns(i, left, right);
        for (int tile = -3; tile <= 3; ++tile) {
            const int x = kX + tile * kTile + static_cast<int>(i % 7);
            const int width = 1 + static_cast<int>(i % kTile);
            int first = 0;
            int last = 0;
            path_->rows_in_columns(i, x, x + width, first, last);
            ASSERT_GE(first, top);
            ASSERT_LE(last, bottom);
            for (int y = kY - 60; y < kY + 90; ++y) {
                RowSpan span;
                const bool there = path_->solve_row(i, y, x, x + width, kY - 60, span);
                const bool inside = y >= first && y <= last;
                named += static_cast<std::uint64_t>(inside);
                covered += static_cast<std::uint64_t>(there);
                if (there) {
                    ASSERT_TRUE(inside) << "splat " << i << " row " << y << " columns " << x;
                    ASSERT_GE(x + span.x0, left) << i;
                    ASSERT_LE(x + span.x0 + span.length - 1, right) << i;
                }
            }
        }
    }
    EXPECT_GT(covered, 40000U);
    // A half names every other pixel here: x_c is known to a pixel only.
    EXPECT_LT(named, covered * (GetParam().name == "fp16" ? 6 : 5) / 4);
}

INSTANTIATE_TEST_SUITE_P(
    Sets, QuantizedPaths,
    testing::Values(
        Case{"ideal", {}, SpanEnds::Exact, StopRule::Refuse},
        Case{"fp32", {"alpha=fp16"}, SpanEnds::Outward, StopRule::After},
        Case{"fp16", {}, SpanEnds::Outward, StopRule::Refuse},
        Case{"fp16", {}, SpanEnds::Exact, StopRule::After},
        Case{"paper", {}, SpanEnds::Slope, StopRule::Refuse},
        Case{"paper", {}, SpanEnds::Exact, StopRule::After},
        Case{"paper", {"base=vertex", "q_mask=true"}, SpanEnds::Outward, StopRule::Refuse},
        Case{"paper", {"alpha=uq1.15", "sqrt.entries=16"}, SpanEnds::Exact, StopRule::Refuse},
        Case{"tuned", {}, SpanEnds::Exact, StopRule::Refuse},
        Case{"tuned", {}, SpanEnds::Outward, StopRule::After},
        Case{"tuned",
             {"exp.interpolation=exact", "guard=0.25"},
             SpanEnds::Exact,
             StopRule::Refuse}));

// `ideal` by name is the double data path itself.
TEST(NamedNumbers, IdealIsFp64) {
    const std::vector<ProjectedSplat> splats = random_splats(5, 300);
    const auto ideal = path_of(splats, named_numbers("ideal"), kTile);
    const auto fp64 = path_of(splats, named_numbers("fp64"), kTile);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        for (int y = 0; y < kTile; ++y) {
            RowSpan a;
            RowSpan b;
            const bool covered = ideal->solve_row(i, kY + y, kX, kX + kTile, kY, a);
            ASSERT_EQ(covered, fp64->solve_row(i, kY + y, kX, kX + kTile, kY, b));
            for (const BlendTask& task : covered ? tasks_of(a) : std::vector<BlendTask>{}) {
                ideal->blend(task);
            }
            for (const BlendTask& task : covered ? tasks_of(b) : std::vector<BlendTask>{}) {
                fp64->blend(task);
            }
        }
    }
    std::vector<PixelValue> a(kTile);
    std::vector<PixelValue> b(kTile);
    std::uint32_t updates = 0;
    for (int y = 0; y < kTile; ++y) {
        ideal->read_row(0, y, kTile, a.data());
        fp64->read_row(0, y, kTile, b.data());
        for (std::size_t x = 0; x < kTile; ++x) {
            ASSERT_EQ(a[x].transmittance, b[x].transmittance);
            ASSERT_EQ(a[x].rgb[1], b[x].rgb[1]);
            ASSERT_EQ(a[x].updates, b[x].updates);
            updates += a[x].updates;
        }
    }
    EXPECT_GT(updates, 5000U);
}

TEST(NamedNumbers, HaveTheirOwnEnds) {
    EXPECT_EQ(named_numbers("fp32").ends, SpanEnds::Exact);
    EXPECT_EQ(named_numbers("fp16").ends, SpanEnds::Outward);
    EXPECT_EQ(named_numbers("paper").ends, SpanEnds::Slope);
    EXPECT_EQ(named_numbers("tuned").ends, SpanEnds::Exact);
    EXPECT_THROW(named_numbers("fp8"), InputError);
}

class HostilePaths : public testing::TestWithParam<std::string> {};

// Splats that no format holds: everything stays inside the tile and finite, and bounds are bounds.
TEST_P(HostilePaths, StayFinite) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < 600; ++i) {
        const double far = std::pow(10.0, 12 * unit(random));
        const double minor = std::sqrt(0.3) * std::exp(12 * unit(random));
        splats.push_back(make_splat(kX + far * (unit(random) - 0.5),
                                    kY + far * (unit(random) - 0.5),
                                    minor * std::exp(9 * unit(random)), minor, 6.3 * unit(random),
                                    1.0 / 255 + (1 - 1.0 / 255) * unit(random)));
        splats.back().q_threshold = i % 9 == 0 ? 0 : splats.back().q_threshold;
        splats.back().colour[0] = i % 11 == 0 ? 1e30 : 0.5;
    }
    splats.push_back(make_splat(1e300, -1e300, 1e150, 1, 0.5, 1));
    for (const SpanEnds ends : {SpanEnds::Exact, SpanEnds::Outward, SpanEnds::Slope}) {
        const auto path =
            path_of(splats, options_of(with_ends(number_set(GetParam()), ends)), kTile);
        for (std::uint32_t i = 0; i < splats.size(); ++i) {
            int top = 0;
            int bottom = 0;
            int left = 0;
            int right = 0;
            path->rows_in_columns(i, kX, kX + kTile, top, bottom);
            path->columns(i, left, right);
            for (int y = kY; y < kY + kTile; ++y) {
                RowSpan span;
                if (path->solve_row(i, y, kX, kX + kTile, kY, span)) {
                    ASSERT_TRUE(y >= top && y <= bottom) << i;
                    ASSERT_GE(span.x0, 0);
                    ASSERT_GE(span.length, 1);
                    ASSERT_LE(span.x0 + span.length, kTile);
                    ASSERT_LE(left, kX + span.x0);
                    ASSERT_GE(right, kX + span.x0 + span.length - 1);
                    for (const BlendTask& task : tasks_of(span)) {
                        path->blend(task);
                    }
                }
                int first = 0;
                int last = 0;
                if (path->tested_columns(i, y, kX, kX + kTile, first, last)) {
                    ASSERT_TRUE(kX <= first && first <= last && last < kX + kTile);
                }
            }
        }
        std::vector<PixelValue> pixels(kTile);
        for (int y = 0; y < kTile; ++y) {
            path->read_row(0, y, kTile, pixels.data());
            for (const PixelValue& pixel : pixels) {
                ASSERT_TRUE(pixel.transmittance >= 0 && pixel.transmittance <= 1);
                ASSERT_TRUE(std::isfinite(pixel.rgb[1]));
            }
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Sets, HostilePaths, testing::ValuesIn(number_set_names()));

} // namespace
} // namespace degs
