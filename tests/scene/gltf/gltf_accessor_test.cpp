// SPDX-License-Identifier: Apache-2.0
// The table of component types of KHR_gaussian_splatting.
#include "tests/scene/gltf/glb_builder.hpp"

namespace degs {
namespace {

using test::Glb;
using test::two_splats;
using testing::ElementsAre;

/// An attribute whose first component of the first splat is `raw`; every other one is 0.
struct Quantised {
    const char* attribute;
    int component_type;
    bool normalized;
    int raw = 0;
    double meaning = 0;
};

void PrintTo(const Quantised& row, std::ostream* out) {
    *out << row.attribute << " " << row.component_type << (row.normalized ? " normalised " : " ")
         << row.raw;
}

/// VEC3 is padded: elements start at multiples of 4 bytes.
template <class Value>
int add_raw(Glb& glb, const Quantised& row, int width) {
    std::vector<Value> values(width == 1 ? 2 : 8);
    values[0] = static_cast<Value>(row.raw);
    const int index =
        glb.add(values, row.component_type, width == 1 ? "SCALAR" : "VEC4", row.normalized);
    if (width == 3) {
        glb.json["accessors"][index]["type"] = "VEC3";
        glb.json["bufferViews"].back()["byteStride"] = 4 * sizeof(Value);
    }
    return index;
}

int add_quantised(Glb& glb, const Quantised& row, int width) {
    switch (row.component_type) {
    case 5120:
        return add_raw<std::int8_t>(glb, row, width);
    case 5121:
        return add_raw<std::uint8_t>(glb, row, width);
    case 5122:
        return add_raw<std::int16_t>(glb, row, width);
    default:
        return add_raw<std::uint16_t>(glb, row, width);
    }
}

class GltfComponents : public testing::TestWithParam<Quantised> {};

TEST_P(GltfComponents, BecomeFloats) {
    const Quantised& row = GetParam();
    const std::string name = row.attribute;
    const auto value_of = [&](const GaussianCloud& cloud, std::size_t i) {
        return name == "ROTATION"  ? cloud.rotations[i].y // x of the file
               : name == "OPACITY" ? cloud.opacities[i]
                                   : cloud.scales[i].x;
    };
    Glb glb = two_splats();
    glb.attribute(name) = add_quantised(glb, row,
                                        name == "ROTATION"  ? 4
                                        : name == "OPACITY" ? 1
                                                            : 3);
    const GaussianCloud cloud = test::read(glb).cloud;
    EXPECT_EQ(value_of(cloud, 0), static_cast<float>(row.meaning));
    EXPECT_EQ(value_of(cloud, 1), 0);
}
INSTANTIATE_TEST_SUITE_P(Table, GltfComponents,
                         testing::Values(Quantised{"ROTATION", 5120, true, 127, 1},
                                         Quantised{"ROTATION", 5120, true, -128, -1},
                                         Quantised{"ROTATION", 5120, true, 64, 64.0 / 127},
                                         Quantised{"ROTATION", 5122, true, 32767, 1},
                                         Quantised{"ROTATION", 5122, true, -32768, -1},
                                         Quantised{"SCALE", 5121, false, 200, 200},
                                         Quantised{"SCALE", 5121, true, 51, 0.2},
                                         Quantised{"SCALE", 5123, false, 60000, 60000},
                                         Quantised{"SCALE", 5123, true, 13107, 0.2},
                                         Quantised{"OPACITY", 5121, true, 255, 1},
                                         Quantised{"OPACITY", 5121, true, 51, 0.2},
                                         Quantised{"OPACITY", 5123, true, 65535, 1}));

/// What the table does not have.
class HostileGltfComponents : public testing::TestWithParam<Quantised> {};

TEST_P(HostileGltfComponents, AreNamed) {
    const Quantised& row = GetParam();
    Glb glb = two_splats();
    const int index = glb.attribute(row.attribute);
    glb.json["accessors"][index]["componentType"] = row.component_type;
    glb.json["accessors"][index]["normalized"] = row.normalized;
    EXPECT_THAT(test::complaint_about(glb),
                test::IsSentenceWith(std::string(row.attribute) + " has components of type " +
                                     std::to_string(row.component_type)));
}
INSTANTIATE_TEST_SUITE_P(
    Table, HostileGltfComponents,
    testing::Values(Quantised{"ROTATION", 5121, true}, Quantised{"ROTATION", 5120, false},
                    Quantised{"ROTATION", 5123, true}, Quantised{"SCALE", 5120, true},
                    Quantised{"SCALE", 5122, false}, Quantised{"SCALE", 5126, true},
                    Quantised{"OPACITY", 5121, false}, Quantised{"OPACITY", 5123, false},
                    Quantised{"OPACITY", 5120, true}, Quantised{"SCALE", 5124, false},
                    Quantised{"SCALE", 5125, false}, Quantised{"SCALE", 5127, false},
                    Quantised{"SCALE", 5130, false}, Quantised{"SH_DEGREE_0_COEF_0", 5121, true}));

TEST(GltfAccessor, ReadsQuantisedPositionsWithTheirExtensionOnly) {
    Glb glb = two_splats();
    const std::vector<std::int16_t> raw{100, -200, 300, 0, 1, 2, 3, 0};
    const int index = glb.add(raw, 5122, "VEC4");
    glb.json["accessors"][index]["type"] = "VEC3";
    glb.json["bufferViews"].back()["byteStride"] = 8;
    glb.primitive()["attributes"]["POSITION"] = index;
    EXPECT_THAT(test::complaint_about(glb), test::IsSentenceWith("allowed are float."));
    glb.json["extensionsUsed"].push_back("KHR_mesh_quantization");
    EXPECT_EQ(test::read(glb).cloud.means[0], glm::dvec3(100, -200, 300));
}

TEST(GltfAccessor, FollowsStridesAndOffsets) {
    Glb glb = two_splats();
    const int positions = glb.add({9, 8, 7, 0.5F, 6, 5, 4, 0.75F}, "VEC4");
    glb.json["bufferViews"].back()["byteStride"] = 16;
    glb.json["accessors"][positions]["type"] = "VEC3";
    nlohmann::json opacities = glb.json["accessors"][positions];
    opacities["type"] = "SCALAR";
    opacities["byteOffset"] = 12;
    glb.json["accessors"].push_back(opacities);
    glb.primitive()["attributes"]["POSITION"] = positions;
    glb.attribute("OPACITY") = positions + 1;
    const GaussianCloud cloud = test::read(glb).cloud;
    EXPECT_EQ(cloud.means[1], glm::dvec3(6, 5, 4));
    EXPECT_THAT(cloud.opacities, ElementsAre(0.5F, 0.75F));
}

} // namespace
} // namespace degs
