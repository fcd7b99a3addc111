// SPDX-License-Identifier: Apache-2.0
// Hard cases H25 and H29: transforms of glTF nodes, and GLB files that are not what they say.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "accuracy/hard/hard_builder.hpp"
#include "base/json_text.hpp"
#include "degs/error.hpp"
#include "scene/gltf/gltf.hpp"
#include "splat/model/spherical_harmonics.hpp"
#include "splat/transform/cloud_transform.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;
using HardJson = nlohmann::json;

constexpr std::size_t kJsonAt = 20; ///< behind the header and the head of the first chunk

std::string number_of_four_bytes(std::uint64_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) {
        bytes += static_cast<char>(value >> (8 * i) & 255);
    }
    return bytes;
}

/// The two chunks of a GLB.
struct HardGlb {
    HardJson json;
    std::string bin; ///< chunk, with its head

    static HardGlb of(const GaussianCloud& cloud, const std::string& path) {
        write_glb(cloud, {}, {}, path);
        std::ifstream file(path, std::ios::binary);
        std::ostringstream content;
        content << file.rdbuf();
        const std::string bytes = content.str();
        std::size_t length = 0;
        for (int i = 3; i >= 0; --i) {
            length = length << 8 | static_cast<unsigned char>(bytes[12 + i]);
        }
        return {parse_json(bytes.substr(kJsonAt, length)), bytes.substr(kJsonAt + length)};
    }
    std::string bytes() const {
        std::string text = dump_json(json);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        return "glTF" + number_of_four_bytes(2) +
               number_of_four_bytes(kJsonAt + text.size() + bin.size()) +
               number_of_four_bytes(text.size()) + "JSON" + text + bin;
    }
};

/// What a map does to splats, as columns of a node's matrix.
struct NodeMap {
    const char* name;
    Affine map;
    bool defect;
};

std::vector<NodeMap> node_maps() {
    const glm::dmat3 turn(glm::dvec3(0.6, 0.8, 0), glm::dvec3(-0.8, 0.6, 0), glm::dvec3(0, 0, 1));
    const glm::dmat3 tilt(glm::dvec3(1, 0, 0), glm::dvec3(0, 0.6, 0.8), glm::dvec3(0, -0.8, 0.6));
    const auto scaled = [](const glm::dmat3& m, double x, double y, double z) {
        return glm::dmat3(m[0] * x, m[1] * y, m[2] * z);
    };
    return {{"turned", {tilt * turn, {0, 0, 12}}, false},
            {"scaled", {scaled(glm::dmat3(1), 2, 2, 2), {0.5, 0, 12}}, false},
            {"uneven", {scaled(tilt * turn, 3, 1, 0.25), {-0.5, 0.25, 12}}, false},
            {"far", {scaled(turn, 0.5, 1, 2), {1e5, -1e5, 12}}, false},
            {"mirrored", {scaled(turn, -1, 1, 1), {0, 0, 12}}, true},
            {"flat", {scaled(turn, 1, 0, 1), {0, 0, 12}}, true},
            {"sheared", {{glm::dvec3(1, 0, 0), {0.5, 1, 0}, {0, 0, 1}}, {0, 0, 12}}, true}};
}

/// A cloud of SH degree 2, around the origin.
GaussianCloud local_cloud() {
    HardBuilder builder(64, 64);
    GaussianCloud& cloud = builder.scene.cloud;
    cloud.sh_degree = 2;
    for (int i = 0; i < 30; ++i) {
        const int row = i / 6;
        builder.add_world({0.3 * (i % 6) - 0.75, 0.3 * row - 0.6, 0.05 * (i % 7)},
                          {0.02 + 0.01 * (i % 5), 0.1, 0.03},
                          {1, 0.1 * (i % 4), -0.2, 0.05 * (i % 9)}, 0.6,
                          {0.1 * (i % 10), 0.5, 0.3});
        for (std::size_t k = cloud.sh.size() - 24; k < cloud.sh.size(); ++k) {
            cloud.sh[k] = 0.05F * static_cast<float>(static_cast<int>(k * 7 % 11) - 5);
        }
    }
    sanitize(cloud);
    return cloud;
}

GaussianCloud moved(const GaussianCloud& cloud, const Affine& map) {
    GaussianCloud out;
    out.sh_degree = cloud.sh_degree;
    append_transformed(cloud, map, out);
    return out;
}

