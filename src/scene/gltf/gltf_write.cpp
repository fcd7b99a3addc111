// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "scene/cameras/lens_terms.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"
#include "scene/gltf/gltf.hpp"

namespace degs {
namespace {

using GlbJson = nlohmann::ordered_json;

constexpr int kFloatType = 5126, kPointsMode = 0;
constexpr double kRequiredNear = 0.01; // a required member; nothing here depends on it

/// An attribute: `get` puts the components of Gaussian i to `to`.
struct GlbColumn {
    std::string name;
    int width;
    std::function<void(std::size_t i, float* to)> get;

    const char* type() const { return width == 1 ? "SCALAR" : width == 3 ? "VEC3" : "VEC4"; }
};

std::vector<GlbColumn> columns_of(const GaussianCloud& cloud) {
    const std::string prefix = "KHR_gaussian_splatting:";
    std::vector<GlbColumn> columns;
    columns.push_back({"POSITION", 3, [&](std::size_t i, float* to) {
                           for (int axis = 0; axis < 3; ++axis) {
                               to[axis] = static_cast<float>(cloud.means[i][axis]);
                           }
                       }});
    columns.push_back({prefix + "ROTATION", 4, [&](std::size_t i, float* to) {
                           const glm::vec4& q = cloud.rotations[i]; // w x y z
                           to[0] = q.y;
                           to[1] = q.z;
                           to[2] = q.w;
                           to[3] = q.x;
                       }});
    columns.push_back({prefix + "SCALE", 3,
                       [&](std::size_t i, float* to) { std::copy_n(&cloud.scales[i].x, 3, to); }});
    columns.push_back(
        {prefix + "OPACITY", 1, [&](std::size_t i, float* to) { *to = cloud.opacities[i]; }});
    for (int degree = 0; degree <= cloud.sh_degree; ++degree) {
        for (int n = 0; n <= 2 * degree; ++n) {
            const int k = degree * degree + n;
            columns.push_back(
                {prefix + "SH_DEGREE_" + std::to_string(degree) + "_COEF_" + std::to_string(n), 3,
                 [&cloud, k](std::size_t i, float* to) {
                     std::copy_n(cloud.sh_of(i) + k * 3, 3, to);
                 }});
        }
    }
    return columns;
}

/// Least and largest POSITION, as written.
void add_bounds(const GaussianCloud& cloud, GlbJson& accessor) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high(-low);
    for (const glm::dvec3& mean : cloud.means) {
        low = glm::min(low, glm::vec3(mean));
        high = glm::max(high, glm::vec3(mean));
    }
    accessor["min"] = {low.x, low.y, low.z};
    accessor["max"] = {high.x, high.y, high.z};
}

GlbJson primitive_json(const std::vector<GlbColumn>& columns) {
    GlbJson attributes;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        attributes[columns[i].name] = i;
    }
    const GlbJson splats = {{"kernel", "ellipse"},
                            {"colorSpace", "srgb_rec709_display"},
                            {"projection", "perspective"},
                            {"sortingMethod", "cameraDistance"}};
    return {{"attributes", attributes},
            {"mode", kPointsMode},
            {"extensions", {{"KHR_gaussian_splatting", splats}}}};
}

void add_instances(const std::vector<GlbInstance>& instances, GlbJson& nodes) {
    for (const GlbInstance& instance : instances) {
        const glm::dvec3& t = instance.translation;
        const glm::dvec4& r = instance.rotation;
        nodes.push_back({{"name", instance.name},
                         {"mesh", 0},
                         {"translation", {t.x, t.y, t.z}},
                         {"rotation", {r.x, r.y, r.z, r.w}}});
    }
    if (instances.empty()) {
        nodes.push_back({{"mesh", 0}});
    }
}

/// What glTF does not know of a camera: the size of the image, a principal point off its middle,
/// and a lens that distorts.
GlbJson extras_of(const Camera& camera) {
    GlbJson extras = {{"width", camera.width}, {"height", camera.height}};
    if (camera.shift != glm::dvec2(0.0)) {
        const glm::dvec2 point = camera.principal_point();
        extras["cx"] = point.x;
        extras["cy"] = point.y;
    }
    if (!camera.lens.is_pinhole()) {
        const LensTerms lens = terms_of(camera.lens);
        extras["camera_model"] = lens.model;
        extras["distortion"] = lens.terms;
    }
    return extras;
}

