// SPDX-License-Identifier: Apache-2.0
// Lenses in the files of COLMAP, of nerfstudio and of this program: the cameras that are read put
// points where OpenCV's formulas do.
#include "scene/cameras/lens_terms.hpp"

#include <limits>

#include "tests/scene/cameras/camera_builder.hpp"
#include "tests/splat/model/published_lens.hpp"

namespace degs {
namespace {

using test::PublishedLens;

constexpr double kFocal = 50;

/// A grid of points through a camera at the origin lands where the published lens puts it.
void expect_lens(const Camera& camera, const PublishedLens& published) {
    SCOPED_TRACE(published.name);
    const glm::dvec4 intrinsics(camera.fx, camera.fy, camera.principal_point().x,
                                camera.principal_point().y);
    int compared = 0;
    for (double a = -0.8; a <= 0.8; a += 0.1) {
        for (double b = -0.6; b <= 0.6; b += 0.1) {
            const glm::dvec3 seen(3 * a, 3 * b, 3);
            const auto landing = camera.landing_of(camera.camera_to_world * seen + camera.position);
            if (std::hypot(a, b) > camera.lens.fold_slope()) {
                EXPECT_FALSE(landing);
                continue;
            }
            ASSERT_TRUE(landing);
            const glm::dvec2 at = *landing - glm::dvec2(camera.origin);
            EXPECT_LT(glm::length(at - published.pixel_of(seen, intrinsics)), 1e-9);
            ++compared;
        }
    }
    EXPECT_GT(compared, 100);
}

Camera colmap_camera_of(int model, const std::vector<double>& parameters) {
    const test::Folder folder;
    folder.write("m/cameras.bin", test::colmap_cameras({{1, model, 64, 48, parameters}}));
    folder.write("m/images.bin", test::colmap_images({test::ColmapImage{}}));
    return read_camera_file(folder.path("m")).cameras.at(0);
}

// The order of parameters is that of COLMAP's sensor models.
TEST(LensFiles, OfColmapHaveTheirLens) {
    const double f = kFocal;
    expect_lens(colmap_camera_of(2, {f, 30, 25, -0.1}), {"SIMPLE_RADIAL", false, {-0.1}});
    expect_lens(colmap_camera_of(3, {f, 30, 25, -0.1, 0.02}), {"RADIAL", false, {-0.1, 0.02}});
    expect_lens(colmap_camera_of(4, {f, 51, 30, 25, -0.1, 0.02, 0.003, -0.002}),
                {"OPENCV", false, {-0.1, 0.02, 0.003, -0.002}});
    expect_lens(colmap_camera_of(6, {f, 51, 30, 25, 0.9, 0.3, 0.001, -0.001, 0.02, 1.2, 0.5, 0.06}),
                {"FULL_OPENCV", false, {0.9, 0.3, 0.001, -0.001, 0.02, 1.2, 0.5, 0.06}});
    expect_lens(colmap_camera_of(5, {f, 51, 30, 25, -0.01, 0.02, -0.01, 0.002}),
                {"OPENCV_FISHEYE", true, {-0.01, 0.02, -0.01, 0.002}});
    expect_lens(colmap_camera_of(8, {f, 30, 25, -0.03}), {"SIMPLE_RADIAL_FISHEYE", true, {-0.03}});
    expect_lens(colmap_camera_of(9, {f, 30, 25, -0.03, 0.01}),
                {"RADIAL_FISHEYE", true, {-0.03, 0.01}});
    EXPECT_TRUE(colmap_camera_of(4, {f, 51, 30, 25, 0, 0, 0, 0}).lens.is_pinhole());
    EXPECT_FALSE(colmap_camera_of(5, {f, 51, 30, 25, 0, 0, 0, 0}).lens.is_pinhole());
}

CameraFile nerfstudio_file(const std::string& global, const std::string& frame = "") {
    const test::Folder folder;
    return read_camera_file(folder.write(
        "transforms.json", R"({"w": 64, "h": 48, "fl_x": 50, "fl_y": 51, "cx": 30, "cy": 25, )" +
                               global + R"("frames": [{)" + frame +
                               R"("transform_matrix": [[1,0,0,1],[0,1,0,2],[0,0,1,3]]}]})"));
}

TEST(LensFiles, OfNerfstudioHaveTheirLens) {
    const PublishedLens open_cv{"OPENCV", false, {-0.1, 0.02, 0.003, -0.002, 0.01}};
    const std::string terms = R"("k1":-0.1,"k2":0.02,"p1":0.003,"p2":-0.002,"k3":0.01,)";
    expect_lens(nerfstudio_file(R"("camera_model":"OPENCV",)" + terms).cameras[0], open_cv);
    expect_lens(nerfstudio_file("", terms).cameras[0], open_cv); // of a frame
    const PublishedLens fisheye{"OPENCV_FISHEYE", true, {-0.01, 0.02, -0.01, 0.002}};
    const std::string angles = R"("k1":-0.01,"k2":0.02,"k3":-0.01,"k4":0.002,)";
    expect_lens(nerfstudio_file(R"("camera_model":"OPENCV_FISHEYE",)" + angles).cameras[0],
                fisheye);
    expect_lens(nerfstudio_file(R"("is_fisheye":true,)" + angles).cameras[0], fisheye);
    expect_lens(nerfstudio_file(angles, R"("camera_model":"OPENCV_FISHEYE",)").cameras[0], fisheye);
    // A frame's own model takes the place of the file's.
    const CameraFile own = nerfstudio_file(R"("camera_model":"OPENCV_FISHEYE","k1":0.1,)",
                                           R"("camera_model":"PINHOLE","k1":0,)");
    EXPECT_TRUE(own.cameras[0].lens.is_pinhole());
}

// nerfstudio's k4 is of the eighth power of the radius.
TEST(LensFiles, OfNerfstudioHaveAnEighthPower) {
    const Camera camera = nerfstudio_file(R"("k4": 0.5,)").cameras[0];
    const glm::dvec2 at = *camera.landing_of({1 + 0.5 * 2, 2, 3 - 2}) - glm::dvec2(camera.origin);
    EXPECT_NEAR(at.x, 30 + 50 * 0.5 * (1 + 0.5 / 256), 1e-9);
}

TEST(LensFiles, CamerasJsonKeepsEveryLens) {
    std::vector<Lens> lenses{Lens(), nerfstudio_file(R"("k4": 0.5,)").cameras[0].lens};
    for (const PublishedLens& published : test::published_lenses()) {
        lenses.push_back(published.lens());
    }
    for (const Lens& lens : lenses) {
        std::string text =
            R"([{"width": 64, "height": 48, "position": [0,0,0], "fx": 50, "fy": 50,
                 "rotation": [[1,0,0],[0,1,0],[0,0,1]])";
        if (!lens.is_pinhole()) {
            const LensTerms terms = terms_of(lens);
            text += R"(, "camera_model": ")" + terms.model + R"(", "distortion": [)";
            for (std::size_t i = 0; i < terms.terms.size(); ++i) {
                char number[32];
                std::snprintf(number, sizeof number, "%s%.17g", i == 0 ? "" : ",", terms.terms[i]);
                text += number;
            }
            text += "]";
        }
        const test::Folder folder;
        EXPECT_EQ(read_camera_file(folder.write("cameras.json", text + "}]")).cameras[0].lens,
                  lens);
    }
}

TEST(LensFiles, HostileDistortionIsOneSentence) {
    const test::Folder folder;
    const auto complaint = [&folder](const std::string& keys) -> std::string {
        const std::string text =
            R"([{"width": 64, "height": 48, "position": [0,0,0], "fx": 50, "fy": 50, )" + keys +
            R"(, "rotation": [[1,0,0],[0,1,0],[0,0,1]]}])";
        try {
            read_camera_file(folder.write("cameras.json", text));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    using test::IsSentenceWith;
    EXPECT_THAT(complaint(R"("camera_model":"OPENCV")"), IsSentenceWith("no key 'distortion'"));
    EXPECT_THAT(complaint(R"("camera_model":"OPENCV","distortion":[1])"),
                IsSentenceWith("with a distortion of 1 numbers; allowed are PINHOLE"));
    EXPECT_THAT(complaint(R"("camera_model":"FOV","distortion":[1,2,3,4])"),
                IsSentenceWith("camera_model 'FOV'"));
    EXPECT_THAT(complaint(R"("camera_model":"OPENCV","distortion":[1,2,3,"a"])"),
                IsSentenceWith("distortion[3] that is not a number"));
    EXPECT_THAT(complaint(R"("camera_model":"OPENCV","distortion":7)"),
                IsSentenceWith("not an array of numbers"));
    EXPECT_EQ(complaint(R"("camera_model":"OPENCV","distortion":[-1e300,1e300,1e300,-1e300])"), "");
}

// A note says when corners of the image stay empty.
TEST(LensFiles, FoldsBeforeACornerAreMentioned) {
    const CameraFile folds = nerfstudio_file(R"("k1":-0.6,)");
    ASSERT_EQ(folds.notes.size(), 1U);
    EXPECT_THAT(folds.notes[0], ::testing::HasSubstr("folds back 36.7 degrees"));
    EXPECT_TRUE(nerfstudio_file(R"("k1":-0.1,)").notes.empty());
}

} // namespace
} // namespace degs
