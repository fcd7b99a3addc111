// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_splat_layout.hpp"

#include <algorithm>
#include <array>

namespace degs {
namespace {

constexpr std::array<const char*, 14> kRequired{
    "x",       "y",       "z",       "f_dc_0", "f_dc_1", "f_dc_2", "opacity",
    "scale_0", "scale_1", "scale_2", "rot_0",  "rot_1",  "rot_2",  "rot_3"};

/// Files that hold Gaussians, but not in a form that can be drawn from these properties alone.
struct Foreign {
    const char* marker; ///< property of the vertices
    const char* sentence;
};
constexpr std::array<Foreign, 5> kForeign{{
    {"packed_position",
     "this is a PlayCanvas compressed PLY, which is not supported; convert it to "
     "an uncompressed PLY first."},
    {"trbf_center", "this is a dynamic scene (SpacetimeGaussians), which is not supported; export "
                    "one standard PLY per frame."},
    {"scale_t", "this is a dynamic (4D) scene, which is not supported; export one standard PLY per "
                "frame."},
    {"f_anchor_feat_0", "this is an anchor-based scene (Scaffold-GS), which needs its neural "
                        "network to be drawn and is not supported."},
    {"f_offset_0", "this is an anchor-based scene (Scaffold-GS), which needs its neural network to "
                   "be drawn and is not supported."},
}};

bool is_scalar(const PlyElement& vertex, const std::string& name) {
    return std::any_of(
        vertex.properties.begin(), vertex.properties.end(),
        [&](const PlyProperty& p) { return p.name == name && !p.list_count.has_value(); });
}

/// A file with neither opacity nor scales holds no Gaussians at all.
void refuse_ordinary_geometry(const std::string& path, const PlyHeader& header,
                              const PlyElement& vertex) {
    if (vertex.has("opacity") || vertex.has("scale_0") || vertex.has("f_dc_0")) {
        return;
    }
    if (header.find("face") != nullptr || header.find("tristrips") != nullptr) {
        fail_file(path,
                  "this is a triangle mesh, not a Gaussian scene: it has faces, but no f_dc_0, "
                  "opacity and scale_0.");
    }
    if (vertex.has("x")) {
        fail_file(path, "this is a plain point cloud, not a Gaussian scene: its points have no "
                        "f_dc_0, opacity and scale_0.");
    }
}

void refuse_missing(const std::string& path, const PlyElement& vertex, int rest_count) {
    std::string missing;
    const auto require = [&](const std::string& name) {
        if (!is_scalar(vertex, name)) {
            missing += (missing.empty() ? "'" : ", '") + name + "'";
        }
    };
    for (const char* const name : kRequired) {
        require(name);
    }
    for (int i = 0; i < rest_count; ++i) {
        require("f_rest_" + std::to_string(i));
    }
    if (!missing.empty()) {
        fail_file(path, "element 'vertex' of a Gaussian scene needs the scalar properties " +
                            missing + ", which this file does not have.");
    }
}

int degree_of(const std::string& path, int rest_count) {
    for (int degree = 0; degree <= 3; ++degree) {
        if (rest_count == 3 * ((degree + 1) * (degree + 1) - 1)) {
            return degree;
        }
    }
    fail_file(path,
              "the file has " + std::to_string(rest_count) +
                  " properties f_rest_*; allowed are 0, 9, 24 and 45, for spherical harmonics "
                  "of degree 0 to 3.");
}

} // namespace

PlySplatLayout find_splat_layout(const std::string& path, const PlyHeader& header) {
    PlySplatLayout layout;
    layout.vertex = header.find("vertex");
    if (layout.vertex == nullptr) {
        fail_file(path, "the file has no element 'vertex', which holds the Gaussians of a scene.");
    }
    const PlyElement& vertex = *layout.vertex;
    for (const Foreign& foreign : kForeign) {
        if (vertex.has(foreign.marker)) {
            fail_file(path, foreign.sentence);
        }
    }
    refuse_ordinary_geometry(path, header, vertex);
    const auto rest_count = static_cast<int>(
        std::count_if(vertex.properties.begin(), vertex.properties.end(),
                      [](const PlyProperty& p) { return p.name.rfind("f_rest_", 0) == 0; }));
    layout.sh_degree = degree_of(path, rest_count);
    refuse_missing(path, vertex, rest_count);
    layout.has_filter_3d = is_scalar(vertex, "filter_3D");
    return layout;
}

} // namespace degs
