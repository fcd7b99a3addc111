// SPDX-License-Identifier: Apache-2.0
#include "platform/accelerator_request.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace degs {
namespace {

constexpr std::uint32_t kMaxSide = 65536; // px, as in cameras.json
constexpr double kMaxFocal = 1e9;         // px, as in cameras.json
constexpr double kRotationSlack = 1e-3;   // of the products of two axes

AcceleratorFault fault(AcceleratorError error, Register which) {
    return {error, AcceleratorRegisters::offset_of(which)};
}

AcceleratorFault read_size(const AcceleratorRegisters& regs, std::uint64_t max_pixels,
                           Camera& camera) {
    const std::uint32_t width = regs.get(Register::Width);
    const std::uint32_t height = regs.get(Register::Height);
    if (width == 0 || width > kMaxSide) {
        return fault(AcceleratorError::BadSize, Register::Width);
    }
    if (height == 0 || height > kMaxSide || std::uint64_t{width} * height > max_pixels) {
        return fault(AcceleratorError::BadSize, Register::Height);
    }
    camera.width = width;
    camera.height = height;
    return {};
}

bool is_rotation(const glm::dmat3& axes) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) {
            // Phrased so that NaN fails.
            if (!(std::abs(glm::dot(axes[i], axes[j]) - (i == j ? 1 : 0)) <= kRotationSlack)) {
                return false;
            }
        }
    }
    return glm::determinant(axes) > 0;
}

AcceleratorFault read_camera(const AcceleratorRegisters& regs, Camera& camera) {
    camera.fx = regs.get_double(Register::FocalX);
    camera.fy = regs.get_double(Register::FocalY);
    for (const Register which : {Register::FocalX, Register::FocalY}) {
        const double focal = regs.get_double(which);
        if (!(focal > 0 && focal <= kMaxFocal)) {
            return fault(AcceleratorError::BadCamera, which);
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            camera.camera_to_world[i][j] = regs.get_double(Register::Axes, 3 * i + j);
        }
        camera.position[i] = regs.get_double(Register::Position, i);
        if (!std::isfinite(camera.position[i])) {
            return fault(AcceleratorError::BadCamera, Register::Position);
        }
    }
    return is_rotation(camera.camera_to_world) ? AcceleratorFault{}
                                               : fault(AcceleratorError::BadCamera, Register::Axes);
}

// Where the image lies in its raster, from a camera that is centred. Registers that nobody has
// written put it in the middle.
AcceleratorFault read_window(const AcceleratorRegisters& regs, Camera& camera) {
    const glm::dvec2 shift(regs.get_double(Register::ShiftX), regs.get_double(Register::ShiftY));
    if (!camera.set_principal_point(camera.principal_point() + shift)) {
        return fault(AcceleratorError::BadCamera, Register::ShiftX);
    }
    for (int axis = 0; axis < 2; ++axis) {
        const Register which = axis == 0 ? Register::OriginX : Register::OriginY;
        const std::uint32_t origin = regs.get(which);
        if (origin > kMostRasterSide) {
            return fault(AcceleratorError::BadCamera, which);
        }
        camera.shift[axis] = shift[axis]; // as it was written
        camera.origin[axis] = std::max(camera.origin[axis], static_cast<int>(origin));
    }
    return camera.has_sound_raster() ? AcceleratorFault{}
                                     : fault(AcceleratorError::BadCamera, Register::OriginX);
}

AcceleratorFault read_scene(const AcceleratorRegisters& regs, std::uint32_t max_gaussians,
                            AcceleratorRequest& request) {
    SceneCopy::Place& scene = request.scene;
    scene.geometry = regs.get_pair(Register::Geometry);
    scene.sh = regs.get_pair(Register::Sh);
    scene.count = regs.get(Register::Count);
    if (scene.count == 0 || scene.count > max_gaussians) {
        return fault(AcceleratorError::BadCount, Register::Count);
    }
    if (regs.get(Register::ShDegree) > 3) {
        return fault(AcceleratorError::BadDegree, Register::ShDegree);
    }
    scene.sh_degree = regs.get(Register::ShDegree);
    return {};
}

AcceleratorFault read_bases(const AcceleratorRegisters& regs, AcceleratorRequest& request) {
    constexpr auto kHalfFloats = static_cast<std::uint32_t>(FrameFormat::Rgba16F);
    const std::uint32_t format = regs.get(Register::Format);
    if (format > kHalfFloats) {
        return fault(AcceleratorError::BadFormat, Register::Format);
    }
    MemoryBases& bases = request.bases;
    bases.given = true;
    bases.geometry = request.scene.geometry;
    bases.sh = request.scene.sh;
    bases.workspace = regs.get_pair(Register::Workspace);
    bases.frame_buffer = regs.get_pair(Register::FrameBuffer);
    bases.pixel_bytes = format == kHalfFloats ? 8 : 4;
    request.workspace_bytes = regs.get_pair(Register::WorkspaceBytes);
    return {};
}

// Checks all bases and every pair of regions; the detail names the later region of the two.
AcceleratorFault check_regions(const AcceleratorRequest& request) {
    const std::vector<AcceleratorRequest::Region> regions = request.regions();
    constexpr std::array<Register, 4> kBases{Register::Geometry, Register::Sh, Register::Workspace,
                                             Register::FrameBuffer};
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (regions[i].begin % kBaseAlignment != 0) {
            return fault(AcceleratorError::Misaligned, kBases[i]);
        }
        if (regions[i].passes_last_address()) {
            return fault(AcceleratorError::Overlap, kBases[i]);
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (regions[i].overlaps(regions[j])) {
                return fault(AcceleratorError::Overlap, kBases[i]);
            }
        }
    }
    return {};
}

} // namespace

AcceleratorRequest AcceleratorRequest::read(const AcceleratorRegisters& registers,
                                            const Limits& limits) {
    AcceleratorRequest request;
    AcceleratorFault& found = request.fault;
    found = read_size(registers, limits.pixels, request.camera);
    found = found ? found : read_scene(registers, limits.gaussians, request);
    found = found ? found : read_bases(registers, request);
    found = found ? found : check_regions(request);
    found = found ? found : read_camera(registers, request.camera);
    found = found ? found : read_window(registers, request.camera);
    return request;
}

std::uint64_t AcceleratorRequest::frame_bytes() const {
    return camera.pixels() * bases.pixel_bytes;
}

std::vector<AcceleratorRequest::Region> AcceleratorRequest::regions() const {
    return {{scene.geometry, scene.geometry_bytes()},
            {scene.sh, scene.sh_bytes()},
            {bases.workspace, workspace_bytes},
            {bases.frame_buffer, frame_bytes()}};
}

} // namespace degs
