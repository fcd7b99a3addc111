// SPDX-License-Identifier: Apache-2.0
// Sizes of the records that memory moves, and the energy of moving them, by hand.
#include "modules/kit/job/traffic.hpp"

#include <gtest/gtest.h>

#include "modules/kit/accelerator/accelerator_energy.hpp"
#include "tests/modules/degs/workload_fixture.hpp"

namespace degs {
namespace {

// (degree + 1)^2 coefficients of three channels.
TEST(TrafficConfig, ShOfADegree) {
    TrafficConfig traffic;
    const int coefficients[] = {1, 4, 9, 16};
    for (int degree = 0; degree <= 3; ++degree) {
        EXPECT_EQ(traffic.sh_size(degree), 3 * 2 * coefficients[degree]) << degree; // FP16
    }
    traffic.set_formats({}); // single precision
    for (int degree = 0; degree <= 3; ++degree) {
        EXPECT_EQ(traffic.sh_size(degree), 3 * 4 * coefficients[degree]) << degree;
    }
    traffic.sh_value_bytes = 1;
    EXPECT_EQ(traffic.sh_size(3), 3 * 16);
}

// A second view has records, lists, their heads and pixels of its own, and the scene of the first.
TEST(MemoryMap, ViewsShareTheSceneAndNothingElse) {
    const FrameWorkload frame = test::make_frame({test::blanket(16, 16, 32)}, 32, 32, 16);
    const TrafficConfig traffic;
    const MemoryMap first(traffic, frame);
    MemoryMap second = first;
    second.move_behind(traffic, frame);
    EXPECT_EQ(second.geometry, first.geometry);
    EXPECT_EQ(second.sh, first.sh);
    // One record, four entries and four heads in a page each, and one of 32 x 32 pixels of 4 B.
    EXPECT_EQ(first.frame_buffer - first.splats, 3U * 4096);
    EXPECT_EQ(second.splats, first.frame_buffer + 4096);
    EXPECT_EQ(second.lists - first.lists, 4U * 4096);
    EXPECT_EQ(second.list_heads - first.list_heads, 4U * 4096);
    EXPECT_EQ(second.frame_buffer - first.frame_buffer, 4U * 4096);
}

// 1 kB read at 3 pJ and 10 kB written at 5 pJ per bit; 2 mW for each of 100 GB/s in 1 ms.
TEST(BusEnergy, ReadsWritesAndStandby) {
    cost::Technology::Dram dram;
    dram.pj_per_bit = 3;
    dram.write_pj_per_bit = 5;
    dram.standby_mw_per_gb_per_s = 2;
    EXPECT_NEAR(bus_nj(dram, 1000, 0, 100, 0), 24, 1e-9);
    EXPECT_NEAR(bus_nj(dram, 0, 10000, 100, 0), 400, 1e-9);
    EXPECT_NEAR(bus_nj(dram, 1000, 10000, 100, 1e-3), 24 + 400 + 200e3, 1e-6);
}

} // namespace
} // namespace degs
