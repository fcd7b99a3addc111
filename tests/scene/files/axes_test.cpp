// SPDX-License-Identifier: Apache-2.0
#include "scene/files/axes.hpp"

#include "accuracy/image_difference.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

const char* const kNames[] = {"RDF", "RDB", "RUF", "RUB", "LDF", "LDB", "LUF", "LUB"};

SyntheticScene turned_scene() {
    return make_synthetic({"object", 400, 3}); // degree 3, rotated Gaussians
}

Image drawn(const GaussianCloud& cloud, Camera camera) {
    camera = camera.scaled_to_width(96);
    ReferenceCounts counts;
    return render_reference(make_frame_workload(cloud, camera, 16, TileMode::Exact), counts);
}

TEST(AxesNames, AreThreeLettersInEitherCase) {
    for (const char* const name : kNames) {
        ASSERT_TRUE(parse_axes(name));
        EXPECT_EQ(parse_axes(name)->name(), name);
    }
    EXPECT_EQ(parse_axes("rub"), parse_axes("RUB"));
    EXPECT_EQ(Axes{}.name(), "RDF");
    for (const char* const wrong : {"", "R", "RU", "RUBB", "RFD", "XYZ", "URB"}) {
        EXPECT_FALSE(parse_axes(wrong)) << wrong;
    }
}

TEST(AxesConversion, TwiceIsTheIdentity) {
    const SyntheticScene scene = turned_scene();
    for (const char* const name : kNames) {
        GaussianCloud cloud = scene.cloud;
        std::vector<Camera> cameras = scene.cameras;
        convert_axes(cloud, Axes{}, *parse_axes(name));
        convert_axes(cameras, Axes{}, *parse_axes(name));
        EXPECT_EQ(cloud.means == scene.cloud.means, std::string(name) == "RDF");
        convert_axes(cloud, *parse_axes(name), Axes{});
        convert_axes(cameras, *parse_axes(name), Axes{});
        EXPECT_EQ(cloud.means, scene.cloud.means);
        EXPECT_EQ(cloud.rotations, scene.cloud.rotations);
        EXPECT_EQ(cloud.sh, scene.cloud.sh);
        EXPECT_EQ(cameras[0].position, scene.cameras[0].position);
        EXPECT_EQ(cameras[0].camera_to_world, scene.cameras[0].camera_to_world);
    }
}

/// Cloud and camera in other axes are the same picture: covariances, colours and order agree.
TEST(AxesConversion, KeepsThePicture) {
    const SyntheticScene scene = turned_scene();
    ASSERT_EQ(scene.cloud.sh_degree, 3);
    const Image wanted = drawn(scene.cloud, scene.cameras[0]);
    for (const char* const name : kNames) {
        GaussianCloud cloud = scene.cloud;
        std::vector<Camera> cameras = scene.cameras;
        convert_axes(cloud, Axes{}, *parse_axes(name));
        ImageDifference unturned;
        unturned.add(wanted, drawn(cloud, cameras[0]));
        EXPECT_EQ(unturned.max_abs_error() > 0.1, std::string(name) != "RDF") << name;
        convert_axes(cameras, Axes{}, *parse_axes(name));
        ImageDifference difference;
        difference.add(wanted, drawn(cloud, cameras[0]));
        EXPECT_LT(difference.max_abs_error(), 1e-6) << name;
        EXPECT_EQ(difference.recounted(), 0U) << name;
    }
}

} // namespace
} // namespace degs