/// R diag(s)^2 R^T.
glm::dmat3 covariance_of(const GaussianCloud& cloud, std::size_t i) {
    const glm::dvec4 q = glm::normalize(glm::dvec4(cloud.rotations[i]));
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    glm::dmat3 m(glm::dvec3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)),
                 glm::dvec3(2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)),
                 glm::dvec3(2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)));
    for (int axis = 0; axis < 3; ++axis) {
        m[axis] *= double{cloud.scales[i][axis]};
    }
    return m * glm::transpose(m);
}

double largest(const glm::dmat3& m) {
    double most = 0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) {
            most = std::max(most, std::abs(m[c][r]));
        }
    }
    return most;
}

/// Checks moved Gaussians against M Sigma M^T and against colours in the local frame.
std::string check_moved(const GaussianCloud& local, const GaussianCloud& world, const Affine& map) {
    const glm::dmat3 back = glm::transpose(rotation_of(map.linear));
    for (std::size_t i = 0; i < local.size(); ++i) {
        const glm::dmat3 wanted = map.linear * covariance_of(local, i) * glm::transpose(map.linear);
        if (!(largest(covariance_of(world, i) - wanted) <= 1e-5 * largest(wanted))) {
            return "Gaussian " + std::to_string(i) + " has another covariance than M Sigma M^T.";
        }
        const glm::dvec3 place = map.linear * local.means[i] + map.translation;
        if (!(glm::length(world.means[i] - place) <= 1e-9 * (1 + glm::length(place)))) {
            return "Gaussian " + std::to_string(i) + " is not where its node puts it.";
        }
        for (const glm::dvec3& direction :
             {glm::dvec3(0.6, 0, 0.8), glm::dvec3(-0.48, 0.64, 0.6)}) {
            const glm::dvec3 drawn = evaluate_sh(world.sh_degree, world.sh_of(i), direction);
            const glm::dvec3 seen = evaluate_sh(local.sh_degree, local.sh_of(i), back * direction);
            if (!(glm::length(drawn - seen) <= 1e-5)) {
                return "Gaussian " + std::to_string(i) + " does not turn its colours.";
            }
        }
    }
    return {};
}

