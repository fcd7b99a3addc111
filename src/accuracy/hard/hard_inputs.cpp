// SPDX-License-Identifier: Apache-2.0
// Hard cases by what a file may hold: H2, H4, H5, H8, H9, H10, H15, H22, H23, H26.
#include <cmath>
#include <limits>

#include "accuracy/hard/hard_builder.hpp"

namespace degs {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<HardScene> scene_of_middle(HardBuilder& builder) {
    builder.look(builder.middle_x(), builder.middle_y(), 40);
    return {std::move(builder.scene)};
}

/// A few ordinary splats in the middle, so that every case has something to draw.
void add_ordinary(HardBuilder& builder) {
    for (int i = 0; i < 6; ++i) {
        builder.add({builder.middle_x() + 5 * i - 12,
                     builder.middle_y() + 3 * i - 9,
                     6.0 + i,
                     3.0,
                     0.5 * i,
                     0.6,
                     {0.2 + 0.1 * i, 0.7, 0.4},
                     10.0 + i});
    }
}

glm::dvec3 warm_rgb(int i) {
    return {0.2 + 0.1 * (i % 7), 0.9 - 0.1 * (i % 5), 0.3};
}

} // namespace

// Without dilation a Gaussian of one axis has a determinant of zero; with it there is none.
std::vector<HardScene> make_degenerate_case(int width, int height) {
    std::vector<HardScene> scenes;
    for (const bool dilated : {false, true}) {
        HardBuilder builder(width, height);
        add_ordinary(builder);
        for (int i = 0; i < 5; ++i) {
            builder.add({builder.middle_x() + i, builder.middle_y(), 4.0 * i, 0, 0.4 * i, 0.5,
                         warm_rgb(i), 20.0 + i});
            builder.scene.cloud.scales.back() =
                glm::vec3(static_cast<float>(i) * 0.01F, 0.0F, 0.0F);
        }
        if (!dilated) {
            builder.scene.projection.dilation = 0;
            builder.scene.culled.degenerate = 5;
        }
        scenes.push_back(scene_of_middle(builder).front());
    }
    return scenes;
}

// All of these are nearer than the reference's 0.2: they are culled, or drawn if the near plane
// is moved.
std::vector<HardScene> make_tiny_scene_case(int width, int height) {
    std::vector<HardScene> scenes;
    for (const double near_plane : {0.2, 0.001}) {
        HardBuilder builder(width, height);
        for (int i = 0; i < 20; ++i) {
            const int column = i % 5;
            const int row = i / 5;
            builder.add({builder.middle_x() + 4 * column, builder.middle_y() + 4 * row, 5, 3,
                         0.3 * i, 0.5, warm_rgb(i), 0.05 + 0.005 * i});
        }
        builder.scene.projection.near_plane = near_plane;
        builder.scene.culled.near = near_plane > 0.1 ? 20 : 0;
        scenes.push_back(scene_of_middle(builder).front());
    }
    return scenes;
}

std::vector<HardScene> make_near_plane_case(int width, int height) {
    HardBuilder builder(width, height);
    add_ordinary(builder);
    for (const double z : {0.1, 0.2, std::nextafter(0.2, 1.0)}) {
        builder.add({builder.middle_x(), builder.middle_y(), 8, 5, 0, 0.5, {0.9, 0.2, 0.2}, z});
    }
    builder.scene.culled.near = 2;
    return scene_of_middle(builder);
}

std::vector<HardScene> make_not_finite_case(int width, int height) {
    HardBuilder builder(width, height);
    GaussianCloud& cloud = builder.scene.cloud;
    add_ordinary(builder);
    for (const float bad : {kNan, kInfinity, -kInfinity}) {
        repeat_last(cloud);
        cloud.scales.back().y = bad;
        repeat_last(cloud);
        cloud.scales.back() = cloud.scales.front();
        cloud.opacities.back() = bad;
        repeat_last(cloud);
        cloud.opacities.back() = 0.5F;
        cloud.means.back().x = bad;
        repeat_last(cloud);
        cloud.means.back() = cloud.means.front();
        cloud.sh.back() = bad;
        repeat_last(cloud);
        cloud.sh.back() = 0;
    }
    builder.scene.dropped.non_finite = 12;
    return scene_of_middle(builder);
}

// Gaussians 6, 8, 10 have quaternions of other lengths, 7, 9, 11 the same ones of length 1.
std::vector<HardScene> make_quaternion_case(int width, int height) {
    HardBuilder builder(width, height);
    GaussianCloud& cloud = builder.scene.cloud;
    add_ordinary(builder);
    const glm::vec4 unit(0.8F, 0.0F, 0.0F, 0.6F);
    for (const float length : {1e-20F, 1e20F, 3.0F}) {
        repeat_last(cloud);
        cloud.rotations.back() = unit * length;
        repeat_last(cloud);
        cloud.rotations.back() = unit;
    }
    repeat_last(cloud);
    cloud.rotations.back() = glm::vec4(0.0F);
    repeat_last(cloud);
    cloud.rotations.back() = {kNan, 0.0F, 0.0F, 1.0F};
    builder.scene.dropped.zero_rotation = 1;
    builder.scene.dropped.non_finite = 1;
    return scene_of_middle(builder);
}

