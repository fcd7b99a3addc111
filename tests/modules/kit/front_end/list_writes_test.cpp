// SPDX-License-Identifier: Apache-2.0
// Where entries of tile lists are written, against a naive simulation of the lists, and what of
// them is new in a frame.
#include "modules/kit/front_end/list_writes.hpp"

#include <map>
#include <set>

#include "modules/kit/front_end/list_changes.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

FrameWorkload frame_of(unsigned seed, int splats = 300) {
    return make_frame_workload(test::random_cloud(splats, seed), test::make_camera(160, 96, 110),
                               16, TileMode::Exact);
}

/// (Gaussian, tile) in the order in which projection makes entries.
std::vector<std::pair<std::uint32_t, std::uint32_t>> entries_of(const FrameWorkload& frame) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> entries;
    for (int tile = 0; tile < frame.tiles(); ++tile) {
        for (std::uint64_t i = frame.tile_begin[tile]; i < frame.tile_begin[tile + 1]; ++i) {
            entries.emplace(frame.splats[frame.tile_splats[i]].id, tile);
        }
    }
    return {entries.begin(), entries.end()};
}

class Writings : public ::testing::TestWithParam<int> {};

// Each group covers the bursts from the end of its list to the new end; entries of a buffer are one
// group per tile, or a group each.
TEST_P(Writings, GroupsGoToTheEndsOfTheirLists) {
    const int room = GetParam(); // 0: each entry by itself
    const FrameWorkload frame = frame_of(3);
    const TrafficConfig traffic;
    ListWrites writes(traffic, room == 0 ? ListWriting::Entries : ListWriting::Combined);
    writes.begin(frame, std::vector<bool>(frame.tile_pairs(), true));
    const auto entries = entries_of(frame);
    ASSERT_EQ(writes.entries(), entries.size());
    ASSERT_GT(entries.size(), 500U);
    std::map<std::uint32_t, std::uint64_t> end;
    for (std::size_t done = 0; done < entries.size();) {
        const std::size_t count =
            std::min<std::size_t>(room == 0 ? 5 : room, entries.size() - done);
        std::vector<std::uint32_t> order;
        std::map<std::uint32_t, std::uint64_t> grouped;
        for (std::size_t i = done; i < done + count; ++i) {
            const std::uint32_t tile = entries[i].second;
            if (room == 0 || grouped[tile]++ == 0) {
                order.push_back(tile);
            }
        }
        std::vector<std::uint32_t> bursts;
        for (const std::uint32_t tile : order) {
            const std::uint64_t from = frame.tile_begin[tile] + end[tile];
            end[tile] += room == 0 ? 1 : grouped[tile];
            const std::uint64_t to = frame.tile_begin[tile] + end[tile];
            for (std::uint64_t burst = from * 8 / 64; burst * 64 < to * 8; ++burst) {
                bursts.push_back(static_cast<std::uint32_t>(burst));
            }
        }
        const ListWrites::Batch& batch = writes.next(count);
        EXPECT_EQ(batch.tiles, order);
        EXPECT_EQ(batch.bursts, bursts);
        done += count;
    }
    for (int tile = 0; tile < frame.tiles(); ++tile) {
        EXPECT_EQ(end[tile], frame.tile_begin[tile + 1] - frame.tile_begin[tile]) << tile;
    }
}

INSTANTIATE_TEST_SUITE_P(Rooms, Writings, ::testing::Values(0, 1, 7, 64, 100000));

TEST(ListWrites, ALargerBufferWritesNoMoreBursts) {
    const FrameWorkload frame = frame_of(4);
    std::uint64_t before = ~0U;
    for (const std::uint64_t room : {1U, 8U, 64U, 512U, 4096U}) {
        ListWrites writes({}, ListWriting::Combined);
        writes.begin(frame, std::vector<bool>(frame.tile_pairs(), true));
        std::uint64_t bursts = 0;
        for (std::uint64_t done = 0; done < writes.entries(); done += room) {
            bursts += writes.next(std::min(room, writes.entries() - done)).bursts.size();
        }
        EXPECT_LE(bursts, before);
        before = bursts;
    }
    EXPECT_LT(before, frame.tile_pairs()); // where entries share bursts at last
}

TEST(ListChanges, CountWhatATileDidNotListBefore) {
    GaussianCloud cloud = test::random_cloud(300, 6);
    const Camera camera = test::make_camera(160, 96, 110);
    const FrameWorkload first = make_frame_workload(cloud, camera, 16, TileMode::Exact);
    for (std::size_t i = 0; i < cloud.size(); i += 10) {
        cloud.means[i].x += 0.5;
    }
    const FrameWorkload second = make_frame_workload(cloud, camera, 16, TileMode::Exact);
    const RenderJob job = make_render_job({&first, &second, &second}, {}, 4);
    ListChanges kept(job, true), all(job, false);

    const auto before = entries_of(first);
    const std::set<std::pair<std::uint32_t, std::uint32_t>> old(before.begin(), before.end());
    std::uint64_t fresh = 0;
    for (const auto& entry : entries_of(second)) {
        fresh += old.count(entry) == 0 ? 1 : 0;
    }
    ASSERT_GT(fresh, 0U);
    ASSERT_LT(fresh, second.tile_pairs() / 2);
    std::vector<std::uint64_t> written(3, 0), entries(3, 0);
    for (std::size_t t = 0; t < job.tiles.size(); ++t) {
        written[job.tiles[t].frame] += kept.written(job.tiles[t]);
        entries[job.tiles[t].frame] += all.written(job.tiles[t]);
    }
    EXPECT_EQ(written, (std::vector<std::uint64_t>{first.tile_pairs(), fresh, 0}));
    EXPECT_EQ(entries, (std::vector<std::uint64_t>{first.tile_pairs(), second.tile_pairs(),
                                                   second.tile_pairs()}));
}

// Lists stay in memory for the next frame, unless it has another workspace or follows a reset.
TEST(ListChanges, KeepNothingOfAnotherWorkspaceOrFromBeforeAReset) {
    const FrameWorkload frame = frame_of(6);
    const auto written = [&frame](const auto& change) {
        RenderJob job = make_render_job({&frame, &frame}, {}, 4);
        change(job);
        ListChanges changes(job, true);
        std::uint64_t entries = 0;
        for (std::size_t t = 0; t < job.tiles.size(); ++t) {
            entries += job.tiles[t].frame == 1 ? changes.written(job.tiles[t]) : 0;
        }
        return entries;
    };
    EXPECT_EQ(written([](RenderJob&) {}), 0U);
    EXPECT_EQ(written([](RenderJob& job) { job.bases[1].workspace = 4096; }), frame.tile_pairs());
    EXPECT_EQ(written([](RenderJob& job) { job.first_since_reset = 1; }), frame.tile_pairs());
}

} // namespace
} // namespace degs
