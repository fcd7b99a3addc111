// SPDX-License-Identifier: Apache-2.0
// Where splat records lie in memory, and that nothing but addresses depends on it.
#include "modules/kit/job/record_places.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "degs/error.hpp"
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::DegsRun;

TEST(RecordPlaces, MortonCodesInterleaveTheAxes) {
    // The corners of a cube, last bit first: x counts 1, y 2, z 4.
    const std::vector<glm::vec3> corners{{1, 1, 1}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0},
                                         {0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
    EXPECT_EQ(morton_ranks(corners), (std::vector<std::uint32_t>{7, 4, 1, 2, 0, 3, 6, 5}));
    // A cell of the near half comes before every cell of the far half, whatever its other bits.
    EXPECT_EQ(morton_ranks({{0, 0, 8}, {7, 7, 1}, {0, 0, 0}}),
              (std::vector<std::uint32_t>{2, 1, 0}));
}

TEST(RecordPlaces, EqualPositionsKeepTheirOrder) {
    EXPECT_EQ(morton_ranks({{2, 2, 2}, {2, 2, 2}, {2, 2, 2}}),
              (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(morton_ranks({}).empty());
}

TEST(RecordPlaces, EverySplatHasAPlaceOfItsOwn) {
    const FrameWorkload frame = test::random_frame(3, 90, 60, 16, 200);
    for (const RecordOrder order : {RecordOrder::Index, RecordOrder::Morton}) {
        const RecordPlaces places(frame, order);
        std::vector<std::uint32_t> all(places.of_splats(),
                                       places.of_splats() + frame.splats.size());
        std::sort(all.begin(), all.end());
        std::vector<std::uint32_t> expected(frame.splats.size());
        std::iota(expected.begin(), expected.end(), 0U);
        EXPECT_EQ(all, expected);
        EXPECT_EQ(places.of_visible() == nullptr, order == RecordOrder::Index);
    }
    const RecordPlaces index(frame, RecordOrder::Index);
    const RecordPlaces morton(frame, RecordOrder::Morton);
    for (std::size_t s = 0; s < frame.splats.size(); ++s) {
        const auto rank = static_cast<std::size_t>(
            std::find(frame.visible_of.begin(), frame.visible_of.end(), frame.splats[s].id) -
            frame.visible_of.begin());
        EXPECT_EQ(index.of_splats()[s], rank);
        EXPECT_EQ(morton.of_splats()[s], morton.of_visible()[rank]);
    }
}

// On a bus the order is nothing at all; on LPDDR5 it moves rows and dates, but no byte and no
// pixel.
TEST(RecordPlaces, OnlyAddressesFollowTheOrder) {
    const FrameWorkload frame = test::random_frame(5, 200, 120, 16, 3000);
    std::vector<std::unique_ptr<DegsRun>> runs;
    for (const MemoryModel model : {MemoryModel::Bus, MemoryModel::Lpddr5}) {
        for (const RecordOrder order : {RecordOrder::Index, RecordOrder::Morton}) {
            DegsConfig config;
            config.memory.model = model;
            config.memory.layout = order;
            runs.push_back(std::make_unique<DegsRun>("run" + std::to_string(runs.size()), config,
                                                     std::vector<const FrameWorkload*>{&frame}));
        }
    }
    sc_core::sc_start();
    const auto bytes = [](const AcceleratorResult& result) {
        std::vector<std::uint64_t> all;
        for (const StreamUse& stream : result.streams) {
            all.insert(all.end(), {stream.bytes_read, stream.bytes_written, stream.requests});
        }
        return all;
    };
    for (const auto& run : runs) {
        EXPECT_TRUE(test::same_bytes(run->image(), runs[0]->image()));
        test::expect_laws(run->result(), 64);
    }
    EXPECT_EQ(runs[0]->result().cycles, runs[1]->result().cycles);
    EXPECT_EQ(bytes(runs[0]->result()), bytes(runs[1]->result()));
    EXPECT_EQ(bytes(runs[2]->result()), bytes(runs[3]->result()));
    EXPECT_NE(runs[2]->result().dram_activity->all.accesses,
              runs[3]->result().dram_activity->all.accesses);
}

// Entries of 4 B with keys of 16 bits hold indices below 65 536.
TEST(MemoryMaps, RefuseIndicesThatEntriesDoNotHold) {
    FrameWorkload frame;
    frame.projection.numbers.depth_key = parse_format("ue4m12b3");
    TrafficConfig traffic;
    traffic.list_entry_bytes = 4;
    frame.splats.resize(65535);
    EXPECT_NO_THROW(MemoryMap(traffic, frame));
    frame.splats.resize(65536);
    EXPECT_NO_THROW(MemoryMap(traffic, frame));
    frame.splats.resize(65537);
    try {
        const MemoryMap map(traffic, frame);
        ADD_FAILURE() << map.lists;
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "A frame has 65537 visible splats, but list entries of 4 B with depth keys "
                     "ue4m12b3 leave 16 bits for the index; raise traffic.list_entry_bytes.");
    }
    frame.projection.numbers = {};
    EXPECT_NO_THROW(MemoryMap(traffic, frame)); // as entries of any size with fp32 keys
}

} // namespace
} // namespace degs
