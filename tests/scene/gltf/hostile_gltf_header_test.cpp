// SPDX-License-Identifier: Apache-2.0
// What a glTF says of itself and of where its buffers lie.
#include <utility>

#include "tests/scene/gltf/glb_builder.hpp"

namespace degs {
namespace {

using test::Glb;
using test::IsSentenceWith;
using test::two_splats;

std::string with_asset(const nlohmann::json& asset) {
    Glb glb = two_splats();
    glb.json["asset"] = asset;
    return test::complaint_about(glb);
}

TEST(HostileGltfHeader, VersionsBeyondThisReader) {
    EXPECT_EQ(with_asset({{"version", "2.0"}, {"minVersion", "2.0"}}), "");
    EXPECT_EQ(with_asset({{"version", "2.1"}, {"minVersion", "2.0"}}), "");
    EXPECT_EQ(with_asset({{"version", "2.7"}}), "");
    for (const char* const least :
         {"2.1", "2.10", "3.0", "10.0", "2", "2.", "two", "-2.0", "2.0 "}) {
        EXPECT_THAT(with_asset({{"version", "2.1"}, {"minVersion", least}}),
                    IsSentenceWith("version 2.0 is read"))
            << least;
    }
    for (const char* const version : {"1.0", "3.0", "20.0", "2", "2.x", "2.0.1", "", "-2.0"}) {
        EXPECT_THAT(with_asset({{"version", version}}), IsSentenceWith("version 2 is read"))
            << version;
    }
    EXPECT_THAT(with_asset({{"generator", "x"}}), IsSentenceWith("no asset with a version"));
    EXPECT_THAT(with_asset({{"version", 2.0}}), IsSentenceWith("no asset with a version"));
}

std::string with_uri(const std::string& uri) {
    Glb glb = two_splats();
    glb.json["buffers"].push_back({{"byteLength", 4}, {"uri", uri}});
    const test::Folder folder;
    folder.write("data.bin", "12345678");
    const std::string path = folder.write("scene.glb", glb.bytes());
    return test::complaint([&] { read_gltf(path); });
}

TEST(HostileGltfHeader, UrisHoldNoControlCharacters) {
    EXPECT_EQ(with_uri("data.bin"), "");
    for (const char* const uri : {"data.bin%00", "data.bin%00.txt", "%00data.bin", "data.bin%0a",
                                  "data%09.bin", "data.bin%7F", "data.bin\n", "\x1b[2Jdata.bin"}) {
        EXPECT_THAT(with_uri(uri), IsSentenceWith("a name with a control character"));
    }
    EXPECT_THAT(with_uri(std::string("data.bin\0", 9)), IsSentenceWith("control character"));
}

TEST(HostileGltfHeader, DataUrisOfOtherTypesAreNamed) {
    EXPECT_EQ(with_uri("data:application/octet-stream;base64,MTIzNA=="), "");
    EXPECT_EQ(with_uri("data:application/gltf-buffer;base64,MTIzNA=="), "");
    for (const char* const type :
         {"application/binary;base64", "application/octet-stream", "", ";base64",
          "image/png;base64", "application/octet-stream;charset=x;base64"}) {
        EXPECT_THAT(with_uri("data:" + std::string(type) + ",MTIzNA=="),
                    IsSentenceWith("is a data URI of the type '" + std::string(type) + "'"));
    }
    EXPECT_THAT(with_uri("DATA:application/binary;base64,MTIz"), IsSentenceWith("is a data URI"));
    EXPECT_THAT(with_uri("data:"), IsSentenceWith("is a data URI"));
}

TEST(HostileGltfHeader, BinChunksHoldNoMoreThanTheirBuffer) {
    for (const auto& [shorter, good] :
         {std::pair(0, true), std::pair(3, true), std::pair(4, false), std::pair(8, false)}) {
        Glb glb = two_splats();
        glb.bin.resize(glb.bin.size() + 4); // the views end before
        glb.json["buffers"][0]["byteLength"] = glb.bin.size() - shorter;
        EXPECT_THAT(test::complaint_about(glb), good ? testing::Eq("")
                                                     : testing::Matcher<std::string>(IsSentenceWith(
                                                           "at most 3 bytes may be left over")));
    }
}

} // namespace
} // namespace degs
