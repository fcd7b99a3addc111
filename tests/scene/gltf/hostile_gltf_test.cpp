// SPDX-License-Identifier: Apache-2.0
// Broken and malicious glTF: one sentence each, and no byte read outside the file. The rows of the
// first table are what tinygltf 2.7.0 lets through.
#include <random>

#include "tests/scene/gltf/glb_builder.hpp"

namespace degs {
namespace {

using test::Glb;
using test::IsSentenceWith;
using test::two_splats;

struct Damage {
    const char* name;
    void (*apply)(nlohmann::json& json);
    const char* sentence; ///< part of what the reader says
};

void PrintTo(const Damage& damage, std::ostream* out) {
    *out << damage.name;
}

using Json = nlohmann::json;

Json& attributes(Json& json) {
    return json["meshes"][0]["primitives"][0]["attributes"];
}

const Damage kDamages[] = {
    {"AttributeOutOfRange", [](Json& j) { attributes(j)["POSITION"] = 99; },
     "POSITION names accessor 99, and the file has 5."},
    {"AttributeNegative", [](Json& j) { attributes(j)["POSITION"] = -1; },
     "POSITION names accessor -1"},
    {"IntegerOf33Bits", [](Json& j) { attributes(j)["POSITION"] = 4294967296; },
     "the integer 4294967296 in 'POSITION', which has more than 32 bits."},
    {"IntegerBelow32Bits", [](Json& j) { j["nodes"][0]["mesh"] = -4294967296; },
     "the integer -4294967296 in 'mesh'"},
    {"AttributeString", [](Json& j) { attributes(j)["POSITION"] = "0"; },
     "the glTF library refuses the file"},
    {"AttributeFraction", [](Json& j) { attributes(j)["POSITION"] = 0.0; },
     "the glTF library refuses the file"},
    {"AttributesMissing", [](Json& j) { j["meshes"][0]["primitives"][0].erase("attributes"); },
     "the glTF library refuses the file"},
    {"ViewOutOfRange", [](Json& j) { j["accessors"][0]["bufferView"] = 5; },
     "POSITION names buffer view 5, and the file has 5."},
    {"ViewAbsent", [](Json& j) { j["accessors"][0].erase("bufferView"); },
     "POSITION has no buffer view"},
    {"BufferOutOfRange", [](Json& j) { j["bufferViews"][0]["buffer"] = 1; },
     "buffer view 0 names buffer 1, and the file has 1."},
    {"BufferNegative", [](Json& j) { j["bufferViews"][0]["buffer"] = -1; },
     "buffer view 0 names buffer -1"},
    {"ViewBeyondBuffer", [](Json& j) { j["bufferViews"][4]["byteLength"] = 1000; },
     "buffer view 4 reaches beyond its buffer of 112 bytes"},
    {"ViewOffsetBeyondBuffer", [](Json& j) { j["bufferViews"][0]["byteOffset"] = 4294967292; },
     "buffer view 0 reaches beyond its buffer"},
    {"AccessorBeyondView", [](Json& j) { j["accessors"][0]["count"] = 3; },
     "POSITION reaches beyond its buffer view of 24 bytes"},
    {"AccessorOffsetBeyondView", [](Json& j) { j["accessors"][0]["byteOffset"] = 28; },
     "POSITION reaches beyond its buffer view"},
    {"CountOf64Bits", [](Json& j) { j["accessors"][0]["count"] = 18446744073709551615U; },
     "which has more than 32 bits."},
    {"CountOf32Bits", [](Json& j) { j["accessors"][0]["count"] = 4294967295; },
     "POSITION reaches beyond its buffer view"},
    {"CountZero", [](Json& j) { j["accessors"][0]["count"] = 0; }, "POSITION has no elements"},
    {"ComponentTypeUnknown", [](Json& j) { j["accessors"][0]["componentType"] = 5127; },
     "POSITION has components of type 5127"},
    {"ComponentTypeDouble", [](Json& j) { j["accessors"][0]["componentType"] = 5130; },
     "POSITION has components of type 5130"},
    {"StrideOdd", [](Json& j) { j["bufferViews"][0]["byteStride"] = 13; },
     "the glTF library refuses the file"},
    {"StrideBelowElement", [](Json& j) { j["bufferViews"][0]["byteStride"] = 4; },
     "they may not overlap"},
    {"OffsetUnaligned", [](Json& j) { j["accessors"][3]["byteOffset"] = 2; },
     "components of 4 bytes start at multiples of that."},
    {"Sparse",
     [](Json& j) {
         j["accessors"][0]["sparse"] = {{"count", -7},
                                        {"indices", {{"bufferView", 77}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", 88}}}};
     },
     "POSITION is sparse and replaces -7 of its 2 elements"},
    {"BufferEmpty", [](Json& j) { j["buffers"][0]["byteLength"] = 0; },
     "buffer 0 has a byteLength of 0"},
    {"BufferBeyondChunk", [](Json& j) { j["buffers"][0]["byteLength"] = 120; },
     "the glTF library refuses the file: Invalid `byteLength'"},
    {"TwoBuffersInTheChunk",
     [](Json& j) {
         j["buffers"].push_back({{"byteLength", 4}});
     },
     "buffer 1 has no uri; only the first buffer of a GLB needs none."},
    {"BuffersBeyond4GiB",
     [](Json& j) {
         const Json large = {{"byteLength", 4294967295}, {"uri", "data:,"}};
         j["buffers"].push_back(large);
     },
     "all buffers together may have 4294967295 bytes."},
    {"Version", [](Json& j) { j["asset"]["version"] = "9.9"; }, "a glTF of version '9.9'"},
    {"MinVersion", [](Json& j) { j["asset"]["minVersion"] = "3.0"; }, "glTF of version '3.0'"},
    {"RequiredExtension", [](Json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; },
     "requires the extension 'KHR_draco_mesh_compression', which is not read."},
    {"MatrixOfThree",
     [](Json& j) {
         j["nodes"][0]["matrix"] = {1, 2, 3};
     },
     "node 0 'show' has a matrix of 3 numbers; 16 are needed."},
    {"RotationOfThree",
     [](Json& j) {
         j["nodes"][0]["rotation"] = {0, 0, 1};
     },
     "has a rotation of 3 numbers; 4 are needed."},
    {"ScaleOfFour",
     [](Json& j) {
         j["nodes"][0]["scale"] = {1, 1, 1, 1};
     },
     "has a scale of 4 numbers; 3 are needed."},
    {"TranslationOfTwo",
     [](Json& j) {
         j["nodes"][0]["translation"] = {1, 2};
     },
     "has a translation of 2 numbers; 3 are needed."},
    {"RotationZero",
     [](Json& j) {
         j["nodes"][0]["rotation"] = {0, 0, 0, 0};
     },
     "a quaternion of length 1 is needed."},
    {"MatrixNotAffine",
     [](Json& j) { j["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0, 0, 1}; },
     "has a matrix whose last row is not 0 0 0 1."},
    {"Mirrored",
     [](Json& j) {
         j["nodes"][0]["scale"] = {-1, 1, 1};
     },
     "node 0 'show' has a transform that mirrors"},
    {"Sheared",
     [](Json& j) { j["nodes"][0]["matrix"] = {1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; },
     "node 0 'show' has a transform that shears"},
    {"Singular",
     [](Json& j) {
         j["nodes"][0]["scale"] = {1, 0, 1};
     },
     "node 0 'show' has a transform that is singular"},
    {"ChildOutOfRange", [](Json& j) { j["nodes"][0]["children"] = {55}; },
     "node 0 'show' names node 55, and the file has 1."},
    {"NodeOutOfRange", [](Json& j) { j["scenes"][0]["nodes"] = {-3}; },
     "scene 0 names node -3, and the file has 1."},
    {"SceneOutOfRange", [](Json& j) { j["scene"] = 4; },
     "the default scene is 4, and the file has 1."},
    {"MeshOutOfRange", [](Json& j) { j["nodes"][0]["mesh"] = 3; },
     "names mesh 3, and the file has 1."},
    {"NodeCycle", [](Json& j) { j["nodes"][0]["children"] = {0}; },
     "node 0 'show' is reached twice"},
    {"NoScene",
     [](Json& j) {
         j.erase("meshes");
         j.erase("nodes");
         j.erase("scenes");
         j.erase("scene");
     },
     "the glTF has no splats"},
    {"NoSplats", [](Json& j) { j["meshes"][0]["primitives"][0].erase("extensions"); },
     "the glTF has no splats"},
    {"NotShown", [](Json& j) { j["nodes"][0].erase("mesh"); }, "no node of the scene shows"},
    {"Triangles", [](Json& j) { j["meshes"][0]["primitives"][0].erase("mode"); },
     "has splats and mode 4; mode 0 (POINTS) is needed."},
    {"Indices", [](Json& j) { j["meshes"][0]["primitives"][0]["indices"] = 0; },
     "which splats may not have."},
    {"Counts", [](Json& j) { j["accessors"][3]["count"] = 1; },
     "OPACITY has 1 elements, and POSITION has 2."},
    {"Type", [](Json& j) { j["accessors"][3]["type"] = "VEC2"; },
     "OPACITY has elements of another type than SCALAR."},
    {"NoRotation", [](Json& j) { attributes(j).erase("KHR_gaussian_splatting:ROTATION"); },
     "has no attribute 'KHR_gaussian_splatting:ROTATION', which splats need."},
    {"NoPosition", [](Json& j) { attributes(j).erase("POSITION"); },
     "has no attribute 'POSITION', which splats need."},
    {"Compression",
     [](Json& j) {
         j["meshes"][0]["primitives"][0]["extensions"]["KHR_gaussian_splatting"]["extensions"]
          ["EXT_other"] = {{"level", 1}};
     },
     "has splats with the extension 'EXT_other', which is not read."},
    {"SpzOutOfRange",
     [](Json& j) {
         j["meshes"][0]["primitives"][0]["extensions"]["KHR_gaussian_splatting"]["extensions"]
          ["KHR_gaussian_splatting_compression_spz_2"] = {{"bufferView", 12}};
     },
     "its SPZ data names buffer view 12, and the file has 5."},
    {"SpzNothing",
     [](Json& j) {
         j["meshes"][0]["primitives"][0]["extensions"]["KHR_gaussian_splatting"]["extensions"]
          ["KHR_gaussian_splatting_compression_spz_2"] = {{"bufferView", 0}};
     },
     "its SPZ data"},
    {"InstancesNowhere",
     [](Json& j) {
         j["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {
             {"attributes", {{"TRANSLATION", 44}}}};
     },
     "TRANSLATION of its instances names accessor 44"},
    {"OutsideTheFolder",
     [](Json& j) {
         j["buffers"].push_back({{"byteLength", 4}, {"uri", "../secret.bin"}});
     },
     "only files in the folder of the scene are read."},
    {"OutsideByEscapes",
     [](Json& j) {
         j["buffers"].push_back({{"byteLength", 4}, {"uri", "%2e%2e%2fsecret.bin"}});
     },
     "only files in the folder of the scene are read."},
    {"AbsoluteFile",
     [](Json& j) {
         j["buffers"].push_back({{"byteLength", 4}, {"uri", "/etc/hostname"}});
     },
     "only files in the folder of the scene are read."},
    {"MissingFile",
     [](Json& j) {
         j["buffers"].push_back({{"byteLength", 4}, {"uri", "none.bin"}});
     },
     "there is no such file."},
    {"ItselfTooShort",
     [](Json& j) {
         j["buffers"].push_back({{"byteLength", 100000}, {"uri", "scene.glb"}});
     },
     "its byteLength is 100000."},
};

class HostileGltf : public testing::TestWithParam<Damage> {};

TEST_P(HostileGltf, IsRefusedInOneSentence) {
    Glb glb = two_splats();
    GetParam().apply(glb.json);
    EXPECT_THAT(test::complaint_about(glb), IsSentenceWith(GetParam().sentence));
}
INSTANTIATE_TEST_SUITE_P(Table, HostileGltf, testing::ValuesIn(kDamages),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(HostileGlb, ChunksAreChecked) {
    const std::string good = two_splats().bytes();
    const auto changed = [&](std::size_t at, std::uint64_t value) {
        return test::complaint_about(std::string(good).replace(at, 4, test::four_bytes(value)));
    };
    const std::size_t json_bytes =
        static_cast<unsigned char>(good[12]) + 256 * static_cast<unsigned char>(good[13]);
    const std::size_t bin = 20 + json_bytes;
    EXPECT_EQ(test::complaint_about(good), "");
    EXPECT_THAT(changed(4, 1), IsSentenceWith("a GLB of version 1"));
    EXPECT_THAT(changed(8, good.size() + 4), IsSentenceWith("says that the file has"));
    EXPECT_THAT(changed(8, 16), IsSentenceWith("says that the file has 16 bytes"));
    EXPECT_THAT(changed(12, json_bytes + 2), IsSentenceWith("a multiple of 4 is needed."));
    EXPECT_THAT(changed(12, 0xFFFFFFF0), IsSentenceWith("chunk 0 of the GLB says that it has"));
    EXPECT_THAT(changed(16, 7), IsSentenceWith("the first chunk of the GLB is not JSON."));
    // The library reads up to 8 bytes too many here.
    EXPECT_THAT(changed(bin, 116), IsSentenceWith("chunk 1 of the GLB says that it has 116 bytes"));
    EXPECT_THAT(changed(bin, 120), IsSentenceWith("chunk 1 of the GLB says that it has 120 bytes"));
    EXPECT_THAT(changed(bin, 108), IsSentenceWith("chunk 2 of the GLB is cut off"));
}

TEST(HostileGlb, JsonIsChecked) {
    const auto text = [](const std::string& json) {
        return test::complaint_about(Glb::bytes_of(json, ""));
    };
    EXPECT_THAT(text("{\"asset\":"), IsSentenceWith("is malformed at its byte"));
    EXPECT_THAT(text("[]"), IsSentenceWith("the glTF library refuses"));
    EXPECT_THAT(text("{}"), IsSentenceWith("the glTF library refuses"));
    EXPECT_THAT(text("{\"a\":1e999}"), IsSentenceWith("is malformed at its byte"));
    EXPECT_THAT(text("{\"a\":\"\xff\"}"), IsSentenceWith("is malformed at its byte"));
    const std::string deep(200000, '[');
    EXPECT_THAT(text("{\"a\":" + deep), IsSentenceWith("deeper than 64 levels."));
    std::string many = "{\"a\":[0";
    for (int i = 0; i < 300000; ++i) {
        many += ",0";
    }
    EXPECT_THAT(text(many + "]}"), IsSentenceWith("holds more than 262144 values"));
    Glb glb = two_splats();
    glb.json["extras"] = {{"id", 12345678901234567U}, {"list", {-12345678901234567}}};
    EXPECT_EQ(test::complaint_about(glb), ""); // extras belong to applications
}

TEST(HostileGlb, LinksOutOfTheFolderDoNotHelp) {
    const test::Folder folder;
    folder.write("secret.bin", "12345678");
    std::filesystem::create_directory(folder.path("scene"));
    std::filesystem::create_symlink(folder.path("secret.bin"), folder.path("scene/link.bin"));
    Glb glb = two_splats();
    glb.json["buffers"].push_back({{"byteLength", 4}, {"uri", "link.bin"}});
    const std::string path = folder.write("scene/scene.glb", glb.bytes());
    EXPECT_THAT(test::complaint([&] { read_gltf(path); }),
                IsSentenceWith("only files in the folder of the scene are read."));
}

/// 40 nodes that show a mesh of a few bytes would fill any memory if each had enough instances.
TEST(HostileGlb, InstancesAreCountedBeforeTheyAreMade) {
    Glb glb = two_splats();
    constexpr std::size_t kInstances = 3000;
    const int moves = glb.add(std::vector<float>(kInstances * 3), "VEC3");
    const std::size_t splats = 100000;
    for (int i = 0; i < 5; ++i) {
        const std::string type = glb.json["accessors"][i]["type"];
        const std::size_t width = type == "SCALAR" ? 1 : type.back() - '0';
        const int index = glb.add(std::vector<float>(splats * width, 0.5F), type);
        glb.json["accessors"][i] = glb.json["accessors"][index];
    }
    glb.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {
        {"attributes", {{"TRANSLATION", moves}}}};
    EXPECT_THAT(test::complaint_about(glb),
                IsSentenceWith("the instances of the file add up to more than"));
}

class HostileGlbMutation : public testing::TestWithParam<int> {};

/// Random bytes of the whole file, or random numbers of its JSON: it loads, or there is one
/// sentence.
TEST_P(HostileGlbMutation, LoadsOrIsRefusedInOneSentence) {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    const auto below = [&](std::size_t n) { return random() % n; };
    Glb glb = two_splats();
    glb.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    glb.json["nodes"].push_back({{"camera", 0}, {"children", Json::array()}});
    std::string bytes;
    if (GetParam() % 2 == 0) {
        bytes = glb.bytes();
        for (std::size_t i = 0; i <= below(4); ++i) {
            bytes[below(bytes.size())] = static_cast<char>(random());
        }
        bytes.resize(below(8) == 0 ? below(bytes.size()) + 1 : bytes.size());
    } else {
        Json flat = glb.json.flatten();
        const int values[] = {-1, 0, 1, 2, 3, 7, 255, 5121, 5126, 2147483647};
        for (std::size_t i = 0; i <= below(3); ++i) {
            auto member = flat.begin();
            std::advance(member, below(flat.size()));
            *member = below(4) == 0 ? Json("x") : Json(values[below(std::size(values))]);
        }
        bytes = Glb::bytes_of(flat.unflatten().dump(), glb.bin);
    }
    const std::string said = test::complaint_about(bytes);
    if (!said.empty()) {
        EXPECT_THAT(said, IsSentenceWith(""));
    }
}
INSTANTIATE_TEST_SUITE_P(Random, HostileGlbMutation, testing::Range(0, 200));

} // namespace
} // namespace degs
