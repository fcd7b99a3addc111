// SPDX-License-Identifier: Apache-2.0
#include "scene/dynamic/spacetime_ply.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "base/byte_order.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"
#include "scene/ply/ply_header.hpp"
#include "scene/ply/ply_rows.hpp"
#include "scene/ply/ply_values.hpp"

namespace degs {
namespace {

/// A float property and where it is kept.
struct SpacetimeField {
    std::string name;
    std::size_t offset; ///< bytes into a SpacetimeGaussian
};

/// The fields that are kept, in the order of the original's files.
const std::vector<SpacetimeField>& spacetime_fields() {
    static const std::vector<SpacetimeField> fields = [] {
        std::vector<SpacetimeField> list;
        const auto add = [&list](const std::string& name, std::size_t offset, int count) {
            for (int i = 0; i < count; ++i) {
                list.push_back({name + std::to_string(i), offset + i * sizeof(float)});
            }
        };
        const std::size_t mean = offsetof(SpacetimeGaussian, mean);
        list = {{"x", mean}, {"y", mean + sizeof(float)}, {"z", mean + 2 * sizeof(float)}};
        list.push_back({"trbf_center", offsetof(SpacetimeGaussian, centre)});
        list.push_back({"trbf_scale", offsetof(SpacetimeGaussian, log_duration)});
        add("motion_", offsetof(SpacetimeGaussian, motion), 9);
        add("f_dc_", offsetof(SpacetimeGaussian, rgb), 3);
        list.push_back({"opacity", offsetof(SpacetimeGaussian, opacity)});
        add("scale_", offsetof(SpacetimeGaussian, log_scale), 3);
        add("rot_", offsetof(SpacetimeGaussian, rotation), 4);
        add("omega_", offsetof(SpacetimeGaussian, omega), 4);
        return list;
    }();
    return fields;
}

const PlyElement& spacetime_vertex(const std::string& path, const PlyHeader& header) {
    const PlyElement* vertex = header.find("vertex");
    if (vertex == nullptr) {
        fail_file(path, "the file has no element 'vertex', which holds the Gaussians of a scene.");
    }
    for (const char* marker : {"f_t_0", "f_dc_3"}) {
        if (vertex->has(marker)) {
            fail_file(
                path,
                "this is a dynamic scene of the full model of SpacetimeGaussians, whose "
                "colours come from a neural network; supported are its lite model and sequences "
                "of one still PLY file per frame.");
        }
    }
    std::string missing;
    for (const SpacetimeField& field : spacetime_fields()) {
        const bool there = std::any_of(
            vertex->properties.begin(), vertex->properties.end(), [&](const PlyProperty& property) {
                return property.name == field.name && !property.list_count.has_value();
            });
        missing += there ? "" : (missing.empty() ? "'" : ", '") + field.name + "'";
    }
    if (!missing.empty()) {
        fail_file(path, "a dynamic scene of SpacetimeGaussians needs the scalar properties " +
                            missing + ", which this file does not have.");
    }
    return *vertex;
}

} // namespace

bool is_spacetime_ply(const std::string& path) {
    InputFile file(path);
    char magic[3] = {};
    if (file.read_some(magic, sizeof magic) != sizeof magic ||
        std::string(magic, sizeof magic) != "ply") {
        return false;
    }
    file.seek(0);
    const PlyHeader header = read_ply_header(file);
    const PlyElement* vertex = header.find("vertex");
    return vertex != nullptr && vertex->has("trbf_center");
}

SpacetimeCloud read_spacetime_ply(const std::string& path) {
    InputFile file(path);
    const PlyHeader header = read_ply_header(file);
    const PlyElement& vertex = spacetime_vertex(path, header);
    PlyRows rows(file, header, vertex); // checks the size that the file claims
    std::vector<std::pair<PlyColumn, std::size_t>> columns;
    for (const SpacetimeField& field : spacetime_fields()) {
        columns.emplace_back(rows.column(field.name), field.offset);
    }
    SpacetimeCloud scene(vertex.count);
    constexpr std::size_t kBlock = 4096;
    std::vector<char> bytes(std::min<std::size_t>(kBlock, scene.size()) * rows.row_bytes());
    for (std::size_t first = 0; first < scene.size(); first += kBlock) {
        const std::size_t count = std::min(kBlock, scene.size() - first);
        rows.read(bytes.data(), count);
        for (std::size_t i = 0; i < count; ++i) {
            char* const gaussian = reinterpret_cast<char*>(&scene[first + i]);
            for (const auto& [column, offset] : columns) {
                const char* from = bytes.data() + i * rows.row_bytes() + column.offset;
                with_type(column.type, [&, to = gaussian + offset](auto value) {
                    const auto number =
                        static_cast<float>(load_value<decltype(value)>(from, rows.swap_bytes()));
                    std::memcpy(to, &number, sizeof number);
                });
            }
        }
    }
    rows.finish();
    return scene;
}

void write_spacetime_ply(const SpacetimeCloud& scene, const std::string& path) {
    std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                         std::to_string(scene.size()) + "\n";
    for (const SpacetimeField& field : spacetime_fields()) {
        header += "property float " + field.name + "\n";
        if (field.name == "trbf_scale") { // the original has normals, all 0, behind it
            header += "property float nx\nproperty float ny\nproperty float nz\n";
        }
    }
    header += "end_header\n";
    write_whole(path, [&](std::ostream& out) {
        out << header;
        for (const SpacetimeGaussian& gaussian : scene) {
            std::string row;
            for (const SpacetimeField& field : spacetime_fields()) {
                const char* const from = reinterpret_cast<const char*>(&gaussian) + field.offset;
                float value = load_value<float>(from, host_is_big_endian());
                row.append(reinterpret_cast<const char*>(&value), sizeof value);
                row.append(field.name == "trbf_scale" ? 3 * sizeof(float) : 0, '\0');
            }
            out << row;
        }
    });
}

} // namespace degs