void add_cameras(const std::vector<Camera>& cameras, GlbJson& json) {
    for (const Camera& camera : cameras) {
        json["cameras"].push_back(
            {{"type", "perspective"},
             {"perspective",
              {{"yfov", 2 * std::atan(camera.height / (2 * camera.fy))},
               {"aspectRatio", camera.width * camera.fy / (camera.height * camera.fx)},
               {"znear", kRequiredNear}}},
             {"extras", extras_of(camera)}});
        const glm::dvec3& right = camera.camera_to_world[0];
        const glm::dvec3 up = -camera.camera_to_world[1];
        const glm::dvec3 back = -camera.camera_to_world[2];
        const glm::dvec3& at = camera.position;
        json["nodes"].push_back({{"name", camera.name},
                                 {"camera", json["cameras"].size() - 1},
                                 {"matrix",
                                  {right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, back.x,
                                   back.y, back.z, 0, at.x, at.y, at.z, 1}}});
    }
}

/// Adds the views and accessors of the columns; returns the bytes of the buffer.
std::uint64_t add_accessors(const GaussianCloud& cloud, const std::vector<GlbColumn>& columns,
                            GlbJson& json) {
    std::uint64_t offset = 0;
    for (const GlbColumn& column : columns) {
        const std::uint64_t bytes = cloud.size() * column.width * sizeof(float);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}});
        json["accessors"].push_back({{"bufferView", json["accessors"].size()},
                                     {"componentType", kFloatType},
                                     {"count", cloud.size()},
                                     {"type", column.type()}});
        offset += bytes;
    }
    add_bounds(cloud, json["accessors"][0]);
    return offset;
}

void put_u32(std::ostream& out, std::uint64_t value) {
    for (int i = 0; i < 4; ++i) {
        out.put(static_cast<char>(value >> (8 * i) & 0xFFU));
    }
}

void write_floats(std::ostream& out, const std::vector<float>& values) {
    const std::uint32_t one = 1;
    if (*reinterpret_cast<const char*>(&one) == 1) {
        out.write(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
        return;
    }
    for (const float& value : values) {
        const char* const bytes = reinterpret_cast<const char*>(&value);
        out.write(
            std::string(std::reverse_iterator(bytes + 4), std::reverse_iterator(bytes)).data(), 4);
    }
}

void write_column(std::ostream& out, const GlbColumn& column, std::size_t count) {
    constexpr std::size_t kBlock = 1 << 16; // Gaussians
    std::vector<float> values;
    for (std::size_t first = 0; first < count; first += kBlock) {
        const std::size_t rows = std::min(kBlock, count - first);
        values.resize(rows * column.width);
        for (std::size_t i = 0; i < rows; ++i) {
            column.get(first + i, values.data() + i * column.width);
        }
        write_floats(out, values);
    }
}

} // namespace

void write_glb(const GaussianCloud& cloud, const std::vector<Camera>& cameras,
               const std::vector<GlbInstance>& instances, const std::string& path) {
    if (cloud.empty()) {
        fail_file(path, "a GLB needs at least one Gaussian.");
    }
    const std::vector<GlbColumn> columns = columns_of(cloud);
    GlbJson json = {{"asset", {{"version", "2.0"}, {"generator", "DeGS"}}},
                    {"extensionsUsed", {"KHR_gaussian_splatting"}},
                    {"scene", 0},
                    {"scenes", GlbJson::array()},
                    {"nodes", GlbJson::array()}};
    json["meshes"] = {{{"primitives", {primitive_json(columns)}}}};
    const std::uint64_t data_bytes = add_accessors(cloud, columns, json);
    json["buffers"] = {{{"byteLength", data_bytes}}};
    add_instances(instances, json["nodes"]);
    add_cameras(cameras, json);
    GlbJson roots = GlbJson::array();
    for (std::size_t i = 0; i < json["nodes"].size(); ++i) {
        roots.push_back(i);
    }
    json["scenes"].push_back({{"nodes", roots}});

    std::string text = dump_json(json, -1, true);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t bytes = 12 + 8 + text.size() + 8 + data_bytes;
    if (bytes > std::numeric_limits<std::uint32_t>::max()) {
        fail_file(path, "a GLB of " + std::to_string(cloud.size()) + " Gaussians would have " +
                            std::to_string(bytes) + " bytes; it must stay below 4 GiB.");
    }
    write_whole(path, [&](std::ostream& out) {
        out << "glTF";
        put_u32(out, 2);
        put_u32(out, bytes);
        put_u32(out, text.size());
        out << "JSON" << text;
        put_u32(out, data_bytes);
        out << "BIN" << '\0';
        for (const GlbColumn& column : columns) {
            write_column(out, column, cloud.size());
        }
    });
}

} // namespace degs
