// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>
#include <limits>

#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

using test::bytes_of_value;
using test::colmap_cameras;
using test::colmap_images;
using test::ColmapImage;
using test::ColmapLens;
using test::IsSentenceWith;

const double kNotANumber = std::numeric_limits<double>::quiet_NaN();

std::string complaint_about_model(const std::string& cameras, const std::string& images,
                                  const std::string& extension) {
    const test::Folder folder;
    folder.write("cameras" + extension, cameras);
    folder.write("images" + extension, images);
    std::string sentence = test::complaint([&] { read_camera_file(folder.path("")); });
    EXPECT_TRUE(sentence.empty() || sentence.find(extension + ": ") != std::string::npos);
    return sentence;
}

std::string with_lens(const std::function<void(ColmapLens&)>& change) {
    ColmapLens lens;
    change(lens);
    return complaint_about_model(colmap_cameras({lens}), colmap_images({ColmapImage{}}), ".bin");
}

std::string with_image(const std::function<void(ColmapImage&)>& change) {
    ColmapImage image;
    change(image);
    return complaint_about_model(colmap_cameras({ColmapLens{}}), colmap_images({image}), ".bin");
}

TEST(HostileColmap, EveryMistakeOfACameraHasItsSentence) {
    const std::pair<std::function<void(ColmapLens&)>, const char*> cases[] = {
        {[](ColmapLens& c) { c.model = 7; },
         "camera 0 has the camera model FOV; allowed are SIMPLE_PINHOLE"},
        {[](ColmapLens& c) { c.model = 11; }, "RAD_TAN_THIN_PRISM_FISHEYE"},
        {[](ColmapLens& c) { c.model = 99; }, "number 99, which is not known"},
        {[](ColmapLens& c) { c.model = -1; }, "number -1, which is not known"},
        {[](ColmapLens& c) { c.width = 0; }, "a width of 0; allowed are integers from 1 to 65536"},
        {[](ColmapLens& c) { c.height = 65537; }, "a height of 65537"},
        {[](ColmapLens& c) { c.width = ~std::uint64_t{0}; }, "a width of 1.84467441e+19"},
        {[](ColmapLens& c) { c.parameters[0] = 0; }, "a focal length fx of 0"},
        {[](ColmapLens& c) { c.parameters[1] = -2; }, "a focal length fy of -2"},
        {[](ColmapLens& c) { c.parameters[2] = kNotANumber; },
         "a parameter of its camera model that is not finite"},
        {[](ColmapLens& c) { c.id = 2; },
         "image 0 names the camera 1, which the file of cameras does not have"},
        {[](ColmapLens& c) { c.parameters.push_back(1); }, "8 bytes behind its last record"},
        {[](ColmapLens& c) { c.parameters.pop_back(); },
         "camera 0 is cut off: it needs 8 more bytes"},
    };
    for (const auto& [change, sentence] : cases) {
        EXPECT_THAT(with_lens(change), IsSentenceWith(sentence));
    }
    EXPECT_THAT(complaint_about_model(colmap_cameras({ColmapLens{}, ColmapLens{}}),
                                      colmap_images({ColmapImage{}}), ".bin"),
                IsSentenceWith("two cameras have the id 1"));
}

TEST(HostileColmap, EveryMistakeOfAnImageHasItsSentence) {
    const std::pair<std::function<void(ColmapImage&)>, const char*> cases[] = {
        {[](ColmapImage& i) { i.rotation[0] = 1.01; },
         "image 0 has a rotation whose quaternion is not of length 1"},
        {[](ColmapImage& i) { i.rotation[0] = 0; }, "not of length 1"},
        {[](ColmapImage& i) { i.rotation[3] = kNotANumber; }, "not of length 1"},
        {[](ColmapImage& i) { i.translation[1] = kNotANumber; },
         "a translation that is not finite"},
        {[](ColmapImage& i) { i.camera = 4; }, "names the camera 4"},
        {[](ColmapImage& i) { i.id = 1U << 31U; }, "the id 2147483648"},
        {[](ColmapImage& i) { i.name = std::string(5000, 'a'); }, "a name of more than 4096 bytes"},
    };
    for (const auto& [change, sentence] : cases) {
        EXPECT_THAT(with_image(change), IsSentenceWith(sentence));
    }
    EXPECT_THAT(complaint_about_model(colmap_cameras({ColmapLens{}}),
                                      colmap_images({ColmapImage{}, ColmapImage{}}), ".bin"),
                IsSentenceWith("two images have the name 'a.jpg'"));
}

