// SPDX-License-Identifier: Apache-2.0
// What a data path keeps: opacity in the start value, pixels per context, splats per frame.
#include "tests/splat/pixels/data_path_fixture.hpp"

namespace degs {
namespace {

using test::begin_tile;
using test::frame_of;
using test::make_splat;
using test::path_of;
using test::path_options;

// The PE evaluates exp(-q'/2) alone; o is in g0.
TEST(DataPath, OpacityIsFoldedIntoTheStartValue) {
    for (const double opacity : {1.0 / 255 + 1e-6, 0.1, 0.5, 0.985}) {
        const ProjectedSplat s = make_splat(8, 8, 4, 4, 0, opacity);
        const auto path = path_of({s}, path_options(Arithmetic::Fp64));
        const auto span = path->solve_row(0, 8, 0, 64, 0);
        ASSERT_TRUE(span);
        BlendTask task;
        task.g0 = span->g0;
        task.d0 = span->d0;
        task.row = 8;
        task.mask = 0xFFFFFFFFU;
        task.offset = static_cast<std::int16_t>(-span->x0);
        path->blend(task);
        std::vector<PixelValue> row(32);
        path->read_row(0, 8, 32, row.data());
        for (int x = 0; x < 32; ++x) {
            const double alpha = opacity * std::exp(-0.5 * (x - 8) * (x - 8) / 16.0);
            EXPECT_NEAR(row[static_cast<std::size_t>(x)].transmittance, 1 - alpha, 1e-14);
        }
    }
}

TEST(DataPath, ContextsAreSeparateAndBeginRowClearsOne) {
    const auto path =
        path_of({make_splat(8, 8, 400, 400, 0, 0.5)}, path_options(Arithmetic::Fp32), 48, 3);
    BlendTask task;
    task.mask = 0xFFFFU;
    std::vector<PixelValue> row(48);
    for (const int context : {0, 1, 2}) {
        task.context = static_cast<std::int16_t>(context);
        task.row = static_cast<std::int16_t>(context == 2 ? 47 : 0);
        task.column = 32;
        path->blend(task);
    }
    begin_tile(*path, 1, 48);
    for (const int context : {0, 1, 2}) {
        path->read_row(context, context == 2 ? 47 : 0, 48, row.data());
        for (int x = 0; x < 48; ++x) {
            const bool drawn = context != 1 && x >= 32;
            const PixelValue& pixel = row[static_cast<std::size_t>(x)];
            EXPECT_EQ(pixel.updates, drawn ? 1U : 0U);
            EXPECT_EQ(pixel.transmittance < 1, drawn);
        }
    }
}

// Frames are numbered on: splat 0 of the second frame follows the last one of the first.
TEST(DataPath, FramesFollowEachOther) {
    const auto path = path_of({make_splat(8, 8, 2, 2, 0, 1), make_splat(9, 9, 2, 2, 0, 1)},
                              path_options(Arithmetic::Fp32));
    EXPECT_EQ(path->add_frame(frame_of({make_splat(50, 50, 1, 1, 0, 1)})), 2U);
    EXPECT_TRUE(path->solve_row(2, 50, 0, 64, 0));
    EXPECT_FALSE(path->solve_row(1, 50, 0, 64, 0));
}

} // namespace
} // namespace degs
