// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/gtc/quaternion.hpp>

#include "scene/gltf/gltf_accessor.hpp"

namespace degs {
namespace {

constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";

void check_numbers(const GltfFile& file, int node, const std::vector<double>& numbers,
                   std::size_t needed, const char* name) {
    if (!numbers.empty() && numbers.size() != needed) {
        file.fail(node_words(file, node) + " has a " + name + " of " +
                  std::to_string(numbers.size()) + " numbers; " + std::to_string(needed) +
                  " are needed.");
    }
    if (!std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); })) {
        file.fail(node_words(file, node) + " has a " + name + " that is not finite.");
    }
}

Affine from_parts(const glm::dvec3& translation, const glm::dmat3& rotation,
                  const glm::dvec3& scale) {
    return {{rotation[0] * scale.x, rotation[1] * scale.y, rotation[2] * scale.z}, translation};
}

/// `length` is that of q, which is x y z w.
glm::dmat3 rotation_matrix(const double* q, double length) {
    return glm::mat3_cast(glm::dquat(q[3], q[0], q[1], q[2]) / length);
}

double quaternion_length(const double* q) {
    return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

Affine matrix_of(const GltfFile& file, int node, const std::vector<double>& m) {
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
        file.fail(node_words(file, node) + " has a matrix whose last row is not 0 0 0 1.");
    }
    return {{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

Affine local_of(const GltfFile& file, int index) {
    const tinygltf::Node& node = file.model.nodes[index];
    check_numbers(file, index, node.matrix, 16, "matrix");
    check_numbers(file, index, node.translation, 3, "translation");
    check_numbers(file, index, node.rotation, 4, "rotation");
    check_numbers(file, index, node.scale, 3, "scale");
    if (!node.matrix.empty()) {
        return matrix_of(file, index, node.matrix);
    }
    const auto vector = [](const std::vector<double>& v, double otherwise) {
        return v.empty() ? glm::dvec3(otherwise) : glm::dvec3(v[0], v[1], v[2]);
    };
    glm::dmat3 rotation(1.0);
    if (!node.rotation.empty()) {
        const double length = quaternion_length(node.rotation.data());
        if (!(length > 0) || !std::isfinite(length)) {
            file.fail(node_words(file, index) + " has a rotation of length " +
                      std::to_string(length) + "; a quaternion of length 1 is needed.");
        }
        rotation = rotation_matrix(node.rotation.data(), length);
    }
    return from_parts(vector(node.translation, 0), rotation, vector(node.scale, 1));
}

void check_node(const GltfFile& file, int node, const std::string& who) {
    const std::size_t count = file.model.nodes.size();
    if (node < 0 || static_cast<std::size_t>(node) >= count) {
        file.fail(who + " names node " + std::to_string(node) + ", and the file has " +
                  std::to_string(count) + ".");
    }
}

std::vector<int> root_nodes(const GltfFile& file) {
    const tinygltf::Model& model = file.model;
    const int scenes = static_cast<int>(model.scenes.size());
    if (model.defaultScene < -1 || model.defaultScene >= std::max(scenes, 1)) {
        file.fail("the default scene is " + std::to_string(model.defaultScene) +
                  ", and the file has " + std::to_string(scenes) + ".");
    }
    if (scenes > 0) {
        const int scene = std::max(model.defaultScene, 0);
        for (const int node : model.scenes[scene].nodes) {
            check_node(file, node, "scene " + std::to_string(scene));
        }
        return model.scenes[scene].nodes;
    }
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            check_node(file, child, "a node");
            is_child[child] = true;
        }
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
        if (!is_child[i]) {
            roots.push_back(static_cast<int>(i));
        }
    }
    return roots;
}

/// One attribute of the instances; empty if there is none.
std::vector<double> instance_values(const GltfFile& file, const tinygltf::Value& attributes,
                                    const std::string& who, const char* name, int width,
                                    unsigned components) {
    const tinygltf::Value* const index = member_of(attributes, name);
    if (index == nullptr) {
        return {};
    }
    const std::string what = who + ": " + name + " of its instances";
    const GltfAccessor accessor(file, index->IsInt() ? index->GetNumberAsInt() : -1,
                                {what, width, width, components});
    std::vector<double> values(accessor.count() * width);
    accessor.read(values.data(), width, width);
    if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) {
        file.fail(what + " holds numbers that are not finite.");
    }
    return values;
}

