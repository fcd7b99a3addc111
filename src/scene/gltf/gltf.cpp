// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf.hpp"

#include <algorithm>
#include <utility>

#include "scene/gltf/gltf_cameras.hpp"
#include "scene/gltf/gltf_nodes.hpp"
#include "scene/gltf/gltf_primitive.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMostCloudBytes = std::uint64_t{8} << 30U;

std::uint64_t bytes_per_gaussian(int sh_degree) {
    const std::uint64_t coefficients = std::uint64_t{1} * (sh_degree + 1) * (sh_degree + 1);
    return sizeof(glm::dvec3) + sizeof(glm::vec3) + sizeof(glm::vec4) + sizeof(float) +
           coefficients * 3 * sizeof(float);
}

/// Per mesh with splats: where it is shown.
std::vector<std::vector<Affine>> mesh_places(const GltfFile& file,
                                             const std::vector<PlacedNode>& nodes) {
    std::vector<std::vector<Affine>> places(file.model.meshes.size());
    for (const PlacedNode& placed : nodes) {
        const int mesh = file.model.nodes[placed.node].mesh;
        if (mesh == -1) {
            continue;
        }
        if (mesh < 0 || static_cast<std::size_t>(mesh) >= places.size()) {
            file.fail(node_words(file, placed.node) + " names mesh " + std::to_string(mesh) +
                      ", and the file has " + std::to_string(places.size()) + ".");
        }
        const auto& primitives = file.model.meshes[mesh].primitives;
        if (std::none_of(primitives.begin(), primitives.end(), is_splat_primitive)) {
            continue;
        }
        for (const Affine& instance : node_instances(file, placed.node)) {
            const Affine global = placed.global * instance;
            const TransformDefect defect = find_transform_defect(global.linear);
            if (defect != TransformDefect::None) {
                file.fail(node_words(file, placed.node) + " has a transform that " +
                          explain(defect) +
                          "; splats can be rotated, scaled along their mesh's axes and moved.");
            }
            places[mesh].push_back(global);
        }
    }
    return places;
}

bool is_identity(const Affine& map) {
    return map.linear == glm::dmat3(1.0) && map.translation == glm::dvec3(0.0);
}

/// Splats of all meshes that are shown, mesh after mesh, instance after instance.
class SplatCollector {
public:
    explicit SplatCollector(GltfFile& file) : file_(file) {}

    void add(SplatPrimitive primitive, const std::vector<Affine>& places) {
        GaussianCloud& cloud = primitive.cloud;
        (primitive.compressed ? compressed_ : plain_) = true;
        axes_assumed_ = axes_assumed_ || primitive.axes_assumed;
        antialiased_ = antialiased_ || primitive.antialiased;
        check_size(cloud, places.size());
        if (cloud_.empty() && places.size() == 1 && is_identity(places[0])) {
            cloud_ = std::move(cloud);
            return;
        }
        raise_degree(cloud.sh_degree);
        reserve(cloud, places.size());
        for (const Affine& place : places) {
            append_transformed(cloud, place, cloud_);
        }
    }

    /// SPZ data is in known axes; attributes hold whatever their exporter wrote, mostly those of
    /// the PLY.
    SceneContent take() {
        SceneContent content;
        content.cloud = std::move(cloud_);
        content.traits.antialiased = antialiased_;
        if (compressed_ && !plain_) {
            content.axes = *parse_axes("LUF");
            content.axes_assumed = axes_assumed_;
        } else if (compressed_) {
            file_.note("Splats compressed with SPZ and others are taken to lie in the same axes.");
        }
        return content;
    }

private:
    void check_size(const GaussianCloud& cloud, std::uint64_t places) {
        const std::uint64_t bytes = bytes_per_gaussian(std::max(cloud.sh_degree, cloud_.sh_degree));
        const std::uint64_t most = kMostCloudBytes / bytes;
        if (cloud_.size() > most || cloud.size() > (most - cloud_.size()) / places) {
            file_.fail("the instances of the file add up to more than " + std::to_string(most) +
                       " Gaussians of " + std::to_string(bytes) +
                       " bytes; a scene may have 8 GiB.");
        }
    }

    void raise_degree(int degree) {
        if (degree <= cloud_.sh_degree) {
            return;
        }
        GaussianCloud raised;
        raised.sh_degree = degree;
        append_transformed(cloud_, {}, raised);
        cloud_ = std::move(raised);
    }

    /// Many small meshes leave the growth to the vectors, which double.
    void reserve(const GaussianCloud& cloud, std::size_t places) {
        const std::size_t total = cloud_.size() + cloud.size() * places;
        if (total < 2 * cloud_.size()) {
            return;
        }
        cloud_.means.reserve(total);
        cloud_.scales.reserve(total);
        cloud_.rotations.reserve(total);
        cloud_.opacities.reserve(total);
        cloud_.sh.reserve(total * cloud_.sh_coefficients() * 3);
    }

    GltfFile& file_;
    GaussianCloud cloud_;
    bool compressed_ = false, plain_ = false, axes_assumed_ = false, antialiased_ = false;
};

SceneContent collect_splats(GltfFile& file, const std::vector<std::vector<Affine>>& places) {
    SplatCollector collector(file);
    std::size_t splats = 0, others = 0;
    for (std::size_t mesh = 0; mesh < places.size(); ++mesh) {
        const auto& primitives = file.model.meshes[mesh].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            const bool is_splat = is_splat_primitive(primitives[i]);
            splats += is_splat;
            others += !is_splat;
            if (is_splat && !places[mesh].empty()) {
                collector.add(read_splat_primitive(file, mesh, i), places[mesh]);
            }
        }
    }
    if (splats == 0) {
        file.fail("the glTF has no splats: none of its primitives has KHR_gaussian_splatting.");
    }
    if (others > 0) {
        file.note(std::to_string(others) +
                  " primitive(s) without KHR_gaussian_splatting are not drawn.");
    }
    SceneContent content = collector.take();
    if (content.cloud.empty()) {
        file.fail("no node of the scene shows the splats of the glTF.");
    }
    return content;
}

} // namespace

bool is_gltf(std::string_view head) {
    if (head.substr(0, 4) == "glTF") {
        return true;
    }
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && head[first] == '{';
}

SceneContent read_gltf(const std::string& path) {
    GltfFile file = parse_gltf(read_gltf_source(path));
    const std::vector<PlacedNode> nodes = place_nodes(file);
    SceneContent content = collect_splats(file, mesh_places(file, nodes));
    content.cameras = gltf_cameras(file, nodes);
    content.notes = std::move(file.notes);
    return content;
}

std::vector<Camera> read_gltf_cameras(const std::string& path) {
    GltfFile file = parse_gltf(read_gltf_source(path));
    return gltf_cameras(file, place_nodes(file));
}

} // namespace degs
