// SPDX-License-Identifier: Apache-2.0
// The data path of a number set is QuantizedRow, span by span and pixel by pixel.
#include "splat/pixels/quantized_data_path.hpp"

#include <cstring>

#include "splat/pixels/quantized_lanes.hpp"
#include "tests/splat/pixels/quantized_fixture.hpp"

namespace degs {
namespace {

using test::kTile;
using test::kX;
using test::kY;
using test::path_of;
using test::random_splats;
using test::tasks_of;
using test::with_ends;

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
        if (set.q_mask && q > splat.q_inside) {
            return false;
        }
        row.blend(row.alpha(splat, q), splat.colour, next);
        live = !(next.transmittance < 1e-4);
        if (!live && stop == StopRule::Refuse) {
            return false;
        }
        state = next;
        ++updates;
        return true;
    }
};

struct PathCase {
    std::string name;
    std::vector<std::string> changes;
    SpanEnds ends;
    StopRule stop;
};

std::ostream& operator<<(std::ostream& out, const PathCase& c) {
    out << c.name;
    for (const std::string& change : c.changes) {
        out << " " << change;
    }
    return out << " " << static_cast<int>(c.ends);
}

class QuantizedPaths : public testing::TestWithParam<PathCase> {
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
            const auto span = path_->solve_row(i, kY + y, kX, kX + kTile, kY);
            const QuantizedSpan solved = row_.solve(records_[i], kY + y, kX, kX + kTile);
            ASSERT_EQ(span.has_value(), !solved.empty());
            if (!span) {
                continue;
            }
            ++spans;
            ASSERT_EQ(span->splat, i);
            ASSERT_EQ(span->y, y);
            ASSERT_EQ(kX + span->x0, solved.x0);
            ASSERT_EQ(kX + span->x0 + span->length - 1, solved.x1);
            ASSERT_EQ(kX + span->base, solved.base);
            ASSERT_EQ(span->g0, solved.g0);
            ASSERT_EQ(span->d0, solved.d0);
            off_start += static_cast<int>(span->base != span->x0);
            for (const BlendTask& task : tasks_of(*span)) {
                path_->blend(task);
            }
            for (int x = span->x0; x < span->x0 + span->length; ++x) {
                const double q = row_.q(records_[i].a, span->g0, span->d0, x - span->base);
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
                if ((test.mask >> x & 1U) != 0 && row_passes && q <= records_[i].q_inside) {
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
        const PixelRange all_rows = path_->rows(i);
        const PixelRange columns = path_->columns(i);
        for (int tile = -3; tile <= 3; ++tile) {
            const int x = kX + tile * kTile + static_cast<int>(i % 7);
            const int width = 1 + static_cast<int>(i % kTile);
            const PixelRange rows = path_->rows_in_columns(i, x, x + width);
            ASSERT_GE(rows.first, all_rows.first);
            ASSERT_LE(rows.last, all_rows.last);
            for (int y = kY - 60; y < kY + 90; ++y) {
                const auto span = path_->solve_row(i, y, x, x + width, kY - 60);
                named += rows.holds(y) ? 1 : 0;
                if (span) {
                    ++covered;
                    ASSERT_TRUE(rows.holds(y)) << "splat " << i << " row " << y << " columns " << x;
                    ASSERT_TRUE(columns.holds(x + span->x0)) << i;
                    ASSERT_TRUE(columns.holds(x + span->x0 + span->length - 1)) << i;
                }
            }
        }
    }
    EXPECT_GT(covered, 35000U);
    // A half names every other pixel here: x_c is known to a pixel only.
    EXPECT_LT(named, covered * (GetParam().name == "fp16" ? 7 : 5) / 4);
}

INSTANTIATE_TEST_SUITE_P(
    Sets, QuantizedPaths,
    testing::Values(
        PathCase{"ideal", {}, SpanEnds::Exact, StopRule::Refuse},
        PathCase{"fp32", {"alpha=fp16"}, SpanEnds::Outward, StopRule::After},
        PathCase{"fp16", {}, SpanEnds::Outward, StopRule::Refuse},
        PathCase{"fp16", {}, SpanEnds::Exact, StopRule::After},
        PathCase{"paper", {}, SpanEnds::Slope, StopRule::Refuse},
        PathCase{"paper", {}, SpanEnds::Exact, StopRule::After},
        PathCase{"paper", {"span_base=vertex", "q_mask=true"}, SpanEnds::Outward, StopRule::Refuse},
        PathCase{"paper", {"alpha=uq1.15", "sqrt.entries=16"}, SpanEnds::Exact, StopRule::Refuse},
        PathCase{"tuned", {}, SpanEnds::Exact, StopRule::Refuse},
        PathCase{"tuned", {}, SpanEnds::Outward, StopRule::After},
        PathCase{"tuned",
                 {"exp.interpolation=exact", "guard=0.25"},
                 SpanEnds::Exact,
                 StopRule::Refuse}));

} // namespace
} // namespace degs
