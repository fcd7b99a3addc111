// SPDX-License-Identifier: Apache-2.0
// Hard cases by the shape and size of splats on the screen: H1, H3, H6, H7, H17, H24, H32.
#include <cmath>

#include "accuracy/hard/hard_builder.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr double kReach = 3.33; ///< deviations from the middle to the end of an opaque splat

} // namespace

std::vector<HardScene> make_needle_case(int width, int height) {
    HardBuilder builder(width, height);
    const double x = builder.middle_x();
    const double y = builder.middle_y();
    constexpr double kDegrees[] = {0, 45, 90, 0.5, 30, 89.5};
    constexpr double kLengths[] = {100, 1000, 10000}; // px, end to end
    constexpr double kAspects[] = {100, 3000, 1e5};
    double depth = 5;
    for (const double degrees : kDegrees) {
        for (const double length : kLengths) {
            for (const double aspect : kAspects) {
                const double major = length / 2 / kReach;
                const double turn = degrees * kPi / 180;
                builder.add({x + 0.3 * depth,
                             y - 0.17 * depth,
                             major,
                             major / aspect,
                             turn,
                             0.5,
                             {0.9, 0.1 * depth, 0.4},
                             depth});
                depth += 0.1;
            }
        }
    }
    for (const double part : {0.0, 0.25, 0.45}) { // along the diagonal, and rows and columns
        builder.look(x + part * height, y + part * height);
        builder.look(x + part * width, y);
        builder.look(x, y + part * height);
    }
    return only_scene(builder);
}

// Closer than its size: the projection has no second order, so these are wrong pictures of a
// Gaussian; they have to be the same wrong pictures, finite and no larger than the screen.
std::vector<HardScene> make_close_case(int width, int height) {
    HardBuilder builder(width, height);
    for (const double z : {0.2001, 0.21, 0.25, 0.3}) {
        for (const double size : {0.3, 1.0, 30.0}) {
            builder.add_world({0.1 * size, -0.05, z}, {size, 0.5 * size, 0.2 * size},
                              {0.9, 0.1, 0.3, 0.3}, 0.15, {0.9, z, 0.3});
        }
    }
    builder.look(builder.middle_x(), builder.middle_y());
    builder.look(0, 0);
    builder.look(width - 1, height - 1);
    return only_scene(builder);
}

std::vector<HardScene> make_far_mean_case(int width, int height) {
    HardBuilder builder(width, height);
    const double half = 0.5 / 0.8; // x / z at the image's edge
    for (const double outside : {1.2, 1.4, 3.0, 10.0}) {
        const double x = outside * half * 2;
        builder.add_world({x, 0.1, 2}, {0.5 * x, 0.4, 0.3}, {0.95, 0.0, 0.2, 0.0}, 0.5,
                          {0.8, 0.3, 0.2 + 0.05 * outside});
        builder.add_world({-x, -0.2, 2.5}, {0.6 * x, 0.3, 0.2}, {0.95, 0.0, -0.2, 0.0}, 0.5,
                          {0.2, 0.7, 0.5});
    }
    builder.look(width - 1, builder.middle_y());
    builder.look(0, builder.middle_y());
    builder.look(builder.middle_x(), builder.middle_y());
    return only_scene(builder);
}

std::string check_far_mean(const HardScene& scene, const FrameWorkload& workload) {
    const Camera& camera = scene.camera;
    for (const ProjectedSplat& splat : workload.splats) {
        const glm::dvec3& mean = scene.cloud.means[splat.id];
        const double x = camera.fx * mean.x / mean.z + 0.5 * camera.width - 0.5;
        if (std::abs(splat.mu_x - x) > 1e-9 * std::abs(x)) {
            return "The clamp of the Jacobian has moved the mean of Gaussian " +
                   std::to_string(splat.id) + ".";
        }
    }
    return {};
}