std::string check_quaternion(const HardScene& /*scene*/, const FrameWorkload& workload) {
    for (std::size_t i = 1; i < workload.splats.size(); ++i) {
        const ProjectedSplat& a = workload.splats[i - 1];
        const ProjectedSplat& b = workload.splats[i];
        if (b.id > 6 && b.id % 2 == 1 && std::abs(a.cov_b - b.cov_b) > 1e-6 * a.cov_a) {
            return "Gaussian " + std::to_string(a.id) +
                   " is turned otherwise than its twin with a quaternion of length 1.";
        }
    }
    return {};
}

std::vector<HardScene> make_opacity_case(int width, int height) {
    HardBuilder builder(width, height);
    HardScene& scene = builder.scene;
    const auto limit = static_cast<float>(1.0 / 255.0);
    int i = 0;
    for (const float opacity : {0.0F, 1e-6F, std::nextafter(limit, 0.0F), limit,
                                std::nextafter(limit, 1.0F), 0.004F, 0.99F, 1.0F}) {
        for (const double shift : {0.0, 0.3}) { // on a pixel and beside it
            builder.add({builder.middle_x() + 4 * i - 16 + shift, builder.middle_y() + shift, 3, 2,
                         0.3, 1, warm_rgb(i), 10.0 + i});
            scene.cloud.opacities.back() = opacity;
            scene.culled.transparent += opacity * 255.0 < 1 ? 1 : 0;
        }
        ++i;
    }
    // An ellipse of a thousandth of a pixel lists no tile unless its centre is a pixel's.
    scene.culled.off_screen = limit * 255.0 >= 1 ? 2 : 1;
    for (const float opacity : {1.5F, -0.1F}) {
        repeat_last(scene.cloud);
        scene.cloud.opacities.back() = opacity;
    }
    scene.dropped.bad_opacity = 2;
    return scene_of_middle(builder);
}

std::vector<HardScene> make_depth_range_case(int width, int height) {
    HardBuilder builder(width, height);
    for (int i = 0; i < 60; ++i) { // far ones first, so that order cannot come from the index
        const double depth = 1e7 * std::pow(0.21 / 1e7, i / 59.0);
        builder.add({builder.middle_x() + i % 9, builder.middle_y() + i % 7, 12, 7, 0.2 * i, 0.15,
                     warm_rgb(i), depth});
    }
    return scene_of_middle(builder);
}

std::vector<HardScene> make_colour_case(int width, int height) {
    std::vector<HardScene> scenes;
    for (const double bright : {1.0, 3.0, 30.0}) {
        HardBuilder builder(width, height);
        builder.scene.cloud.sh_degree = 3;
        SyntheticRandom random(22);
        for (int i = 0; i < 40; ++i) {
            const double x = builder.middle_x() + random.uniform(-30, 30);
            const double y = builder.middle_y() + random.uniform(-30, 30);
            const double angle = random.uniform(0, 3);
            const double blue = random.uniform(-0.2, 0.2) + 0.5 * bright;
            const double green = random.uniform(-1, bright), red = random.uniform(-1, bright);
            builder.add({x, y, 9, 4, angle, 0.4, {red, green, blue}, 10.0 + i});
            std::vector<float>& sh = builder.scene.cloud.sh;
            for (std::size_t k = sh.size() - 45; k < sh.size(); ++k) {
                sh[k] = static_cast<float>(random.uniform(-0.1, 0.1) * bright);
            }
        }
        scenes.push_back(scene_of_middle(builder).front());
    }
    return scenes;
}

std::vector<HardScene> make_offset_case(int width, int height) {
    std::vector<HardScene> scenes;
    for (const double offset : {0.0, 1e5, 1e7}) {
        HardBuilder builder(width, height);
        const glm::dvec3 shift(offset, -0.7 * offset, 0.3 * offset);
        for (int i = 0; i < 30; ++i) {
            builder.add({builder.middle_x() + i % 6 * 3, builder.middle_y() + i % 5 * 3, 2, 1,
                         0.3 * i, 0.5, warm_rgb(i), 1.0 + 0.1 * i});
            builder.scene.cloud.means.back() += shift;
        }
        builder.scene.camera.position = shift;
        scenes.push_back(scene_of_middle(builder).front());
    }
    return scenes;
}

std::string check_offset(const HardScene& scene, const FrameWorkload& workload) {
    const HardScene home = make_offset_case(scene.camera.width, scene.camera.height).front();
    const FrameWorkload wanted = make_frame_workload(home.cloud, home.camera, workload.tile_size,
                                                     workload.tile_mode, home.projection);
    // A double at the offset, seen from 1 unit away.
    const double most = 1e-9 + 4 * 2.3e-16 * glm::length(scene.camera.position) * scene.camera.fx;
    for (std::size_t i = 0; i < wanted.splats.size(); ++i) {
        if (workload.splats.size() != wanted.splats.size() ||
            std::abs(workload.splats[i].mu_x - wanted.splats[i].mu_x) > most ||
            std::abs(workload.splats[i].mu_y - wanted.splats[i].mu_y) > most) {
            return "Splat " + std::to_string(i) + " moves on the screen with the world's offset.";
        }
    }
    return {};
}

std::vector<HardScene> make_two_meshes_case(int width, int height) {
    HardBuilder builder(width, height);
    for (const int mesh : {0, 1}) {
        for (int i = 0; i < 40; ++i) {
            builder.add({builder.middle_x() + i % 8, builder.middle_y() + i % 5, 10, 6, 0.1 * i,
                         0.3, mesh == 0 ? glm::dvec3(0.9, 0.1, 0.1) : glm::dvec3(0.1, 0.1, 0.9),
                         10 + 0.1 * i + 0.05 * mesh});
        }
    }
    return scene_of_middle(builder);
}

} // namespace degs
