// SPDX-License-Identifier: Apache-2.0
// GLB files of a few splats, made to be changed by tests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "scene/gltf/gltf.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs::test {

inline std::string four_bytes(std::uint64_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) {
        bytes += static_cast<char>(value >> (8 * i) & 0xFFU);
    }
    return bytes;
}

inline std::string glb_chunk(const std::string& type, std::string content, char padding) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    return four_bytes(content.size()) + type + content;
}

/// The JSON and the binary chunk of a GLB.
struct Glb {
    nlohmann::json json;
    std::string bin;

    /// Appends values as an accessor with a view of its own; returns its index.
    template <class Value>
    int add(const std::vector<Value>& values, int component_type, const std::string& type,
            bool normalized = false) {
        bin.resize((bin.size() + 3) / 4 * 4);
        const std::size_t bytes = values.size() * sizeof(Value);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes}});
        bin.append(reinterpret_cast<const char*>(values.data()), bytes);
        const int width = type == "SCALAR" ? 1 : type.back() - '0';
        nlohmann::json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                                   {"componentType", component_type},
                                   {"count", values.size() / width},
                                   {"type", type}};
        if (normalized) {
            accessor["normalized"] = true;
        }
        json["accessors"].push_back(accessor);
        json["buffers"][0]["byteLength"] = bin.size();
        return static_cast<int>(json["accessors"].size()) - 1;
    }
    int add(const std::vector<float>& values, const std::string& type) {
        return add(values, 5126, type);
    }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
    nlohmann::json& extension() { return primitive()["extensions"]["KHR_gaussian_splatting"]; }
    /// The accessor index of an attribute of KHR_gaussian_splatting; created if absent.
    nlohmann::json& attribute(const std::string& name) {
        return primitive()["attributes"]["KHR_gaussian_splatting:" + name];
    }

    std::string bytes() const { return bytes_of(json.dump(), bin); }
    static std::string bytes_of(const std::string& text, const std::string& data) {
        const std::string chunks = glb_chunk("JSON", text, ' ') +
                                   (data.empty() ? "" : glb_chunk({"BIN\0", 4}, data, '\0'));
        return "glTF" + four_bytes(2) + four_bytes(12 + chunks.size()) + chunks;
    }
};

/// Two splats of SH degree 0, shown by one node.
inline Glb two_splats() {
    Glb glb;
    glb.json = nlohmann::json::parse(R"({"asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_gaussian_splatting"], "buffers": [{"byteLength": 0}],
        "nodes": [{"mesh": 0, "name": "show"}], "scenes": [{"nodes": [0]}], "scene": 0,
        "meshes": [{"primitives": [{"mode": 0, "extensions": {"KHR_gaussian_splatting":
            {"kernel": "ellipse", "colorSpace": "srgb_rec709_display"}}}]}]})");
    glb.primitive()["attributes"]["POSITION"] = glb.add({1, 2, 3, -1, 0.5F, 4}, "VEC3");
    glb.attribute("ROTATION") = glb.add({0, 0, 0, 1, 0.6F, 0, 0, 0.8F}, "VEC4");
    glb.attribute("SCALE") = glb.add({0.1F, 0.2F, 0.3F, 1, 2, 3}, "VEC3");
    glb.attribute("OPACITY") = glb.add({0.25F, 1}, "SCALAR");
    glb.attribute("SH_DEGREE_0_COEF_0") = glb.add({0.5F, -0.5F, 1, 2, 0, -1}, "VEC3");
    return glb;
}

inline SceneContent read(const Glb& glb) {
    const Folder folder;
    return read_gltf(folder.write("scene.glb", glb.bytes()));
}

/// What the reader says of a file with these bytes, without its name; empty if it accepts it.
inline std::string complaint_about(const std::string& bytes) {
    const Folder folder;
    const std::string path = folder.write("scene.glb", bytes);
    const std::string text = complaint([&] { read_gltf(path); });
    return text.rfind(path + ": ", 0) == 0 ? text.substr(path.size() + 2) : text;
}
inline std::string complaint_about(const Glb& glb) {
    return complaint_about(glb.bytes());
}

} // namespace degs::test