/// Number of instances: all attributes that are present agree on it.
std::size_t instance_count(const GltfFile& file, const std::string& who, std::size_t a,
                           std::size_t b, std::size_t c) {
    const std::size_t count = std::max({a, b, c});
    for (const std::size_t other : {a, b, c}) {
        if (other != 0 && other != count) {
            file.fail(who + " has instances whose attributes have " + std::to_string(other) +
                      " and " + std::to_string(count) + " elements.");
        }
    }
    if (count == 0) {
        file.fail(who + " has " + kInstancing + " without TRANSLATION, ROTATION or SCALE.");
    }
    return count;
}

} // namespace

Affine operator*(const Affine& a, const Affine& b) {
    return {a.linear * b.linear, a.linear * b.translation + a.translation};
}

std::string node_words(const GltfFile& file, int node) {
    const std::string name = quoted_name(file.model.nodes[node].name);
    return "node " + std::to_string(node) + (name.empty() ? "" : " " + name);
}

std::vector<PlacedNode> place_nodes(const GltfFile& file) {
    struct Open {
        int node;
        Affine parent;
    };
    std::vector<Open> open;
    std::vector<bool> seen(file.model.nodes.size());
    std::vector<PlacedNode> placed;
    const auto push = [&](const std::vector<int>& nodes, const Affine& parent) {
        for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
            open.push_back({*node, parent});
        }
    };
    push(root_nodes(file), {});
    while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        if (seen[next.node]) {
            file.fail(node_words(file, next.node) +
                      " is reached twice; a node has one parent, and none is below itself.");
        }
        seen[next.node] = true;
        placed.push_back({next.node, next.parent * local_of(file, next.node)});
        const std::vector<int>& children = file.model.nodes[next.node].children;
        for (const int child : children) {
            check_node(file, child, node_words(file, next.node));
        }
        push(children, placed.back().global);
    }
    return placed;
}

std::vector<Affine> node_instances(const GltfFile& file, int node) {
    const auto& extensions = file.model.nodes[node].extensions;
    const auto extension = extensions.find(kInstancing);
    if (extension == extensions.end()) {
        return {Affine{}};
    }
    const std::string who = node_words(file, node);
    const tinygltf::Value* const found = member_of(extension->second, "attributes");
    const tinygltf::Value attributes =
        found == nullptr ? tinygltf::Value(tinygltf::Value::Object{}) : *found;
    const std::vector<double> moves =
        instance_values(file, attributes, who, "TRANSLATION", 3, kGltfFloat);
    const std::vector<double> turns =
        instance_values(file, attributes, who, "ROTATION", 4,
                        kGltfFloat | kGltfByteNormalized | kGltfShortNormalized);
    const std::vector<double> scales =
        instance_values(file, attributes, who, "SCALE", 3, kGltfFloat);
    const std::size_t count =
        instance_count(file, who, moves.size() / 3, turns.size() / 4, scales.size() / 3);
    std::vector<Affine> instances(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto vector = [&](const std::vector<double>& v, double otherwise) {
            return v.empty() ? glm::dvec3(otherwise)
                             : glm::dvec3(v[i * 3], v[i * 3 + 1], v[i * 3 + 2]);
        };
        glm::dmat3 rotation(1.0);
        if (!turns.empty()) {
            const double length = quaternion_length(&turns[i * 4]);
            if (!(length > 0)) {
                file.fail(who + " has an instance whose rotation has length 0.");
            }
            rotation = rotation_matrix(&turns[i * 4], length);
        }
        instances[i] = from_parts(vector(moves, 0), rotation, vector(scales, 1));
    }
    return instances;
}

} // namespace degs
