// SPDX-License-Identifier: Apache-2.0
#include "scene/files/scene_content.hpp"

#include "base/visible_text.hpp"

namespace degs {

void take_render_model(const std::string& key, const std::string& model, SceneContent& content) {
    if (model == "mip" || model == "antialiased") {
        content.traits.antialiased = true;
    } else if (model == "2dgs") {
        content.notes.emplace_back("The file was trained for the renderer of 2D Gaussian "
                                   "Splatting; here its discs are drawn like other Gaussians.");
    } else if (model != "default") {
        content.notes.push_back("The '" + key + ": " + visible(model.substr(0, 40)) +
                                "' of the file is unknown (known are default, mip or antialiased, "
                                "and 2dgs) and was passed over.");
    }
}

} // namespace degs