/// What reading the file ends with; empty if it was read.
std::string sentence_about(const std::string& path) {
    try {
        read_gltf(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

std::string require_refusal(const fs::path& path) {
    const std::string words = sentence_about(path.string());
    const std::string name = path.filename().string();
    return words.empty() ? "The file '" + name + "' was read."
           : words.find(name) == std::string::npos || words.back() != '.'
               ? "The sentence '" + words + "' does not name the file."
               : "";
}

void write_bytes(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

struct GlbDamage {
    const char* name;
    std::function<void(HardGlb&)> apply;
};

std::vector<GlbDamage> json_damages() {
    const auto attributes = [](HardGlb& g) -> HardJson& {
        return g.json["meshes"][0]["primitives"][0]["attributes"];
    };
    return {
        {"attribute", [=](HardGlb& g) { attributes(g)["POSITION"] = 99; }},
        {"negative", [=](HardGlb& g) { attributes(g)["POSITION"] = -1; }},
        {"wide", [=](HardGlb& g) { attributes(g)["POSITION"] = 4294967296; }},
        {"text", [=](HardGlb& g) { attributes(g)["POSITION"] = "0"; }},
        {"view", [](HardGlb& g) { g.json["accessors"][0]["bufferView"] = 77; }},
        {"count", [](HardGlb& g) { g.json["accessors"][0]["count"] = 18446744073709551615U; }},
        {"beyond", [](HardGlb& g) { g.json["accessors"][0]["count"] = 31; }},
        {"type", [](HardGlb& g) { g.json["accessors"][0]["componentType"] = 5130; }},
        {"buffer", [](HardGlb& g) { g.json["bufferViews"][0]["buffer"] = 1; }},
        {"offset", [](HardGlb& g) { g.json["bufferViews"][0]["byteOffset"] = 4294967292; }},
        {"empty_buffer", [](HardGlb& g) { g.json["buffers"][0]["byteLength"] = 0; }},
        {"sparse",
         [](HardGlb& g) {
             g.json["accessors"][0]["sparse"] = {{"count", -7}};
         }},
        {"version", [](HardGlb& g) { g.json["asset"]["version"] = "9.9"; }},
        {"extension", [](HardGlb& g) { g.json["extensionsRequired"] = HardJson::array({"X_y"}); }},
        {"cycle", [](HardGlb& g) { g.json["nodes"][0]["children"] = HardJson::array({0}); }},
        {"child", [](HardGlb& g) { g.json["nodes"][0]["children"] = HardJson::array({55}); }},
        {"matrix",
         [](HardGlb& g) {
             g.json["nodes"][0]["matrix"] = HardJson::array({1, 2, 3});
         }},
        {"no_splats",
         [](HardGlb& g) {
             g.json.erase("meshes");
             g.json["nodes"][0].erase("mesh");
         }},
        {"no_bin", [](HardGlb& g) { g.bin.clear(); }},
    };
}

/// Files whose chunks lie about their sizes.
std::vector<std::pair<const char*, std::string>> byte_damages(const std::string& whole) {
    const auto with = [&whole](std::size_t at, const std::string& four) {
        std::string bytes = whole;
        bytes.replace(at, 4, four);
        return bytes;
    };
    const std::string huge = number_of_four_bytes(0xFFFFFFFCU);
    const std::string deep(200000, '[');
    return {{"truncated", whole.substr(0, whole.size() - 40)},
            {"head", whole.substr(0, 11)},
            {"length", with(8, number_of_four_bytes(whole.size() + 8))},
            {"json_length", with(12, huge)},
            {"json_type", with(16, "JSOM")},
            {"deep", "glTF" + number_of_four_bytes(2) + number_of_four_bytes(20 + deep.size()) +
                         number_of_four_bytes(deep.size()) + "JSON" + deep},
            {"not_json", "glTF" + number_of_four_bytes(2) + number_of_four_bytes(24) +
                             number_of_four_bytes(4) + "JSON{]  "}};
}

} // namespace

std::vector<HardScene> make_transform_case(int width, int height) {
    const GaussianCloud local = local_cloud();
    std::vector<HardScene> scenes;
    for (const NodeMap& node : node_maps()) {
        if (!node.defect) {
            HardBuilder builder(width, height);
            builder.scene.cloud = moved(local, node.map);
            const glm::dvec3 place = node.map.translation;
            builder.scene.camera.position = {place.x, place.y, 0};
            builder.look(builder.middle_x(), builder.middle_y(), 60);
            scenes.push_back(std::move(builder.scene));
        }
    }
    return scenes;
}

std::string refuse_node_transforms(const std::string& folder) {
    const GaussianCloud local = local_cloud();
    const fs::path path = fs::path(folder) / "nodes.glb";
    for (const NodeMap& node : node_maps()) {
        HardGlb glb = HardGlb::of(local, path.string());
        HardJson matrix = HardJson::array();
        for (int column = 0; column < 4; ++column) {
            const glm::dvec3 v = column < 3 ? node.map.linear[column] : node.map.translation;
            matrix.insert(matrix.end(), {v.x, v.y, v.z, column < 3 ? 0.0 : 1.0});
        }
        glb.json["nodes"][0]["matrix"] = matrix;
        write_bytes(path, glb.bytes());
        std::string problem;
        if (node.defect) {
            problem = require_refusal(path);
        } else {
            const GaussianCloud stored = [&] { // means of a GLB are floats
                GaussianCloud cloud = local;
                for (glm::dvec3& mean : cloud.means) {
                    mean = glm::dvec3(glm::vec3(mean));
                }
                return cloud;
            }();
            problem = check_moved(stored, read_gltf(path.string()).cloud, node.map);
        }
        fs::remove(path);
        if (!problem.empty()) {
            return std::string("Node '") + node.name + "': " + problem;
        }
    }
    return {};
}

std::string refuse_broken_glb(const std::string& folder) {
    const GaussianCloud local = local_cloud();
    const auto file = [&folder](const std::string& name) {
        return fs::path(folder) / (name + ".glb");
    };
    const HardGlb whole = HardGlb::of(local, file("whole").string());
    std::string problem = sentence_about(file("whole").string());
    fs::remove(file("whole"));
    const auto refuse = [&](const std::string& name, const std::string& bytes) {
        write_bytes(file(name), bytes);
        problem = problem.empty() ? require_refusal(file(name)) : problem;
        fs::remove(file(name));
    };
    for (const GlbDamage& damage : json_damages()) {
        HardGlb glb = whole;
        damage.apply(glb);
        refuse(damage.name, glb.bytes());
    }
    for (const auto& [name, bytes] : byte_damages(whole.bytes())) {
        refuse(name, bytes);
    }
    return problem;
}

} // namespace degs
