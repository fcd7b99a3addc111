// SPDX-License-Identifier: Apache-2.0
// Numbers by name, and splats that no format holds.
#include <cmath>

#include "config/config_document.hpp"
#include "degs/error.hpp"
#include "tests/splat/pixels/quantized_fixture.hpp"

namespace degs {
namespace {

using test::kTile;
using test::kX;
using test::kY;
using test::make_splat;
using test::path_of;
using test::random_splats;
using test::tasks_of;
using test::with_ends;

// `ideal` by name is the double data path itself.
TEST(NamedNumbers, IdealIsFp64) {
    const std::vector<ProjectedSplat> splats = random_splats(5, 300);
    const auto ideal = path_of(splats, named_numbers("ideal"), kTile);
    const auto fp64 = path_of(splats, named_numbers("fp64"), kTile);
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        for (int y = 0; y < kTile; ++y) {
            const auto a = ideal->solve_row(i, kY + y, kX, kX + kTile, kY);
            const auto b = fp64->solve_row(i, kY + y, kX, kX + kTile, kY);
            ASSERT_EQ(a.has_value(), b.has_value());
            for (const BlendTask& task : a ? tasks_of(*a) : std::vector<BlendTask>{}) {
                ideal->blend(task);
            }
            for (const BlendTask& task : b ? tasks_of(*b) : std::vector<BlendTask>{}) {
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

void expect_refused(const std::vector<std::string>& assignments, const std::string& sentence) {
    try {
        number_set("tuned", assignments);
        ADD_FAILURE() << sentence;
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).substr(0, sentence.size()), sentence);
    }
}

TEST(NamedNumbers, PartsGoByName) {
    const NumberSet set = number_set("tuned", {"alpha=uq0.12", "exponent=natural", "q=uq4.12"});
    EXPECT_EQ(set.name, "tuned alpha=uq0.12 exponent=natural q=uq4.12");
    EXPECT_EQ(set.alpha, parse_format("uq0.12"));
    EXPECT_EQ(set.exp.function, TableFunction::ExpHalf); // what the exponent asks for
    EXPECT_EQ(set.q, parse_format("uq4.12"));
    for (const KeyDoc& key : document(set)) {
        EXPECT_FALSE(key.doc.empty()) << key.path;
        if (key.type != "section") {
            expect_refused({key.path + "=?"}, "--numbers " + key.path + "=?: key '" + key.path +
                                                  "' is '?', but must be ");
        }
    }
}

TEST(NamedNumbers, MistakesAreNamed) {
    expect_refused({"colour"}, "--numbers 'colour': this is not an override");
    expect_refused({"color=fp16"}, "--numbers color=fp16: key 'color' is unknown, did you mean "
                                   "'colour'? (allowed at the top: projection, mean, slope, ");
    expect_refused({"projection=ue8m20"}, "--numbers projection=ue8m20: key 'projection' is "
                                          "'ue8m20', but must have a sign; e8m20 would do.");
    expect_refused({"d0=ue4m12"},
                   "--numbers d0=ue4m12: key 'd0' is 'ue4m12', but must have a sign");
    expect_refused({"ratio=uq0.18"}, "--numbers ratio=uq0.18: key 'ratio' is 'uq0.18', but must "
                                     "reach beyond 1, where a row misses the ellipse; fp16");
    expect_refused({"exponent=natural"},
                   "--numbers exponent=natural: key 'q' is 'uq3.13' by default, but must reach "
                   "beyond 11.08");
    expect_refused({"sqrt.entries=0"}, "--numbers sqrt.entries=0: key 'sqrt.entries' is 0, but "
                                       "must be at least 1 where there is a table.");
}

// fp32 and fp64 keep the machine's own operations if splats alone come from elsewhere.
TEST(NamedNumbers, ProjectionIsNoPartOfTheDataPath) {
    for (const char* name : {"fp32", "fp64", "ideal"}) {
        EXPECT_EQ(named_numbers(name).projection.format, parse_format("fp64"));
    }
    for (const char* name : {"fp16", "paper", "tuned"}) {
        EXPECT_EQ(named_numbers(name).projection.format, parse_format("fp32"));
    }
    const DataPathOptions native = named_numbers("fp32", {"projection=bf16"});
    EXPECT_EQ(native.projection.format, parse_format("bf16"));
    EXPECT_FALSE(native.set);
    const DataPathOptions changed = named_numbers("fp64", {"projection=fp32", "alpha=uq0.12"});
    EXPECT_EQ(changed.projection.format, parse_format("fp32"));
    ASSERT_TRUE(changed.set);
    EXPECT_EQ(changed.set->alpha, parse_format("uq0.12"));
    EXPECT_THROW(named_numbers("tuned", {"projection=ue8m20"}), InputError);
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
            const PixelRange rows = path->rows_in_columns(i, kX, kX + kTile);
            const PixelRange columns = path->columns(i);
            for (int y = kY; y < kY + kTile; ++y) {
                if (const auto span = path->solve_row(i, y, kX, kX + kTile, kY)) {
                    ASSERT_TRUE(rows.holds(y)) << i;
                    ASSERT_GE(span->x0, 0);
                    ASSERT_GE(span->length, 1);
                    ASSERT_LE(span->x0 + span->length, kTile);
                    ASSERT_TRUE(columns.holds(kX + span->x0));
                    ASSERT_TRUE(columns.holds(kX + span->x0 + span->length - 1));
                    for (const BlendTask& task : tasks_of(*span)) {
                        path->blend(task);
                    }
                }
                const PixelRange tested = path->tested_columns(i, y, kX, kX + kTile);
                ASSERT_TRUE(tested.empty() || (kX <= tested.first && tested.last < kX + kTile));
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
