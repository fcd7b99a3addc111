// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_cameras.hpp"

#include <cmath>

#include "scene/cameras/lens_terms.hpp"
#include "splat/model/angles.hpp"

namespace degs {
namespace {

constexpr int kRows = 720;
constexpr double kUsualAspect = 16.0 / 9;
constexpr int kMostSide = 65536; // px, as in cameras.json

/// A side of the image in the extras; 0 if there is none.
int side_of(const tinygltf::Camera& camera, const char* key) {
    const tinygltf::Value* const side = member_of(camera.extras, key);
    const int pixels = side != nullptr && side->IsInt() ? side->GetNumberAsInt() : 0;
    return pixels >= 1 && pixels <= kMostSide ? pixels : 0;
}

/// A coordinate of the principal point in the extras; that of the middle if there is none.
double coordinate_of(const tinygltf::Camera& camera, const char* key, int side) {
    const tinygltf::Value* const value = member_of(camera.extras, key);
    return value != nullptr && value->IsNumber() ? value->GetNumberAsDouble() : side / 2.0;
}

/// The lens in the extras, in the words of cameras.json; a pinhole if they say nothing of the kind.
Lens lens_in(const tinygltf::Camera& camera) {
    const tinygltf::Value* const model = member_of(camera.extras, "camera_model");
    const tinygltf::Value* const terms = member_of(camera.extras, "distortion");
    if (model == nullptr || !model->IsString() || terms == nullptr || !terms->IsArray()) {
        return {};
    }
    LensTerms lens{model->Get<std::string>(), {}};
    for (std::size_t i = 0; i < terms->ArrayLen(); ++i) {
        const tinygltf::Value& term = terms->Get(static_cast<int>(i));
        if (!term.IsNumber()) {
            return {};
        }
        lens.terms.push_back(term.GetNumberAsDouble());
    }
    return lens_of(lens).value_or(Lens());
}

/// Size, focal lengths, principal point and lens.
void set_lens(const GltfFile& file, const tinygltf::Camera& from, const std::string& who,
              Camera& to) {
    const double yfov = from.perspective.yfov;
    const double written = from.perspective.aspectRatio; // 0: none
    const double aspect = written == 0 ? kUsualAspect : written;
    if (!(yfov > 0 && yfov < kPi)) {
        file.fail(who + " has a yfov of " + std::to_string(yfov) +
                  " radians; more than 0 and less than pi is needed.");
    }
    const double columns = std::round(kRows * aspect);
    if (!(columns >= 1 && columns <= kMostSide)) {
        file.fail(who + " has an aspectRatio of " + std::to_string(aspect) +
                  ", which is outside 1/720 to 91.");
    }
    to.width = side_of(from, "width");
    to.height = side_of(from, "height");
    if (to.width == 0 || to.height == 0) {
        to.width = static_cast<int>(columns);
        to.height = kRows;
    }
    const double half = std::tan(yfov / 2);
    to.fx = to.width / (2 * half * aspect);
    to.fy = to.height / (2 * half);
    if (!(std::isfinite(to.fx) && std::isfinite(to.fy))) {
        file.fail(who + " has a yfov of " + std::to_string(yfov) +
                  " radians, which is too small for a focal length.");
    }
    if (!to.set_principal_point(
            {coordinate_of(from, "cx", to.width), coordinate_of(from, "cy", to.height)})) {
        file.fail(who + " has a principal point (cx, cy) in its extras that is too far from the "
                        "middle of the image.");
    }
    to.lens = lens_in(from);
}

/// glTF cameras look along -z with +y up; a scale of the node does not matter.
void set_pose(const GltfFile& file, const Affine& global, const std::string& who, Camera& to) {
    const TransformDefect defect = find_transform_defect(global.linear);
    if (defect != TransformDefect::None) {
        file.fail(who + " has a transform that " + explain(defect) +
                  "; a camera needs one of rotation, scale and translation.");
    }
    const glm::dmat3 axes = rotation_of(global.linear);
    to.camera_to_world = {axes[0], -axes[1], -axes[2]};
    to.position = global.translation;
}

} // namespace

std::vector<Camera> gltf_cameras(GltfFile& file, const std::vector<PlacedNode>& nodes) {
    std::vector<Camera> cameras;
    const std::size_t known = file.model.cameras.size();
    for (const PlacedNode& placed : nodes) {
        const tinygltf::Node& node = file.model.nodes[placed.node];
        if (node.camera == -1) {
            continue;
        }
        const std::string who = "the camera of " + node_words(file, placed.node);
        if (node.camera < 0 || static_cast<std::size_t>(node.camera) >= known) {
            file.fail(who + " is number " + std::to_string(node.camera) + ", and the file has " +
                      std::to_string(known) + ".");
        }
        const tinygltf::Camera& from = file.model.cameras[node.camera];
        if (from.type != "perspective") {
            file.note("Orthographic cameras are ignored; only perspective ones draw splats.");
            continue;
        }
        Camera to;
        to.id = static_cast<int>(cameras.size());
        to.name = node.name.empty() ? from.name : node.name;
        set_lens(file, from, who, to);
        set_pose(file, placed.global, who, to);
        cameras.push_back(to);
    }
    return cameras;
}

} // namespace degs
