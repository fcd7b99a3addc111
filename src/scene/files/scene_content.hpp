// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/files/axes.hpp"
#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

struct SceneContent;

/// What a scene file says about how its Gaussians want to be drawn. The defaults are those of the
/// original 3DGS code, which says nothing.
struct SceneTraits {
    /// Trained with an opacity that makes up for the low-pass filter of the projection
    /// (Mip-Splatting): SPZ flag 1, `SplatRenderMode: mip` of a PLY.
    bool antialiased = false;
};

/// For files whose colours are linear: nothing is converted.
constexpr const char* kLinearColoursNote = "The colours are linear: the image is in linear light, "
                                           "too, and looks dark where it is shown as "
                                           "sRGB.";

/// Takes over how a scene was trained, as PlayCanvas' programs call it: "default", "antialiased"
/// (also "mip") or "2dgs". The latter and unknown words add a note; `key` is what the file calls
/// it.
void take_render_model(const std::string& key, const std::string& model, SceneContent& content);

/// All that one scene file holds, before anything is dropped.
struct SceneContent {
    GaussianCloud cloud;
    std::vector<Camera> cameras; ///< of the file itself; most formats have none
    SceneTraits traits;
    Axes axes;                 ///< of the cloud and the cameras; load_scene() turns both to RDF
    bool axes_assumed = false; ///< the file does not name them, and its format is used either way
    std::vector<std::string> notes; ///< a full sentence for everything guessed or passed over
};

} // namespace degs
