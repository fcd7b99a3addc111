// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_splat_layout.hpp"

#include <algorithm>
#include <array>

namespace degs {
namespace {

constexpr std::array<const char*, 10> kRequired{"x",       "y",     "z",     "opacity", "scale_0",
                                                "scale_1", "rot_0", "rot_1", "rot_2",   "rot_3"};

/// Files that hold Gaussians, but not in a form that can be drawn from these properties alone.
struct Foreign {
    const char* marker; ///< property of the vertices
    const char* sentence;
};
constexpr std::array<Foreign, 4> kForeign{{
    {"trbf_center", "this is a dynamic scene (SpacetimeGaussians), where a still one is needed; "
                    "supported are its lite model as a scene of its own and sequences of one still "
                    "PLY file per frame."},
    {"scale_t", "this is a dynamic scene of native 4D Gaussians, which is not supported; supported "
                "are the lite model of SpacetimeGaussians and sequences of one still PLY file per "
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

/// True if the vertices have colours of a type that says which number is full intensity.
bool has_rgb(const PlyElement& vertex) {
    for (const PlyProperty& p : vertex.properties) {
        const bool colour = p.name == "red" || p.name == "green" || p.name == "blue";
        if (colour && (p.list_count || p.type != PlyType::UInt8)) {
            return false;
        }
    }
    return vertex.has("red") && vertex.has("green") && vertex.has("blue");
}

void refuse_missing(const std::string& path, const PlyElement& vertex, const PlySplatLayout& layout,
                    int rest_count) {
    std::string missing;
    const auto require = [&](const std::string& name) {
        if (!is_scalar(vertex, name)) {
            missing += (missing.empty() ? "'" : ", '") + name + "'";
        }
    };
    for (const char* const name : kRequired) {
        require(name);
    }
    for (int i = 0; i < 3 && !layout.rgb; ++i) {
        require("f_dc_" + std::to_string(i));
    }
    if (layout.scales == 3) {
        require("scale_2");
    }
    for (int i = 0; i < rest_count; ++i) {
        require("f_rest_" + std::to_string(i));
    }
    if (!missing.empty()) {
        fail_file(path, "element 'vertex' of a Gaussian scene needs the scalar properties " +
                            missing + ", which this file does not have.");
    }
}

void find_degree(const std::string& path, int rest_count, PlySplatLayout& layout,
                 std::vector<std::string>& notes) {
    layout.rest_coefficients = rest_count / 3;
    for (int degree = 0; degree <= 4; ++degree) {
        if (rest_count == 3 * ((degree + 1) * (degree + 1) - 1)) {
            layout.sh_degree = std::min(degree, 3);
            if (degree == 4) {
                notes.emplace_back("The spherical harmonics of degree 4 were dropped, because "
                                   "images are drawn with degree 3 at most.");
            }
            return;
        }
    }
    fail_file(path,
              "the file has " + std::to_string(rest_count) +
                  " properties f_rest_*; allowed are 0, 9, 24, 45 and 72, for spherical harmonics "
                  "of degree 0 to 4.");
}

/// Files that lack what has a substitute.
void find_substitutes(const PlyElement& vertex, PlySplatLayout& layout,
                      std::vector<std::string>& notes) {
    if (!vertex.has("scale_2") && is_scalar(vertex, "scale_1")) {
        layout.scales = 2;
        notes.emplace_back(
            "The file has two scales per Gaussian (2D Gaussian Splatting); the third "
            "was set to 0, and the discs are drawn like other Gaussians.");
    }
    if (!vertex.has("f_dc_0") && !vertex.has("f_dc_1") && !vertex.has("f_dc_2") &&
        has_rgb(vertex)) {
        layout.rgb = true;
        notes.emplace_back("The file has no f_dc_0, f_dc_1 and f_dc_2; red, green and blue were "
                           "taken for the colour in every direction.");
    }
}

} // namespace

PlySplatLayout find_splat_layout(const std::string& path, const PlyHeader& header,
                                 std::vector<std::string>& notes) {
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
    find_degree(path, rest_count, layout, notes);
    find_substitutes(vertex, layout, notes);
    refuse_missing(path, vertex, layout, rest_count);
    layout.has_filter_3d = is_scalar(vertex, "filter_3D");
    return layout;
}

} // namespace degs
