// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "splat/frame/frame_workload.hpp"
#include "splat/images/image_metrics.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs {
namespace {

/// Restores the number of threads.
struct Threads {
    explicit Threads(int most) { limit_host_threads(most); }
    ~Threads() { limit_host_threads(static_cast<int>(std::thread::hardware_concurrency())); }
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;
};

// Also those behind the last whole part of 8192.
TEST(Parallel, RangesHaveEveryIndexOnce) {
    for (const std::size_t count : {0, 1, 8191, 8192, 8193, 20000}) {
        std::vector<int> done(count); // ranges do not meet
        parallel_ranges(count, [&](std::size_t begin, std::size_t end) {
            ASSERT_LE(end, count);
            for (std::size_t i = begin; i < end; ++i) {
                ++done[i];
            }
        });
        EXPECT_EQ(std::count(done.begin(), done.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(Parallel, DoesEveryBlockOnceWithFewWorkers) {
    for (const int most : {1, 2, 5}) {
        const Threads threads(most);
        for (const std::size_t blocks : {0, 1, 3, 1000}) {
            std::vector<std::atomic<int>> done(blocks);
            std::atomic<int> strangers{0};
            parallel_blocks(blocks, [&](std::size_t block, std::size_t worker) {
                ++done[block];
                strangers += worker >= static_cast<std::size_t>(most) ? 1 : 0;
            });
            for (const std::atomic<int>& times : done) {
                EXPECT_EQ(times, 1);
            }
            EXPECT_EQ(strangers, 0);
        }
    }
}

TEST(Parallel, ThrowsWhatABlockThrows) {
    constexpr int kBlocks = 100000;
    const Threads threads(3);
    std::atomic<int> begun{0};
    EXPECT_THROW(parallel_blocks(kBlocks,
                                 [&](std::size_t block, std::size_t) {
                                     ++begun;
                                     if (block == 7) {
                                         throw std::runtime_error("block 7");
                                     }
                                     // Lets the one that throws go on, whatever else runs.
                                     std::this_thread::sleep_for(std::chrono::microseconds(50));
                                 }),
                 std::runtime_error);
    EXPECT_LT(begun, kBlocks);
}

TEST(Parallel, AllowsNoFewerThanOneThread) {
    const Threads threads(-4);
    EXPECT_EQ(host_threads(), 1);
}

/// A cloud of several blocks, in a frame of several tile rows.
GaussianCloud large_cloud() {
    GaussianCloud cloud;
    for (int i = 0; i < 50000; ++i) {
        const float x = static_cast<float>(i % 251) / 100 - 1.25F;
        const float y = static_cast<float>(i % 241) / 200 - 0.6F;
        cloud.means.emplace_back(x, y, i % 97 / 20.0 - 1);
        cloud.scales.emplace_back(0.01F, 0.02F, 0.005F);
        cloud.rotations.emplace_back(1, 0, 0, 0);
        cloud.opacities.push_back(static_cast<float>(i % 11) / 12);
        cloud.sh.insert(cloud.sh.end(), {0.1F, 0.5F, static_cast<float>(i % 7) / 7});
    }
    return cloud;
}

TEST(Parallel, FramesAndImagesDoNotDependOnTheThreads) {
    const GaussianCloud cloud = large_cloud();
    Camera camera;
    camera.width = 300;
    camera.height = 200;
    camera.fx = camera.fy = 250;
    camera.position = {0, 0, -4};
    const auto made = [&](int most, Image& image, ReferenceCounts& counts) {
        const Threads threads(most);
        FrameWorkload frame = make_frame_workload(cloud, camera, 16, TileMode::Exact);
        image = render_reference(frame, counts);
        return frame;
    };
    Image image, other_image;
    ReferenceCounts counts, other_counts;
    const FrameWorkload frame = made(1, image, counts);
    ASSERT_GT(frame.splats.size(), 30000U);
    for (const int most : {2, 7}) {
        const FrameWorkload other = made(most, other_image, other_counts);
        EXPECT_EQ(frame.visible_of, other.visible_of);
        EXPECT_EQ(frame.visible_means, other.visible_means);
        EXPECT_EQ(frame.tile_begin, other.tile_begin);
        EXPECT_EQ(frame.tile_splats, other.tile_splats);
        EXPECT_EQ(frame.tiles_touched, other.tiles_touched);
        EXPECT_EQ(frame.culled.total(), other.culled.total());
        EXPECT_EQ(image.rgb, other_image.rgb);
        EXPECT_EQ(image.fragments, other_image.fragments);
        EXPECT_EQ(counts.fragments, other_counts.fragments);
        EXPECT_EQ(counts.terminated, other_counts.terminated);
        Image changed = image;
        for (std::size_t i = 0; i < changed.rgb.size(); i += 3) {
            changed.rgb[i] *= 0.99F;
        }
        const auto similarity = [&](int allowed) {
            const Threads threads(allowed);
            return compare_images(image, changed).ssim;
        };
        EXPECT_EQ(similarity(1), similarity(most));
    }
}

} // namespace
} // namespace degs
