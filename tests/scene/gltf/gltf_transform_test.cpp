// SPDX-License-Identifier: Apache-2.0
// Nodes, instances and cameras of glTF.
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "scene/scene.hpp"
#include "splat/images/image_metrics.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/scene/gltf/glb_builder.hpp"

namespace degs {
namespace {

using test::Glb;
using test::two_splats;
using testing::ElementsAre;
using testing::HasSubstr;

glm::dquat turn() {
    return glm::angleAxis(0.7, glm::normalize(glm::dvec3(1, -2, 0.5)));
}

nlohmann::json numbers(const glm::dquat& q) {
    return {q.x, q.y, q.z, q.w};
}

nlohmann::json matrix(const glm::dmat3& m, const glm::dvec3& t) {
    return {m[0].x, m[0].y, m[0].z, 0, m[1].x, m[1].y, m[1].z, 0,
            m[2].x, m[2].y, m[2].z, 0, t.x,    t.y,    t.z,    1};
}

Image render(const GaussianCloud& cloud, const Camera& camera) {
    ReferenceCounts counts;
    return render_reference(make_frame_workload(cloud, camera, 16, TileMode::Exact), counts);
}

TEST(GltfNodes, ApplyParentsAndParts) {
    Glb glb = two_splats();
    glb.json["nodes"] = {{{"translation", {10, 0, 0}}, {"children", {1}}},
                         {{"mesh", 0}, {"rotation", numbers(turn())}, {"scale", {2, 2, 2}}}};
    const GaussianCloud cloud = test::read(glb).cloud;
    const glm::dvec3 expected = turn() * glm::dvec3(2, 4, 6) + glm::dvec3(10, 0, 0);
    EXPECT_LT(glm::length(cloud.means[0] - expected), 1e-12);
    EXPECT_EQ(cloud.scales[1], glm::vec3(2, 4, 6));
    EXPECT_NEAR(cloud.rotations[0].x, turn().w, 1e-7);
    EXPECT_NEAR(cloud.rotations[0].y, turn().x, 1e-7);

    glb.json["nodes"][1] = {{"mesh", 0},
                            {"matrix", matrix(2.0 * glm::mat3_cast(turn()), glm::dvec3(0))}};
    const GaussianCloud same = test::read(glb).cloud;
    EXPECT_LT(glm::length(same.means[1] - cloud.means[1]), 1e-12);
    EXPECT_LT(glm::length(same.rotations[1] - cloud.rotations[1]), 1e-6);
}

TEST(GltfNodes, ShowAMeshOncePerNodeAndInstance) {
    Glb glb = two_splats();
    const int moves = glb.add({0, 0, 5, 0, 0, 6, 0, 0, 7}, "VEC3");
    const int scales = glb.add({1, 1, 1, 2, 2, 2, 3, 3, 3}, "VEC3");
    glb.json["nodes"].push_back({{"mesh", 0}, {"translation", {100, 0, 0}}});
    glb.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"] = {
        {"attributes", {{"TRANSLATION", moves}, {"SCALE", scales}}}};
    glb.json["scenes"][0]["nodes"] = {0, 1};
    const GaussianCloud cloud = test::read(glb).cloud;
    ASSERT_EQ(cloud.size(), 8U);
    EXPECT_EQ(cloud.means[0], glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.means[2], glm::dvec3(101, 2, 8));
    EXPECT_EQ(cloud.means[4], glm::dvec3(102, 4, 12));
    EXPECT_EQ(cloud.scales[6], glm::vec3(0.1F, 0.2F, 0.3F) * 3.0F);
    EXPECT_EQ(cloud.opacities[7], 1);
}

TEST(GltfNodes, JoinPrimitivesOfDifferentDegrees) {
    Glb glb = two_splats();
    nlohmann::json second = glb.primitive();
    const int coefficient = glb.add({1, 2, 3, 4, 5, 6}, "VEC3");
    for (int n = 0; n < 3; ++n) {
        second["attributes"]["KHR_gaussian_splatting:SH_DEGREE_1_COEF_" + std::to_string(n)] =
            coefficient;
    }
    glb.json["meshes"][0]["primitives"].push_back(second);
    const nlohmann::json triangles = {{"attributes", {{"POSITION", 0}}}};
    glb.json["meshes"][0]["primitives"].push_back(triangles);
    const SceneContent content = test::read(glb);
    ASSERT_EQ(content.cloud.size(), 4U);
    EXPECT_EQ(content.cloud.sh_degree, 1);
    EXPECT_EQ(content.cloud.sh_of(1)[0], 2);
    EXPECT_EQ(content.cloud.sh_of(1)[3], 0);
    EXPECT_EQ(content.cloud.sh_of(3)[3], 4);
    EXPECT_THAT(content.notes, ElementsAre(HasSubstr("1 primitive(s) without")));
}

TEST(GltfNodes, WithoutAScenesListShowAllRoots) {
    Glb glb = two_splats();
    glb.json.erase("scenes");
    glb.json.erase("scene");
    EXPECT_EQ(test::read(glb).cloud.size(), 2U);
}

/// A node that moves splats gives the image that the inverse motion of the camera gives; colours
/// included.
TEST(GltfNodes, MoveLikeTheInverseOfTheCamera) {
    DEGS_NEEDS_SCENE("skull");
    const auto folder = test::scenes() / "skull";
    const Scene scene = load_scene((folder / "scene.ply").string());
    const glm::dvec3 shift(0.5, -0.25, 2);
    const test::Folder out;
    const std::string path = out.path("moved.glb");
    write_glb(scene.cloud, {}, {{"moved", shift, {turn().x, turn().y, turn().z, turn().w}}}, path);
    const GaussianCloud moved = load_scene(path).cloud;

    const Camera camera = scene.cameras[0].scaled_to_width(320);
    Camera follows = camera;
    follows.position = turn() * camera.position + shift;
    follows.camera_to_world = glm::mat3_cast(turn()) * camera.camera_to_world;
    const Image expected = render(scene.cloud, camera);
    const ImageError same = compare_images(expected, render(moved, follows));
    EXPECT_GT(same.psnr_db, 100);
    EXPECT_LT(compare_images(expected, render(moved, camera)).psnr_db, 40); // it does move

    // The moved splats, whose colours have not turned with them.
    GaussianCloud unturned = moved;
    unturned.sh = scene.cloud.sh;
    EXPECT_LT(compare_images(expected, render(unturned, follows)).psnr_db, 60);
}

/// The GLB that another program made of a PLY has nearly the images of the PLY, and ours has them
/// exactly.
TEST(GltfImages, AreThoseOfThePly) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const auto folder = test::scenes() / "fruit-drops";
    const Scene ply = load_scene((folder / "scene.ply").string());
    const GaussianCloud theirs = load_scene((folder / "scene.glb").string()).cloud;
    const test::Folder out;
    write_glb(ply.cloud, {}, {}, out.path("ours.glb"));
    const GaussianCloud ours = load_scene(out.path("ours.glb")).cloud;
    for (const Camera& camera : ply.cameras) {
        const Image expected = render(ply.cloud, camera);
        EXPECT_EQ(render(ours, camera).rgb, expected.rgb);
        // Scales and rotations of `theirs` are rounded otherwise, and a fragment at the threshold
        // may flip.
        EXPECT_GT(compare_images(expected, render(theirs, camera)).psnr_db, 105);
    }
}

