// SPDX-License-Identifier: Apache-2.0
#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::read_cameras_of;

const char* const kIdentity = "[[1,0,0],[0,1,0],[0,0,1]]";

/// A camera file with one good entry whose key `key` has the JSON text `value`; empty removes it.
std::string file_with(const std::string& key, const std::string& value) {
    std::string out = "[{";
    const std::pair<const char*, const char*> entries[] = {
        {"id", "3"},    {"img_name", "\"a\""}, {"width", "64"},         {"height", "48"},
        {"fx", "50.5"}, {"fy", "51"},          {"position", "[1,2,3]"}, {"rotation", kIdentity},
    };
    bool first = true;
    for (const auto& [name, text] : entries) {
        const std::string chosen = name == key ? value : text;
        if (!chosen.empty()) {
            out += (first ? "\"" : ",\"") + std::string(name) + "\":" + chosen;
            first = false;
        }
    }
    return out + "}]";
}

std::string complaint_about_cameras(const std::string& text) {
    const test::Folder folder;
    const std::string path = folder.write("cameras.json", text);
    std::string sentence = test::complaint([&] { read_cameras_of(path); });
    EXPECT_EQ(sentence.rfind(path + ": ", 0), 0U) << sentence;
    return sentence;
}

TEST(HostileCameras, EveryMistakeHasItsSentence) {
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"width", "", "has no key 'width'"},
        {"position", "", "has no key 'position'"},
        {"rotation", "", "has no key 'rotation'"},
        {"fy", "", "has no key 'fy'"},
        {"width", "0", "width of 0; allowed are integers from 1 to 65536"},
        {"height", "-48", "height of -48"},
        {"width", "65537", "width of 65537"},
        {"width", "64.5", "width of 64.5"},
        {"width", "1e300", "width of 1e+300"},
        {"width", "\"64\"", "width that is not a number"},
        {"height", "null", "height that is not a number"},
        {"id", "1e10", "id of 10000000000"},
        {"fx", "0", "focal length fx of 0"},
        {"fx", "-3", "focal length fx of -3"},
        {"fy", "1e12", "focal length fy of 1000000000000"},
        {"fy", "[1]", "fy that is not a number"},
        {"img_name", "7", "'img_name' that is not a text"},
        {"position", "[1,2]", "position that is not an array of 3"},
        {"position", "{}", "position that is not an array of 3"},
        {"position", "[1,2,\"x\"]", "position[2] that is not a number"},
        {"rotation", "[[1,0,0],[0,1,0]]", "3 rows"},
        {"rotation", "[1,0,0]", "rotation[0] that is not an array"},
        {"rotation", "[[1,0,0],[0,true,0],[0,0,1]]", "rotation[1][1] that is not a number"},
        {"rotation", "[[1,0,0],[0,1.001,0],[0,0,1]]", "orthogonal"},
        {"rotation", "[[1,0.002,0],[0,1,0],[0,0,1]]", "orthogonal"},
        {"rotation", "[[0,0,0],[0,0,0],[0,0,0]]", "orthogonal"},
        {"rotation", "[[1e200,0,0],[0,1,0],[0,0,1]]", "orthogonal"},
        {"rotation", "[[1,0,0],[0,1,0],[0,0,-1]]", "mirrors"},
    };
    for (const auto& [key, value, sentence] : cases) {
        EXPECT_THAT(complaint_about_cameras(file_with(key, value)), IsSentenceWith(sentence));
        EXPECT_THAT(complaint_about_cameras(file_with(key, value)), IsSentenceWith("camera 0"));
    }
}

TEST(HostileCameras, FilesThatAreNoCameraFiles) {
    const std::pair<std::string, const char*> cases[] = {
        {"{}", "the file has no key 'frames'"},
        {"3", "this is a single number"},
        {"[]", "holds no camera"},
        {"[3]", "camera 0 is not an object"},
        {"[", "not valid JSON"},
        {"[{]", "not valid JSON (at byte 3)"},
        {"[{\"width\": NaN}]", "not valid JSON"},
        {"\x01\xff", "not valid JSON"},
        {"[1e999]", "out of range"},
        {std::string(200000, '['), "camera 0 is not an object"},
        {file_with("width", "64") + "x", "not valid JSON"},
    };
    for (const auto& [text, sentence] : cases) {
        EXPECT_THAT(complaint_about_cameras(text), IsSentenceWith(sentence));
    }
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_THAT(complaint_about_cameras(deep), IsSentenceWith("camera 0 is not an object"));
    EXPECT_THAT(complaint_about_cameras(""), IsSentenceWith("empty"));
    EXPECT_THAT(test::complaint([] { read_cameras_of("/no/such/cameras.json"); }),
                IsSentenceWith("/no/such/cameras.json: there is no such file"));
}

TEST(HostileCameras, KeysOccurOnce) {
    for (const char* key : {"width", "img_name", "rotation"}) {
        std::string text = file_with("id", "3");
        const std::string again = std::string(",\"") + key + "\":64";
        text.insert(text.size() - 2, again);
        EXPECT_THAT(complaint_about_cameras(text),
                    IsSentenceWith("camera 0 has the key '" + std::string(key) + "' twice"));
    }
    // Also keys that nobody reads: one of the two is a mistake.
    std::string unknown = file_with("id", "3");
    unknown.insert(unknown.size() - 2, R"(,"lens":{"a":1},"lens":[{"a":1}])");
    EXPECT_THAT(complaint_about_cameras(unknown), IsSentenceWith("the key 'lens' twice"));
}

TEST(HostileCameras, WhatIsNotNeededIsSkippedWithinLimits) {
    const test::Folder folder;
    const auto with = [](const std::string& value) {
        std::string text = file_with("id", "3");
        return text.insert(text.size() - 2, R"(,"extra":)" + value);
    };
    const std::string odd = R"({"width":[1,2],"x":{"width":{}},"y":[[{"id":"no"}],null]})";
    const std::vector<Camera> cameras = read_cameras_of(folder.write("c.json", with(odd)));
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].width, 64);
    EXPECT_EQ(cameras[0].id, 3);
    const auto nested = [](int levels) {
        return std::string(levels, '[') + std::string(levels, ']');
    };
    EXPECT_EQ(read_cameras_of(folder.write("d.json", with(nested(60)))).size(), 1U);
    EXPECT_THAT(complaint_about_cameras(with(nested(100))), IsSentenceWith("64 deep"));
    std::string keys;
    for (int i = 0; i < 300; ++i) {
        keys += ",\"k" + std::to_string(i) + "\":0";
    }
    EXPECT_THAT(complaint_about_cameras(with("0" + keys)), IsSentenceWith("more than 256 keys"));
    EXPECT_THAT(complaint_about_cameras(file_with("fx", "[[[1,2,3],[4,5,6],[7,8,9],[0,0]]]")),
                IsSentenceWith("more values in its 'fx'"));
    EXPECT_THAT(complaint_about_cameras("[{},{},1]"), IsSentenceWith("camera 0 has no key"));
}

TEST(HostileCameras, NameTheEntry) {
    std::string two = file_with("width", "64");
    two.pop_back();
    two += "," + file_with("fx", "0").substr(1);
    EXPECT_THAT(complaint_about_cameras(two), IsSentenceWith("camera 1 "));
}

} // namespace
} // namespace degs
