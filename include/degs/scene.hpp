// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "degs/registers.hpp"

namespace degs {

/// A scene as the bytes that an accelerator reads from a platform's memory, with its views.
struct MemoryScene {
    /// A camera: what an entry of the table of views takes, and, of a pinhole, the registers Width
    /// to OriginY. Pixels are square units of the focal lengths; +x of a camera is right, +y down,
    /// +z forward.
    struct View {
        std::string name;
        int width = 0, height = 0;                    ///< px
        double focal_x = 0, focal_y = 0;              ///< px
        double axes[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}; ///< the camera's x, y, z in world space
        double position[3] = {0, 0, 0};               ///< in world space
        double shift_x = 0, shift_y = 0; ///< of the principal point from the image's middle, px
        int origin_x = 0, origin_y = 0;  ///< of the image in its raster, px
        LensKind lens = LensKind::Pinhole;
        double radial[4] = {}, denominator[3] = {}, tangential[2] = {}; ///< of the lens
    };
    std::vector<unsigned char> geometry; ///< 11 floats per Gaussian, see docs/accelerator.md
    std::vector<unsigned char> sh;       ///< 3 (degree + 1)^2 floats per Gaussian
    std::uint32_t gaussians = 0;
    std::uint32_t sh_degree = 0; ///< 0 to 3
    bool antialiased = false;    ///< for AcceleratorOptions
    std::vector<View>
        views; ///< never empty: a scene without cameras gets a view that shows all of it
    std::vector<std::string> notes; ///< a sentence for everything that was guessed or left out
};

/// Loads a scene of any format that `degs run --scene` reads, with the cameras beside it or in it,
/// or those of `cameras_file`. Throws InputError, one sentence, for every mistake in the files.
MemoryScene load_memory_scene(const std::string& scene, const std::string& cameras_file = "");

} // namespace degs