Glb with_camera(const nlohmann::json& perspective) {
    Glb glb = two_splats();
    glb.json["cameras"] = {{{"type", "perspective"}, {"perspective", perspective}}};
    glb.json["nodes"].push_back({{"camera", 0}, {"name", "view"}, {"translation", {1, 2, 3}}});
    glb.json["scenes"][0]["nodes"].push_back(1);
    return glb;
}

TEST(GltfCameras, LookAlongMinusZ) {
    const double yfov = 2 * std::atan(0.5);
    Glb glb = with_camera({{"yfov", yfov}, {"znear", 0.1}});
    const SceneContent content = test::read(glb);
    ASSERT_EQ(content.cameras.size(), 1U);
    const Camera& camera = content.cameras[0];
    EXPECT_EQ(camera.name, "view");
    EXPECT_EQ(camera.width, 1280);
    EXPECT_EQ(camera.height, 720);
    EXPECT_NEAR(camera.fy, 720, 1e-9);
    EXPECT_NEAR(camera.fx, 720, 1e-9);
    EXPECT_EQ(camera.position, glm::dvec3(1, 2, 3));
    EXPECT_EQ(camera.camera_to_world[0], glm::dvec3(1, 0, 0));
    EXPECT_EQ(camera.camera_to_world[1], glm::dvec3(0, -1, 0));
    EXPECT_EQ(camera.camera_to_world[2], glm::dvec3(0, 0, -1));
    glb.json["nodes"][1]["rotation"] = numbers(turn());
    glb.json["nodes"][1]["scale"] = {3, 2, 1};
    const glm::dvec3 forward = test::read(glb).cameras[0].camera_to_world[2];
    EXPECT_LT(glm::length(forward + turn() * glm::dvec3(0, 0, 1)), 1e-12);
}

