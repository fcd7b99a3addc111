// SPDX-License-Identifier: Apache-2.0
// Sparse accessors: what they replace, and every way in which they can be wrong.
#include <functional>

#include "tests/scene/gltf/glb_builder.hpp"

namespace degs {
namespace {

using test::Glb;
using test::two_splats;
using SparseJson = nlohmann::json;

/// The buffer view of values that no accessor names.
template <class Value>
int view_of(Glb& glb, const std::vector<Value>& values) {
    glb.add(values, 5121, "SCALAR");
    glb.json["accessors"].erase(glb.json["accessors"].size() - 1);
    return static_cast<int>(glb.json["bufferViews"].size()) - 1;
}

SparseJson sparse(int count, int indices, int index_type, int values) {
    return {{"count", count},
            {"indices", {{"bufferView", indices}, {"componentType", index_type}}},
            {"values", {{"bufferView", values}}}};
}

/// The scales of the second splat are replaced.
Glb sparse_scale() {
    Glb glb = two_splats();
    const int indices = view_of(glb, std::vector<std::uint8_t>{1, 0, 0, 0});
    const int values = view_of(glb, std::vector<float>{7, 8, 9});
    glb.json["accessors"][glb.attribute("SCALE").get<int>()]["sparse"] =
        sparse(1, indices, 5121, values);
    return glb;
}

TEST(GltfSparse, ReplacesElementsOfTheView) {
    const GaussianCloud cloud = test::read(sparse_scale()).cloud;
    EXPECT_EQ(cloud.scales[0], glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(cloud.scales[1], glm::vec3(7, 8, 9));
}

TEST(GltfSparse, IndicesHaveThreeTypesAndOffsets) {
    const auto opacities_with = [](const auto& indices, int type) {
        Glb glb = two_splats();
        const int at = view_of(glb, indices);
        const int values = view_of(glb, std::vector<float>{99, 0.5F, 0.125F});
        SparseJson both = sparse(2, at, type, values);
        both["indices"]["byteOffset"] = sizeof indices[0];
        both["values"]["byteOffset"] = 4;
        glb.json["accessors"][glb.attribute("OPACITY").get<int>()]["sparse"] = both;
        return test::read(glb).cloud.opacities;
    };
    const std::vector<float> wanted{0.5F, 0.125F};
    EXPECT_EQ(opacities_with(std::vector<std::uint8_t>{9, 0, 1}, 5121), wanted);
    EXPECT_EQ(opacities_with(std::vector<std::uint16_t>{9, 0, 1}, 5123), wanted);
    EXPECT_EQ(opacities_with(std::vector<std::uint32_t>{9, 0, 1}, 5125), wanted);
}

/// Without a view all other elements are 0; normalised integers are converted as elsewhere.
TEST(GltfSparse, WithoutAViewTheRestIsZero) {
    Glb glb = two_splats();
    const int indices = view_of(glb, std::vector<std::uint8_t>{1, 0, 0, 0});
    const int values = view_of(glb, std::vector<std::uint8_t>{51, 0, 0, 0});
    SparseJson& opacity = glb.json["accessors"][glb.attribute("OPACITY").get<int>()];
    opacity.erase("bufferView");
    opacity["componentType"] = 5121;
    opacity["normalized"] = true;
    opacity["sparse"] = sparse(1, indices, 5121, values);
    EXPECT_EQ(test::read(glb).cloud.opacities, (std::vector<float>{0, 0.2F}));
}

/// Else a file of a few bytes could ask for memory for billions of splats.
TEST(GltfSparse, PositionsNeedAView) {
    Glb glb = two_splats();
    const int indices = view_of(glb, std::vector<std::uint8_t>{1, 0, 0, 0});
    const int values = view_of(glb, std::vector<float>{7, 8, 9});
    for (auto& accessor : glb.json["accessors"]) {
        accessor["count"] = 4000000000U;
        accessor.erase("bufferView");
        accessor["sparse"] = sparse(1, indices, 5121, values);
    }
    EXPECT_THAT(test::complaint_about(glb), test::IsSentenceWith("POSITION has no buffer view"));
}

struct SparseMistake {
    const char* name;
    std::function<void(SparseJson& sparse, SparseJson& file)> make;
    const char* words;
};

void PrintTo(const SparseMistake& mistake, std::ostream* out) {
    *out << mistake.name;
}

class HostileGltfSparse : public testing::TestWithParam<SparseMistake> {};

TEST_P(HostileGltfSparse, IsNamed) {
    Glb glb = sparse_scale();
    SparseJson& accessor = glb.json["accessors"][glb.attribute("SCALE").get<int>()];
    GetParam().make(accessor["sparse"], glb.json);
    EXPECT_THAT(test::complaint_about(glb), test::IsSentenceWith(GetParam().words));
}
INSTANTIATE_TEST_SUITE_P(
    Mistakes, HostileGltfSparse,
    testing::Values(
        SparseMistake{"NegativeCount", [](SparseJson& s, SparseJson&) { s["count"] = -7; },
                      "SCALE is sparse and replaces -7 of its 2 elements"},
        SparseMistake{"NoCount", [](SparseJson& s, SparseJson&) { s["count"] = 0; },
                      "SCALE is sparse and replaces 0 of its 2 elements"},
        SparseMistake{"MoreThanThereAre", [](SparseJson& s, SparseJson&) { s["count"] = 3; },
                      "SCALE is sparse and replaces 3 of its 2 elements"},
        SparseMistake{"NotIncreasing",
                      [](SparseJson& s, SparseJson&) {
                          s["count"] = 2;
                          s["values"]["bufferView"] = 0;
                      },
                      "must increase and be below 2; number 1 is 0."},
        SparseMistake{"Repeated",
                      [](SparseJson& s, SparseJson&) { // the zeros behind the 1
                          s["count"] = 2;
                          s["indices"]["byteOffset"] = 1;
                          s["values"]["bufferView"] = 0;
                      },
                      "must increase and be below 2; number 1 is 0."},
        SparseMistake{
            "BeyondTheCount",
            [](SparseJson& s, SparseJson&) { // the third byte of 1.0
                s["indices"] = {{"bufferView", 0}, {"byteOffset", 2}, {"componentType", 5121}};
            },
            "must increase and be below 2; number 0 is 128."},
        SparseMistake{"NoSuchIndices",
                      [](SparseJson& s, SparseJson&) { s["indices"]["bufferView"] = 77; },
                      "its sparse indices names buffer view 77"},
        SparseMistake{"NoSuchValues",
                      [](SparseJson& s, SparseJson&) { s["values"]["bufferView"] = -1; },
                      "its sparse values names buffer view -1"},
        SparseMistake{"IndicesOfFloats",
                      [](SparseJson& s, SparseJson&) { s["indices"]["componentType"] = 5126; },
                      "its sparse indices have components of type 5126"},
        SparseMistake{"IndicesBeyondTheView",
                      [](SparseJson& s, SparseJson&) { s["indices"]["byteOffset"] = 4; },
                      "its sparse indices reach beyond their buffer view of 4 bytes"},
        SparseMistake{"ValuesBeyondTheView",
                      [](SparseJson& s, SparseJson&) { s["values"]["byteOffset"] = 4; },
                      "its sparse values reach beyond their buffer view of 12 bytes"},
        SparseMistake{"OffsetOf32Bits",
                      [](SparseJson& s, SparseJson&) { s["values"]["byteOffset"] = 4294967292U; },
                      "its sparse values reach beyond their buffer view of 12 bytes"},
        SparseMistake{"UnalignedValues",
                      [](SparseJson& s, SparseJson&) {
                          s["values"] = {{"bufferView", 0}, {"byteOffset", 2}};
                      },
                      "must be packed, without a stride, and start at a multiple of 4 bytes"},
        SparseMistake{"Stride",
                      [](SparseJson& s, SparseJson& file) {
                          file["bufferViews"][s["values"]["bufferView"].get<int>()]["byteStride"] =
                              16;
                      },
                      "must be packed, without a stride"},
        SparseMistake{"NoValues", [](SparseJson& s, SparseJson&) { s.erase("values"); },
                      "the glTF library refuses the file"}),
    [](const auto& mistake) { return mistake.param.name; });

} // namespace
} // namespace degs
