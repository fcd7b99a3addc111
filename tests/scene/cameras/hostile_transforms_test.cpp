// SPDX-License-Identifier: Apache-2.0
#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;

const char* const kPose = "[[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]";

/// Keys and values of a JSON object, with the value of `key` exchanged; empty removes it.
std::string object_with(const std::vector<std::pair<std::string, std::string>>& entries,
                        const std::string& key, const std::string& value) {
    std::string text;
    bool found = false;
    for (const auto& [name, usual] : entries) {
        const std::string& chosen = name == key ? value : usual;
        found = found || name == key;
        if (!chosen.empty()) {
            text += (text.empty() ? "\"" : ",\"") + name + "\":" + chosen;
        }
    }
    if (!found && !key.empty()) {
        text += ",\"" + key + "\":" + value;
    }
    return "{" + text + "}";
}

std::string transforms_with(const std::string& root_key, const std::string& root_value,
                            const std::string& frame_key = "",
                            const std::string& frame_value = "") {
    const std::string frame = object_with({{"file_path", "\"a.png\""}, {"transform_matrix", kPose}},
                                          frame_key, frame_value);
    return object_with({{"w", "64"}, {"h", "48"}, {"fl_x", "50"}, {"frames", "[" + frame + "]"}},
                       root_key, root_value);
}

std::string complaint_about_transforms(const std::string& text) {
    const test::Folder folder;
    const std::string path = folder.write("transforms.json", text);
    std::string sentence = test::complaint([&] { read_camera_file(path); });
    EXPECT_EQ(sentence.rfind(path + ": ", 0), 0U) << sentence;
    return sentence;
}

TEST(HostileTransforms, EveryMistakeOfTheFileHasItsSentence) {
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"frames", "", "the file has no key 'frames'"},
        {"frames", "{}", "the key 'frames' is not an array"},
        {"frames", "3", "the key 'frames' is not an array"},
        {"frames", "[]", "holds no camera"},
        {"frames", "[3]", "frame 0 is not an object with the keys transform_matrix"},
        {"frames", "[[]]", "frame 0 is not an object"},
        {"frames", "[{}]", "frame 0 has no key 'transform_matrix'"},
        {"w", "", "frame 0 has no image size; w and h are needed"},
        {"h", "", "frame 0 has no image size"},
        {"fl_x", "", "frame 0 has no focal length; fl_x or camera_angle_x is needed"},
        {"w", "0", "the file has a w of 0; allowed are integers from 1 to 65536"},
        {"h", "48.5", "the file has a h of 48.5"},
        {"w", "1e300", "a w of 1e+300"},
        {"w", "\"64\"", "a w that is not a number"},
        {"fl_x", "-1", "a focal length fl_x of -1"},
        {"fl_y", "1e10", "a focal length fl_y of 10000000000"},
        {"camera_angle_x", "0", "a camera_angle_x of 0; allowed are angles in radians"},
        {"camera_angle_y", "3.2", "a camera_angle_y of 3.2"},
        {"camera_angle_x", "[]", "a camera_angle_x that is not a number"},
        {"cx", "null", "a cx that is not a number"},
        {"k1", "\"a\"", "a k1 that is not a number"},
        {"camera_model", "7", "a key 'camera_model' that is not a text"},
        {"camera_model", "\"EQUIRECTANGULAR\"", "which is not known; allowed are PINHOLE"},
        {"applied_transform", "3", "not an array of 3 or 4 rows of 4 numbers"},
        {"applied_transform", "[[1,0,0],[0,1,0],[0,0,1]]",
         "applied_transform[0] that is not an array of 4"},
        {"applied_transform", "[[1,0,0,0],[0,1,0,0],[0,0,-1,0]]", "cannot be undone"},
        {"applied_transform", "[[0,0,0,0],[0,0,0,0],[0,0,0,0]]", "cannot be undone"},
        {"applied_transform", "[[1,0,0,0],[0,2,0,0],[0,0,1,0]]", "orthogonal"},
        {"applied_transform", "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,1]]",
         "last row is not 0 0 0 1"},
    };
    for (const auto& [key, value, sentence] : cases) {
        EXPECT_THAT(complaint_about_transforms(transforms_with(key, value)),
                    IsSentenceWith(sentence));
    }
}

TEST(HostileTransforms, EveryMistakeOfAFrameHasItsSentence) {
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"transform_matrix", "", "has no key 'transform_matrix'; needed are transform_matrix"},
        {"transform_matrix", "[1,2]", "not an array of 3 or 4 rows"},
        {"transform_matrix", "[[1,0,0,0],[0,1,0,0]]", "not an array of 3 or 4 rows"},
        {"transform_matrix", "[[1,0,0,0],[0,1,0],[0,0,1,0]]", "transform_matrix[1] that is not"},
        {"transform_matrix", "[[1,0,0,0],[0,1,0,{}],[0,0,1,0]]",
         "transform_matrix[1][3] that is not a number"},
        {"transform_matrix", "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]", "last row"},
        {"transform_matrix", "[[2,0,0,0],[0,2,0,0],[0,0,2,0]]", "orthogonal unit vectors"},
        {"transform_matrix", "[[1,0,0,0],[0,1,0,0],[0,0,-1,0]]", "mirrors"},
        {"file_path", "3", "a key 'file_path' that is not a text"},
        {"w", "65537", "a w of 65537"},
        {"fl_x", "0", "a focal length fl_x of 0"},
        {"camera_model", "\"x\"", "a camera_model 'x'"},
    };
    for (const auto& [key, value, sentence] : cases) {
        const std::string found = complaint_about_transforms(transforms_with("", "", key, value));
        EXPECT_THAT(found, IsSentenceWith(sentence));
        EXPECT_THAT(found, IsSentenceWith("frame 0 "));
    }
    EXPECT_THAT(
        complaint_about_transforms(R"({"w":1,"h":1,"fl_x":1,"frames":[{"transform_matrix":)" +
                                   std::string(kPose) + "},{}]}"),
        IsSentenceWith("frame 1 has no key"));
}

TEST(HostileTransforms, ShapesAndLimits) {
    const std::string frame = R"({"transform_matrix":)" + std::string(kPose) + "}";
    const std::string many(300, '0');
    std::string keys;
    for (int i = 0; i < 300; ++i) {
        keys += "\"k_" + std::to_string(i) + "\":0,";
    }
    const std::pair<std::string, const char*> cases[] = {
        {"{", "not valid JSON"},
        {"{\"frames\":[" + frame, "not valid JSON"},
        {"{\"w\":1e999}", "out of range"},
        {"{\"frames\":[" + frame + "],\"frames\":[]}", "the key 'frames' twice"},
        {"{\"w\":1,\"w\":2}", "the key 'w' twice"},
        {"{\"frames\":[{\"file_path\":\"\",\"file_path\":\"\"}]}",
         "frame 0 has the key 'file_path' twice"},
        {"{" + keys + "\"w\":1}", "more than 256 keys"},
        {"{\"frames\":[{" + keys + "\"w\":1}]}", "more than 256 keys"},
        {"{\"w\":[[[1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22]]]}",
         "more values in its 'w'"},
        {"{\"x\":" + std::string(100, '[') + std::string(100, ']') + "}", "64 deep"},
    };
    for (const auto& [text, sentence] : cases) {
        EXPECT_THAT(complaint_about_transforms(text), IsSentenceWith(sentence));
    }
}

} // namespace
} // namespace degs
