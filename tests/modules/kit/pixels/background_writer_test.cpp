// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/pixels/background_writer.hpp"

#include "tests/modules/kit/job/unit_bench.hpp"

namespace degs {
namespace {

/// Runs a writer on a frame of 48 x 32 px that has these splats; the accesses and bytes that it
/// writes.
std::pair<std::uint64_t, std::uint64_t> written(std::vector<ProjectedSplat> splats) {
    test::UnitBench bench(test::make_frame(std::move(splats), 48, 32, 16));
    BackgroundWriter unit("unit", {}, bench.time, bench.job, 1, false, false);
    DatedFifo<std::uint32_t> listed("listed", bench.time, 1);
    unit.listed[0].bind(listed);
    bench.connect({&unit.frame_buffer});
    bench.script([&](Process& self) {
        listed.connect_writer(self);
        listed.put(self, 0);
    });
    sc_core::sc_start();
    return {bench.memory->total().writes, bench.memory->total().bytes_written};
}

// Rows as wide as the image lie behind each other: an access for each row of tiles.
TEST(BackgroundWriter, WholeRowsOfTilesAreOneAccess) {
    EXPECT_EQ(written({}), std::pair(std::uint64_t{2}, std::uint64_t{48 * 32 * 4}));
}

// The middle tile of the upper row has a splat: 16 rows of a tile on each of its sides.
TEST(BackgroundWriter, PartsOfRowsAreAnAccessEach) {
    EXPECT_EQ(written({test::one_pixel(20, 3)}),
              std::pair(std::uint64_t{16 + 16 + 1}, std::uint64_t{5 * 16 * 16 * 4}));
}

} // namespace
} // namespace degs