TEST(GltfCameras, TakeTheirSizeFromTheAspectRatio) {
    const double yfov = 2 * std::atan(0.5);
    Glb glb = with_camera({{"yfov", yfov}, {"znear", 0.1}, {"aspectRatio", 1.5}});
    EXPECT_EQ(test::read(glb).cameras[0].width, 1080);
    glb.json["cameras"][0]["extras"] = {{"width", 300}, {"height", 200}};
    const Camera camera = test::read(glb).cameras[0];
    EXPECT_EQ(camera.width, 300);
    EXPECT_EQ(camera.height, 200);
    EXPECT_NEAR(camera.fx, 200, 1e-9);
    EXPECT_NEAR(camera.fy, 200, 1e-9);
    EXPECT_TRUE(camera.lens.is_pinhole());
    // Extras of other programs are theirs.
    for (const char* terms : {"[1, 2]", "[1, 2, 3, \"4\"]", "7", "null"}) {
        glb.json["cameras"][0]["extras"]["camera_model"] = "OPENCV";
        glb.json["cameras"][0]["extras"]["distortion"] = nlohmann::json::parse(terms);
        EXPECT_TRUE(test::read(glb).cameras[0].lens.is_pinhole());
    }
}

TEST(HostileGltfCameras, AreRefusedInOneSentence) {
    const auto said = [](double yfov, double aspect) {
        return test::complaint_about(
            with_camera({{"yfov", yfov}, {"znear", 0.1}, {"aspectRatio", aspect}}));
    };
    EXPECT_EQ(said(1, 1), "");
    EXPECT_THAT(said(0, 1), test::IsSentenceWith("has a yfov of 0.000000 radians"));
    EXPECT_THAT(said(3.2, 1), test::IsSentenceWith("less than pi is needed."));
    EXPECT_THAT(said(1, 100), test::IsSentenceWith("outside 1/720 to 91."));
    EXPECT_THAT(said(1, -1), test::IsSentenceWith("outside 1/720 to 91."));
    EXPECT_THAT(said(1e-320, 1), test::IsSentenceWith("too small for a focal length."));
    Glb glb = with_camera({{"yfov", 1}, {"znear", 0.1}});
    glb.json["nodes"][1]["camera"] = 6;
    EXPECT_THAT(test::complaint_about(glb),
                test::IsSentenceWith("node 1 'view' is number 6, and the file has 1."));
    glb.json["nodes"][1]["camera"] = 0;
    glb.json["nodes"][1]["scale"] = {0, 1, 1};
    EXPECT_THAT(test::complaint_about(glb), test::IsSentenceWith("is singular"));
}

TEST(GltfCameras, IgnoreOrthographicOnes) {
    Glb glb = with_camera({{"yfov", 1}, {"znear", 0.1}});
    glb.json["cameras"][0] = {
        {"type", "orthographic"},
        {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 10}, {"znear", 1}}}};
    const SceneContent content = test::read(glb);
    EXPECT_TRUE(content.cameras.empty());
    EXPECT_THAT(content.notes, ElementsAre(HasSubstr("Orthographic cameras are ignored")));
}

TEST(GltfCameras, AreThoseOfTheScene) {
    const test::Folder folder;
    const std::string path =
        folder.write("scene.glb", with_camera({{"yfov", 1}, {"znear", 0.1}}).bytes());
    EXPECT_EQ(load_scene(path).cameras[0].name, "view");
    EXPECT_EQ(camera_count(path), 1U);
    EXPECT_EQ(read_gltf_cameras(path).size(), 1U);
}

} // namespace
} // namespace degs
