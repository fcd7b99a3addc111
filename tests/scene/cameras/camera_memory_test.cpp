// SPDX-License-Identifier: Apache-2.0
// What a camera file may cost: memory in proportion to its size. Not a Hostile suite, because the
// address sanitizer keeps what has been freed.
#include "tests/scene/cameras/camera_builder.hpp"
#include "tests/scene/reading_cost.hpp"

namespace degs {
namespace {

constexpr std::size_t kFileBytes = 8U << 20U;
const char* const kCamera = R"({"width":1,"height":1,"position":[0,0,0],)"
                            R"("rotation":[[1,0,0],[0,1,0],[0,0,1]],"fx":1,"fy":1})";

/// `head`, then `part` as often as it fits, then `tail`.
std::string filled(const std::string& head, const std::string& part, const std::string& tail) {
    std::string text = head;
    while (text.size() + part.size() + tail.size() < kFileBytes) {
        text += part;
    }
    return text + tail;
}

/// "k0":1,"k1":1, ...
std::string many_keys() {
    std::string text = "[{";
    for (int i = 0; text.size() < kFileBytes; ++i) {
        text += "\"k" + std::to_string(i) + "\":1,";
    }
    return text + "\"x\":1}]";
}

/// Bytes of memory per byte of the file that reading it takes.
double memory_per_byte(const std::string& path) {
    const test::ReadingCost cost = test::cost_of_reading([&] { test::read_cameras_of(path); });
    EXPECT_TRUE(cost.ended) << path;
    return static_cast<double>(cost.bytes) / kFileBytes;
}

TEST(LongCameraMemory, IsAtMostTwelveTimesTheFile) {
    const std::pair<const char*, std::string> cases[] = {
        {"cameras", filled("[", std::string(kCamera) + ",", std::string(kCamera) + "]")},
        {"empty objects", filled("[", "{},", "1]")},
        {"objects in an unknown key", filled("[{\"x\":[", "{},", "1]}]")},
        {"members in an unknown key", filled("[{\"x\":{", "\"a\":{},", "\"a\":1}}]")},
        {"numbers in a position", filled("[{\"position\":[", "1,", "1]}]")},
        {"numbers in an unknown key", filled("[{\"x\":[", "1,", "1]}]")},
        {"levels", filled("[{\"x\":", "[", "")},
        {"one text", filled("[{\"img_name\":\"", "a", "\"}]")},
        {"one number", filled("[{\"width\":", "1", "}]")},
        {"keys", many_keys()}};
    const test::Folder folder;
    const std::string path = folder.write("cameras.json", kCamera);
    for (const auto& [what, text] : cases) {
        folder.write("cameras.json", text);
        const double cost = memory_per_byte(path);
        EXPECT_GE(cost, 0) << what;
        EXPECT_LE(cost, 12) << what;
    }
}

std::string many_images() {
    std::vector<test::ColmapImage> images(kFileBytes / 78);
    for (std::size_t i = 0; i < images.size(); ++i) {
        images[i].name = std::to_string(i);
    }
    return test::colmap_images(images);
}

TEST(LongCameraMemory, OfOtherFormatsIsAtMostTwelveTimesTheFile) {
    const std::string frame = R"({"transform_matrix":[[1,0,0,0],[0,1,0,0],[0,0,1,0]]})";
    const std::string head = R"({"w":1,"h":1,"fl_x":1,"frames":[)";
    const std::pair<const char*, std::string> cases[] = {
        {"frames", filled(head, frame + ",", frame + "]}")},
        {"an unknown key", filled(R"({"x":[)", "{\"a\":[]},", "1],\"frames\":[]}")},
        {"numbers in a matrix", filled(head + R"({"transform_matrix":[)", "1,", "1]}]}")}};
    const test::Folder folder;
    const std::string path = folder.write("transforms.json", frame);
    for (const auto& [what, text] : cases) {
        folder.write("transforms.json", text);
        const double cost = memory_per_byte(path);
        EXPECT_GE(cost, 0) << what;
        EXPECT_LE(cost, 12) << what;
    }
    folder.write("m/cameras.bin", test::colmap_cameras({test::ColmapLens{}}));
    const std::string images = folder.write("m/images.bin", many_images());
    const double cost = memory_per_byte(images);
    EXPECT_GE(cost, 0);
    EXPECT_LE(cost, 12);
    EXPECT_EQ(read_camera_file(images).cameras.size(), kFileBytes / 78);
}

} // namespace
} // namespace degs