TEST(HostileColmap, SizesMustMeetTheFile) {
    const std::string cameras = colmap_cameras({ColmapLens{}});
    const std::string images = colmap_images({ColmapImage{}});
    const auto about = [&](const std::string& bytes) {
        return complaint_about_model(cameras, bytes, ".bin");
    };
    EXPECT_THAT(about(images + "x"), IsSentenceWith("1 bytes behind its last record"));
    EXPECT_THAT(about(bytes_of_value(std::uint64_t{1}).substr(0, 7)),
                IsSentenceWith("the file has 7 bytes"));
    EXPECT_THAT(about(bytes_of_value(std::uint64_t{0})), IsSentenceWith("holds no image"));
    std::string many = images;
    many.replace(0, 8, bytes_of_value(~std::uint64_t{0}));
    EXPECT_THAT(about(many),
                IsSentenceWith("announces 18446744073709551615 images of at least 73"));
    // The number of points stands in the last 8 bytes.
    std::string points = images;
    points.replace(points.size() - 8, 8, bytes_of_value(~std::uint64_t{0} / 24 + 2));
    EXPECT_THAT(about(points), IsSentenceWith("points of 24 bytes"));
    points.replace(points.size() - 8, 8, bytes_of_value(std::uint64_t{2}));
    EXPECT_THAT(about(points + std::string(47, 'x')), IsSentenceWith("announces 2 points"));
    EXPECT_EQ(about(points + std::string(48, 'x')), "");
    std::string endless = images;
    endless.replace(images.find("a.jpg") + 5, 9, std::string(9, 'b'));
    EXPECT_THAT(about(endless), IsSentenceWith("image 0 is cut off"));
}

TEST(HostileColmap, TextFiles) {
    const std::string lens = "1 PINHOLE 64 48 50 50 32 24\n";
    const std::string image = "1 1 0 0 0 0 0 0 1 a.jpg\n\n";
    const std::tuple<std::string, std::string, const char*> cases[] = {
        {"x PINHOLE 64 48 50 50 32 24", image, "line 1 has a CAMERA_ID of 'x'"},
        {"# c\n-1 PINHOLE 64 48 50 50 32 24", image, "line 2 has a CAMERA_ID of '-1'"},
        {"1", image, "has no MODEL"},
        {"1 LENS 64 48 50", image, "the camera model 'LENS', which is not known"},
        {"1 FOV 64 48 50", image, "the camera model 'FOV'"},
        {"1 PINHOLE 64 48 50 50 32", image, "has no parameter 3"},
        {"1 PINHOLE 64 48 50 50 32 24 1", image, "more parameters than"},
        {"1 PINHOLE 64 4x 50 50 32 24", image, "a HEIGHT of '4x', which is not a number"},
        {"1 PINHOLE 64.5 48 50 50 32 24", image, "a width of 64.5"},
        {"1 PINHOLE 64 48 inf 50 32 24", image, "not finite"},
        {lens, "1 1 0 0 0 0 0 0 1\n\n", "line 1 has no NAME"},
        {lens, "1 1 0 0\n\n", "has no QZ"},
        {lens, "1 1 0 0 0 0 0 z 1 a\n\n", "a TZ of 'z'"},
        {lens, "1 1 0 0 0 0 0 0 9 a\n\n", "line 1 names the camera 9"},
        {lens, "1 1 0 0 0 0 0 0 1 a\n2 1 0 0 0 0 0 0 1 b\n", "line 2 has 10 numbers"},
        {lens, "# nothing\n", "holds no image"},
        {lens, std::string(70000, 'a'), "line 1 is longer than 65536 bytes"},
        {lens, "1 1 0 0 0 0 0 0 1 " + std::string(5000, 'n') + "\n\n", "a NAME of more than 4096"},
    };
    for (const auto& [cameras, images, sentence] : cases) {
        EXPECT_THAT(complaint_about_model(cameras, images, ".txt"), IsSentenceWith(sentence));
    }
}

TEST(HostileColmap, FilesThatDoNotBelongTogether) {
    const test::Folder folder;
    EXPECT_THAT(test::complaint([&] { read_camera_file(folder.path("")); }),
                IsSentenceWith("this folder holds no cameras"));
    const std::string alone = folder.write("alone/cameras.bin", colmap_cameras({ColmapLens{}}));
    EXPECT_THAT(test::complaint([&] { read_camera_file(alone); }),
                IsSentenceWith("alone/images.bin: there is no such file"));
    EXPECT_THAT(test::complaint([&] { read_camera_file(folder.path("alone")); }),
                IsSentenceWith("this folder holds no cameras"));
    const std::string renamed = folder.write("c.dat", colmap_cameras({ColmapLens{}}));
    EXPECT_THAT(test::complaint([&] { read_camera_file(renamed); }),
                IsSentenceWith("such files are called cameras.bin and images.bin"));
    folder.write("empty/cameras.bin", "");
    folder.write("empty/images.bin", colmap_images({ColmapImage{}}));
    EXPECT_THAT(test::complaint([&] { read_camera_file(folder.path("empty")); }),
                IsSentenceWith("empty"));
}

} // namespace
} // namespace degs
