// SPDX-License-Identifier: Apache-2.0
// A GLB that another program made of a PLY: what keeps its images from being those of the PLY.
#include <cmath>
#include <cstdio>

#include "accuracy/image_difference.hpp"
#include "scene/scene.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

struct Frame {
    FrameWorkload workload;
    Image image;

    Frame(const GaussianCloud& cloud, const Camera& camera)
        : workload(make_frame_workload(cloud, camera, 16, TileMode::Exact)) {
        ReferenceCounts counts;
        image = render_reference(workload, counts);
    }
};

double psnr(const Image& reference, const Image& test) {
    ImageDifference difference;
    difference.add(reference, test);
    return difference.psnr_db();
}

/// The PSNR without the pixels to which one of both adds a splat that the other leaves out.
double psnr_without_flips(const Image& reference, Image test, int& flipped) {
    flipped = 0;
    for (std::size_t i = 0; i < test.pixels(); ++i) {
        if (test.fragments[i] != reference.fragments[i]) {
            ++flipped;
            std::copy_n(&reference.rgb[3 * i], 3, &test.rgb[3 * i]);
        }
    }
    return psnr(reference, test);
}

double alpha_at(const ProjectedSplat& s, int x, int y) {
    const double dy = y - s.mu_y;
    const double u = x - s.mu_x - s.cov_b / s.cov_c * dy;
    return s.opacity * std::exp(-0.5 * (s.conic_a() * u * u + dy * dy / s.cov_c));
}

/// The largest |255 alpha - 1| of a splat that one frame draws into a pixel and the other not.
double farthest_flip(const Frame& one, const Frame& other) {
    double farthest = 0;
    for (std::size_t i = 0; i < one.image.pixels(); ++i) {
        if (one.image.fragments[i] == other.image.fragments[i]) {
            continue;
        }
        const int x = static_cast<int>(i) % one.image.width;
        const int y = static_cast<int>(i) / one.image.width;
        for (std::size_t s = 0; s < one.workload.splats.size(); ++s) {
            const double a = 255 * alpha_at(one.workload.splats[s], x, y) - 1;
            const double b = 255 * alpha_at(other.workload.splats[s], x, y) - 1;
            if ((a >= 0) != (b >= 0)) {
                farthest = std::max(farthest, std::max(std::abs(a), std::abs(b)));
            }
        }
    }
    return farthest;
}

/// The share of the values of both that are the same floats.
template <class Vector>
double same_share(const std::vector<Vector>& one, const std::vector<Vector>& other) {
    std::size_t same = 0, all = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        for (int c = 0; c < Vector::length(); ++c, ++all) {
            same += one[i][c] == other[i][c] ? 1 : 0;
        }
    }
    return static_cast<double>(same) / static_cast<double>(all);
}

// The file has other floats than the nearest to the values of the PLY. They move no pixel visibly,
// but where alpha is 1/255 to six digits, one of both draws a splat that the other leaves out.
TEST(GltfExporter, FlipsAtTheThresholdBoundTheAgreement) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const auto folder = test::scenes() / "fruit-drops";
    const Scene ply = load_scene((folder / "scene.ply").string());
    const GaussianCloud theirs = load_scene((folder / "scene.glb").string()).cloud;
    std::printf("same floats: scales %.1f %%, rotations %.1f %%\n",
                100 * same_share(theirs.scales, ply.cloud.scales),
                100 * same_share(theirs.rotations, ply.cloud.rotations));
    std::printf("%-4s %6s %6s %12s %13s\n", "view", "dB", "flips", "|255 a - 1|", "dB but flips");
    for (std::size_t view = 0; view < ply.cameras.size(); ++view) {
        const Frame wanted(ply.cloud, ply.cameras[view]), got(theirs, ply.cameras[view]);
        ASSERT_EQ(got.workload.visible_of, wanted.workload.visible_of);
        int flipped = 0;
        const double rest = psnr_without_flips(wanted.image, got.image, flipped);
        const double farthest = farthest_flip(wanted, got);
        std::printf("%-4zu %6.1f %6d %12.1e %13.1f\n", view, psnr(wanted.image, got.image), flipped,
                    farthest, rest);
        EXPECT_GT(rest, 120);
        EXPECT_LE(flipped, 10);
        EXPECT_LT(farthest, 2e-6);
        EXPECT_EQ(flipped > 0, farthest > 0);
    }
}

} // namespace
} // namespace degs