std::vector<HardScene> make_giants_case(int width, int height) {
    HardBuilder builder(width, height);
    SyntheticRandom random(7);
    for (int i = 0; i < 1000; ++i) {
        const double size = width * random.uniform(1, 4);
        const double aspect = random.uniform(1, 2);
        builder.add({builder.middle_x() + width * random.uniform(-0.3, 0.3),
                     builder.middle_y() + height * random.uniform(-0.3, 0.3),
                     size,
                     size / aspect,
                     random.uniform(0, kPi),
                     0.02,
                     {random.uniform(), random.uniform(), random.uniform()},
                     50 + 0.01 * i});
    }
    builder.look(0, 0);
    builder.look(builder.middle_x(), builder.middle_y());
    builder.look(width - 1, height - 1);
    return only_scene(builder);
}

std::string check_giants(const HardScene& scene, const FrameWorkload& workload) {
    const std::uint64_t wanted = scene.cloud.size() * workload.tiles();
    return workload.tile_pairs() == wanted
               ? ""
               : "The tiles list " + std::to_string(workload.tile_pairs()) +
                     " splats together, but every splat covers every tile: " +
                     std::to_string(wanted) + ".";
}

std::vector<HardScene> make_subpixel_case(int width, int height) {
    HardBuilder builder(width, height);
    SyntheticRandom random(17);
    constexpr int kSplats = 1000000;
    constexpr double kRadius = 90; // px: a hundred or so per pixel
    for (int i = 0; i < kSplats; ++i) {
        const double x = builder.middle_x() + random.uniform(-kRadius, kRadius);
        const double y = builder.middle_y() + random.uniform(-kRadius, kRadius);
        const double size = 0.001 + 0.1 * random.uniform();
        builder.add({x,
                     y,
                     size,
                     size,
                     0,
                     random.uniform(0.01, 0.1),
                     {random.uniform(), 0.5, random.uniform()},
                     10 + 1e-5 * i});
    }
    builder.look(builder.middle_x(), builder.middle_y());
    return only_scene(builder);
}

std::vector<HardScene> make_fp16_range_case(int width, int height) {
    HardBuilder builder(width, height);
    const double x = builder.middle_x();
    const double y = builder.middle_y();
    double depth = 10;
    for (const double sigma : {100.0, 128.0, 256.0, 1000.0, 4096.0}) {
        builder.add({x + 0.3, y, sigma, sigma, 0, 0.3, {0.9, 0.01 * depth, 0.2}, depth});
        builder.add({x, y - 0.4, sigma, sigma / 3, 0.7, 0.3, {0.1, 0.5, 0.1 * depth}, depth + 1});
        depth += 2;
    }
    for (const double distance : {0.0, 255.0, 512.0, 2048.0}) {
        builder.look(x + distance, y);
        builder.look(x, y + distance);
        builder.look(x - distance, y - distance);
    }
    return only_scene(builder);
}

std::vector<HardScene> make_row_case(int width, int height) {
    HardBuilder builder(width, height);
    builder.scene.same_counts = true;
    // Columns and rows of the tiles in the middle, whatever their size up to 64 is.
    const int x = width / 2 / 64 * 64;
    const int y = height / 2 / 64 * 64;
    double depth = 10;
    int row = 0;
    for (const int length : {1, 2, 15, 16, 17, 31, 32, 33, 48}) {
        for (const int begin : {-16, -8, -1, 0, 1}) { // first pixel, from a tile's border
            const double reach = std::sqrt(2 * std::log(0.5 * 255));
            const double radius = (length - 1) / 2.0 + 0.4;
            const double sigma = std::sqrt(std::max(0.0, radius * radius / reach / reach - 0.3));
            builder.add({x + begin + (length - 1) / 2.0,
                         y + row % 64 - 32.0,
                         sigma,
                         0,
                         0,
                         0.5,
                         {0.5, 0.5, 0.01 * length},
                         depth});
            depth += 0.01;
            ++row;
        }
    }
    builder.look(x, y, 64);
    return only_scene(builder);
}

} // namespace degs
