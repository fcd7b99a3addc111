// SPDX-License-Identifier: Apache-2.0
// The tables of data paths while frames come and go.
#include <tuple>

#include "splat/frame/pixel_mask.hpp"
#include "splat/pixels/quantized_gemm.hpp"
#include "splat/pixels/splat_places.hpp"
#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using test::frame_of;
using test::random_splat;

TEST(DataPathPlaces, AFrameTakesTheLowestGapThatHoldsIt) {
    SplatPlaces places;
    EXPECT_EQ(places.take(5), 0U);
    EXPECT_EQ(places.take(3), 5U);
    EXPECT_EQ(places.take(4), 8U);
    EXPECT_EQ(places.size(), 12U);
    places.release(0, 5);
    EXPECT_EQ(places.take(6), 12U);
    EXPECT_EQ(places.take(2), 0U);
    EXPECT_EQ(places.take(3), 2U);
    places.release(5, 3);
    places.release(8, 4);
    EXPECT_EQ(places.take(7), 5U); // gaps that meet are one
    EXPECT_EQ(places.size(), 18U);
}

TEST(DataPathPlaces, FramesWithoutSplatsTakeNone) {
    SplatPlaces places;
    places.take(0);
    EXPECT_EQ(places.take(2), 0U);
    const std::uint32_t none = places.take(0);
    places.release(none, 0);
    EXPECT_EQ(places.take(2), 2U); // the first two are still there
    places.release(0, 2);
    places.release(2, 2);
    EXPECT_EQ(places.take(4), 0U);
    EXPECT_EQ(places.size(), 4U);
}

TEST(DataPathPlaces, AreBoundedByTheFramesThatAreThere) {
    std::mt19937 random(5);
    SplatPlaces places;
    std::uint32_t last = 0;
    std::size_t last_count = 0;
    for (int frame = 0; frame < 10000; ++frame) {
        const std::size_t count = random() % 100;
        const std::uint32_t first = places.take(count);
        EXPECT_TRUE(count == 0 || last_count == 0 || first >= last + last_count ||
                    first + count <= last);
        places.release(last, last_count);
        last = first;
        last_count = count;
    }
    EXPECT_LT(places.size(), 300U);
}

std::vector<ProjectedSplat> splats_of(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < count; ++i) {
        splats.push_back(random_splat(random, 0, 0, 32));
    }
    return splats;
}

/// Every pixel of a tile of 32 x 32 px after all splats of a frame.
std::vector<PixelValue> drawn(DataPath& path, std::uint32_t first, int count, bool tests) {
    std::vector<PixelValue> pixels(32 * 32);
    for (int row = 0; row < 32; ++row) {
        path.begin_row(0, row);
        for (int i = 0; i < count; ++i) {
            const std::uint32_t splat = first + static_cast<std::uint32_t>(i);
            TileRows rows;
            rows.splat = splat;
            rows.x_end = 32;
            rows.first = rows.last = row;
            rows.tests = tests;
            RowOutcome unused;
            path.rasterise_rows(rows, &unused);
        }
        path.read_row(0, row, 32, &pixels[static_cast<std::size_t>(32 * row)]);
    }
    return pixels;
}

void expect_same(const std::vector<PixelValue>& one, const std::vector<PixelValue>& two) {
    for (std::size_t i = 0; i < one.size(); ++i) {
        ASSERT_EQ(std::make_tuple(one[i].rgb[0], one[i].rgb[1], one[i].rgb[2], one[i].transmittance,
                                  one[i].updates, one[i].ended),
                  std::make_tuple(two[i].rgb[0], two[i].rgb[1], two[i].rgb[2], two[i].transmittance,
                                  two[i].updates, two[i].ended))
            << "pixel " << i;
    }
}

class DataPathFrames : public ::testing::TestWithParam<std::tuple<const char*, bool /*products*/>> {
};

TEST_P(DataPathFrames, AreDrawnRightInThePlacesOfOthers) {
    DataPathOptions options = named_numbers(std::get<0>(GetParam()));
    const bool products = std::get<1>(GetParam());
    if (products) {
        options.gemm = half_precision_gemm(GemmOrigin::Tile);
    }
    const auto path = make_data_path(options, 32, 1);
    std::uint32_t first = path->add_frame(frame_of(splats_of(1, 20)));
    int count = 20;
    std::uint32_t highest = 0;
    for (unsigned seed = 2; seed < 12; ++seed) {
        const int next_count = seed % 3 == 0 ? 40 : 10 + static_cast<int>(seed);
        const auto splats = splats_of(seed, next_count);
        const std::uint32_t next = path->add_frame(frame_of(splats));
        const auto alone = make_data_path(options, 32, 1);
        alone->add_frame(frame_of(splats));
        for (const bool tests : {false, true}) {
            if (tests || !products) {
                expect_same(drawn(*path, next, next_count, tests),
                            drawn(*alone, 0, next_count, tests));
            }
        }
        path->remove_frame(first, static_cast<std::size_t>(count));
        first = next;
        count = next_count;
        highest = std::max(highest, next);
    }
    EXPECT_LT(highest, 80U); // of 230 splats
}

INSTANTIATE_TEST_SUITE_P(Numbers, DataPathFrames,
                         ::testing::Combine(::testing::Values("fp32", "fp64", "fp16", "paper",
                                                              "tuned"),
                                            ::testing::Bool()),
                         [](const auto& numbers) {
                             return std::string(std::get<0>(numbers.param)) +
                                    (std::get<1>(numbers.param) ? "_products" : "");
                         });

} // namespace
} // namespace degs
