// SPDX-License-Identifier: Apache-2.0
#include "base/gini.hpp"

#include <cmath>

#include "scene/dynamic_scene.hpp"
#include "scene/scene.hpp"
#include "sim/cache/cached_view.hpp"
#include "sim/design/run_config.hpp"
#include "sim/simulation/frame_changes.hpp"
#include "sim/view/view.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/sim/simulation/all_frames.hpp"

namespace degs::sim {
namespace {

/// Tiles in one row with lists of these lengths, and these visible Gaussians of ten.
FrameWorkload frame_with(const std::vector<std::uint64_t>& lengths,
                         const std::vector<std::uint32_t>& visible) {
    FrameWorkload frame;
    frame.tiles_x = static_cast<int>(lengths.size());
    frame.tiles_y = 1;
    frame.gaussians = 10;
    frame.visible_of = visible;
    frame.tile_begin = {0};
    for (const std::uint64_t length : lengths) {
        frame.tile_begin.push_back(frame.tile_begin.back() + length);
    }
    return frame;
}

FrameChanges frame_changes(const std::vector<const FrameWorkload*>& frames) {
    FrameChangesSum sum(frames.size());
    for (const FrameWorkload* frame : frames) {
        sum.add(borrowed(*frame));
    }
    return sum.changes();
}

TEST(FrameChanges, FollowTheirFormulas) {
    const FrameWorkload a = frame_with({4, 0, 6}, {1, 2, 3});
    const FrameWorkload b = frame_with({4, 2, 3}, {2, 3, 4, 5});
    const FrameWorkload c = frame_with({4, 2, 3}, {2, 3, 4, 5});
    const FrameChanges changes = frame_changes({&a, &b, &c});
    EXPECT_DOUBLE_EQ(changes.active_overlap.value(), (2.0 / 5 + 1) / 2);
    EXPECT_DOUBLE_EQ(changes.tile_churn.value(), (5.0 / 12 + 0) / 2); // |0-2| + |6-3|, 4 + 2 + 6
    EXPECT_EQ(changes.p99_tile_candidates, 6);
    EXPECT_FALSE(frame_changes({&a}).active_overlap.has_value());
    EXPECT_FALSE(frame_changes({&a}).tile_churn.has_value());
    FrameWorkload other = a;
    other.gaussians = 11;
    EXPECT_FALSE(frame_changes({&a, &other}).active_overlap.has_value());
    EXPECT_TRUE(frame_changes({&a, &other}).tile_churn.has_value());
    std::vector<std::uint64_t> lengths(200, 1);
    lengths[7] = lengths[9] = lengths[11] = 50;
    const FrameWorkload wide = frame_with(lengths, {});
    EXPECT_EQ(frame_changes({&wide}).p99_tile_candidates, 50); // rank 198 of 200
    lengths[7] = lengths[9] = 1;
    const FrameWorkload single = frame_with(lengths, {});
    EXPECT_EQ(frame_changes({&single}).p99_tile_candidates, 1);
    std::vector<std::uint64_t> fewer(99, 1);
    fewer[7] = 50;
    const FrameWorkload narrow = frame_with(fewer, {});
    EXPECT_EQ(frame_changes({&narrow}).p99_tile_candidates, 50); // rank 98.01 is the last of 99
}

TEST(FrameChanges, GiniOfKnownLists) {
    EXPECT_DOUBLE_EQ(gini({}), 0);
    EXPECT_DOUBLE_EQ(gini({0, 0}), 0);
    EXPECT_NEAR(gini({3, 3, 3, 3}), 0, 1e-15);
    EXPECT_DOUBLE_EQ(gini({0, 0, 0, 8}), 0.75); // (n - 1) / n
    EXPECT_DOUBLE_EQ(gini({3, 1}), 0.25);       // mean difference 1 over twice the mean 2
    EXPECT_NEAR(gini({1, 2, 3, 4}), 0.25, 1e-15);
}

TEST(FrameChanges, FootprintsAreAreasOfEllipses) {
    FrameWorkload frame = frame_with({2}, {0, 1});
    ProjectedSplat small;
    small.q_threshold = 2;
    small.det = 1;
    ProjectedSplat large = small;
    large.det = 9; // three times the area
    frame.splats = {small, large};
    EXPECT_NEAR(frame_changes({&frame}).footprint_gini, 0.25, 1e-12);
}

RunConfig design() {
    return load_run_config(std::string(DEGS_CONFIGS) + "/degs-64.yaml", {}, "");
}

ViewRequest view_of(const std::string& scene) {
    ViewRequest request;
    request.scene = scene;
    request.width = 160;
    return request;
}

TEST(DynamicFrames, AreThoseOfTheSceneSeenByOneCamera) {
    const PathRequest path{3, 0.5};
    CachedView view(view_of("synthetic:dynamic,gaussians=3000"), path, FrameCache());
    const std::vector<FrameWorkload> frames = sim_test::all_frames(view, design().accelerator());
    ASSERT_EQ(frames.size(), 3U);
    for (int k = 0; k < 3; ++k) {
        const std::string time = std::to_string(static_cast<double>(k) / kFramesOfScene);
        CachedView still(view_of("synthetic:dynamic,gaussians=3000,time=" + time), {},
                         FrameCache());
        const std::vector<FramePointer> alone = still.first_frame(design().accelerator());
        EXPECT_EQ(frames[k].camera.position, frames[0].camera.position);
        EXPECT_EQ(frames[k].tile_splats, alone[0]->tile_splats) << k;
    }
    EXPECT_NE(frames[0].tile_splats, frames[2].tile_splats);
    const FrameChanges changes = frame_changes({&frames[0], &frames[1], &frames[2]});
    EXPECT_GT(changes.active_overlap.value(), 0.5);
    EXPECT_LT(changes.active_overlap.value(), 1);
    EXPECT_GT(changes.tile_churn.value(), 0);
}

TEST(DynamicFrames, AsManyAsTheSceneHas) {
    CachedView view(view_of("synthetic:dynamic,gaussians=100"), {kFramesOfScene + 1, 0.5},
                    FrameCache());
    EXPECT_THAT(test::complaint([&] { view.first_frame(design().accelerator()); }),
                test::IsSentenceWith("The scene has 50 frames, and 51 were asked for"));
}

} // namespace
} // namespace degs::sim
