// SPDX-License-Identifier: Apache-2.0
#include "platform/accelerator_request.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace degs {
namespace {

constexpr std::uint32_t kMaxSide = 65536; // px, as in cameras.json
constexpr double kMaxFocal = 1e9;         // px, as in cameras.json
constexpr double kRotationSlack = 1e-3;   // of the products of two axes

AcceleratorFault fault_of(AcceleratorError error, Register which) {
    return {error, AcceleratorRegisters::offset_of(which)};
}

AcceleratorFault read_size(const AcceleratorRegisters& regs, std::uint64_t max_pixels,
                           Camera& camera) {
    const std::uint32_t width = regs.get(Register::Width);
    const std::uint32_t height = regs.get(Register::Height);
    if (width == 0 || width > kMaxSide) {
        return fault_of(AcceleratorError::BadSize, Register::Width);
    }
    if (height == 0 || height > kMaxSide || std::uint64_t{width} * height > max_pixels) {
        return fault_of(AcceleratorError::BadSize, Register::Height);
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

// Where the image lies in its raster, from a camera that is centred. Registers that nobody has
// written put it in the middle.
AcceleratorFault read_window(const AcceleratorRegisters& regs, Camera& camera) {
    const glm::dvec2 shift(regs.get_double(Register::ShiftX), regs.get_double(Register::ShiftY));
    if (!camera.set_principal_point(camera.principal_point() + shift)) {
        return fault_of(AcceleratorError::BadCamera, Register::ShiftX);
    }
    for (int axis = 0; axis < 2; ++axis) {
        const Register which = axis == 0 ? Register::OriginX : Register::OriginY;
        const std::uint32_t origin = regs.get(which);
        if (origin > kMostRasterSide) {
            return fault_of(AcceleratorError::BadCamera, which);
        }
        camera.shift[axis] = shift[axis]; // as it was written
        camera.origin[axis] = std::max(camera.origin[axis], static_cast<int>(origin));
    }
    return camera.has_sound_raster() ? AcceleratorFault{}
                                     : fault_of(AcceleratorError::BadCamera, Register::OriginX);
}

AcceleratorFault read_camera(const AcceleratorRegisters& regs, Camera& camera) {
    camera.fx = regs.get_double(Register::FocalX);
    camera.fy = regs.get_double(Register::FocalY);
    for (const Register which : {Register::FocalX, Register::FocalY}) {
        const double focal = regs.get_double(which);
        if (!(focal > 0 && focal <= kMaxFocal)) {
            return fault_of(AcceleratorError::BadCamera, which);
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            camera.camera_to_world[i][j] = regs.get_double(Register::Axes, 3 * i + j);
        }
        camera.position[i] = regs.get_double(Register::Position, i);
        if (!std::isfinite(camera.position[i])) {
            return fault_of(AcceleratorError::BadCamera, Register::Position);
        }
    }
    return is_rotation(camera.camera_to_world)
               ? read_window(regs, camera)
               : fault_of(AcceleratorError::BadCamera, Register::Axes);
}

AcceleratorFault read_scene(const AcceleratorRegisters& regs, std::uint32_t max_gaussians,
                            AcceleratorRequest& request) {
    SceneCopy::Place& scene = request.scene;
    scene.geometry = regs.get_pair(Register::Geometry);
    scene.sh = regs.get_pair(Register::Sh);
    scene.count = regs.get(Register::Count);
    if (scene.count == 0 || scene.count > max_gaussians) {
        return fault_of(AcceleratorError::BadCount, Register::Count);
    }
    if (regs.get(Register::ShDegree) > 3) {
        return fault_of(AcceleratorError::BadDegree, Register::ShDegree);
    }
    scene.sh_degree = regs.get(Register::ShDegree);
    return {};
}

AcceleratorFault read_bases(const AcceleratorRegisters& regs, AcceleratorRequest& request) {
    constexpr auto kHalfFloats = static_cast<std::uint32_t>(FrameFormat::Rgba16F);
    const std::uint32_t format = regs.get(Register::Format);
    if (format > kHalfFloats) {
        return fault_of(AcceleratorError::BadFormat, Register::Format);
    }
    MemoryBases& bases = request.bases;
    bases.given = true;
    bases.geometry = request.scene.geometry;
    bases.sh = request.scene.sh;
    bases.workspace = regs.get_pair(Register::Workspace);
    bases.pixel_bytes = format == kHalfFloats ? 8 : 4;
    request.workspace_bytes = regs.get_pair(Register::WorkspaceBytes);
    return {};
}

std::uint64_t aligned(std::uint64_t address) {
    return (address + kBaseAlignment - 1) / kBaseAlignment * kBaseAlignment;
}

std::uint32_t word_at(const unsigned char* entry, std::uint32_t offset) {
    std::uint32_t value = 0;
    for (std::uint32_t i = 4; i-- > 0;) {
        value = value << 8U | entry[offset + i];
    }
    return value;
}

double double_at(const unsigned char* entry, ViewField field, std::uint32_t index = 0) {
    const std::uint32_t offset = static_cast<std::uint32_t>(field) + 8 * index;
    const std::uint64_t bits = word_at(entry, offset) | std::uint64_t{word_at(entry, offset + 4)}
                                                            << 32U;
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

// The registers that have the fields of an entry; the others are those of power-on.
AcceleratorRegisters registers_of(const unsigned char* entry) {
    AcceleratorRegisters words;
    for (const ViewFieldInfo& field : view_layout()) {
        for (std::uint32_t i = 0; field.same != Register::Id && i < field.words; ++i) {
            words.set_word(AcceleratorRegisters::offset_of(field.same) + 4 * i,
                           word_at(entry, static_cast<std::uint32_t>(field.offset) + 4 * i));
        }
    }
    return words;
}

// The field that a register of registers_of() has.
ViewField field_of(std::uint32_t register_offset) {
    for (const ViewFieldInfo& field : view_layout()) {
        if (field.same != Register::Id &&
            AcceleratorRegisters::offset_of(field.same) == register_offset) {
            return field.offset;
        }
    }
    throw std::logic_error("a view has a register that no entry of the table has");
}

template <std::size_t kCount>
void read_coefficients(const unsigned char* entry, ViewField field,
                       std::array<double, kCount>& values) {
    for (std::uint32_t i = 0; i < kCount; ++i) {
        values[i] = double_at(entry, field, i);
    }
}

AcceleratorFault read_lens(const unsigned char* bytes, std::uint32_t entry, Camera& camera) {
    const std::uint32_t kind = word_at(bytes, static_cast<std::uint32_t>(ViewField::Lens));
    const AcceleratorFault wrong{AcceleratorError::BadCamera,
                                 detail_of_view(entry, ViewField::Lens)};
    if (kind > static_cast<std::uint32_t>(LensKind::Fisheye)) {
        return wrong;
    }
    LensCoefficients lens;
    lens.kind = static_cast<LensCoefficients::Kind>(kind);
    read_coefficients(bytes, ViewField::Radial, lens.radial);
    read_coefficients(bytes, ViewField::Denominator, lens.denominator);
    read_coefficients(bytes, ViewField::Tangential, lens.tangential);
    camera.lens = Lens(lens);
    return camera.lens.is_sound() ? AcceleratorFault{} : wrong;
}

// Conditions are phrased so that NaN fails.
AcceleratorFault read_gaze(const unsigned char* bytes, std::uint32_t entry,
                           std::optional<Foveation>& foveation) {
    constexpr double kMostDegrees = 90;
    const auto value = [bytes](ViewField field) { return double_at(bytes, field); };
    const double fovea = value(ViewField::Fovea), periphery = value(ViewField::Periphery);
    if (fovea == 0) {
        return {};
    }
    const auto wrong = [entry](ViewField field) {
        return AcceleratorFault{AcceleratorError::BadFoveation, detail_of_view(entry, field)};
    };
    for (const ViewField place : {ViewField::GazeX, ViewField::GazeY}) {
        if (!(value(place) >= 0 && value(place) <= 1)) {
            return wrong(place);
        }
    }
    if (!(fovea > 0 && fovea <= kMostDegrees)) {
        return wrong(ViewField::Fovea);
    }
    if (!(periphery >= fovea && periphery <= kMostDegrees)) {
        return wrong(ViewField::Periphery);
    }
    foveation = Foveation{{value(ViewField::GazeX), value(ViewField::GazeY)}, fovea, periphery};
    return {};
}

} // namespace

AcceleratorRequest AcceleratorRequest::read(const AcceleratorRegisters& registers,
                                            const Limits& limits) {
    AcceleratorRequest request;
    AcceleratorFault& found = request.fault;
    RequestedView view;
    request.table.entries = registers.get(Register::ViewCount);
    if (request.table.entries > kMostViews) {
        found = fault_of(AcceleratorError::BadViewCount, Register::ViewCount);
    } else if (request.table.entries == 0) {
        found = read_size(registers, limits.pixels, view.camera);
    }
    found = found ? found : read_scene(registers, limits.gaussians, request);
    found = found ? found : read_bases(registers, request);
    request.table.address = registers.get_pair(Register::Views);
    if (request.table.entries != 0) {
        found = found ? found : request.check_regions();
        return request;
    }
    view.frame_buffer = registers.get_pair(Register::FrameBuffer);
    request.views.push_back(view);
    found = found ? found : request.check_regions();
    found = found ? found : read_camera(registers, request.views.front().camera);
    return request;
}

// Every entry is checked as the registers are that have its fields.
void AcceleratorRequest::read_table(const std::vector<unsigned char>& bytes, const Limits& limits) {
    std::uint64_t room = limits.pixels;
    for (std::uint32_t entry = 0; entry < table.entries; ++entry) {
        const AcceleratorRegisters words = registers_of(bytes.data() + entry * kViewBytes);
        RequestedView view;
        view.frame_buffer = words.get_pair(Register::FrameBuffer);
        AcceleratorFault found = read_size(words, room, view.camera);
        found = found ? found : read_camera(words, view.camera);
        if (found) {
            fault = {found.error, detail_of_view(entry, field_of(found.detail))};
            return;
        }
        room -= view.camera.pixels();
        fault = read_lens(bytes.data() + entry * kViewBytes, entry, view.camera);
        fault = fault ? fault : read_gaze(bytes.data() + entry * kViewBytes, entry, view.foveation);
        if (fault) {
            return;
        }
        views.push_back(view);
    }
    fault = check_regions();
}

// Checks all bases and every pair of regions; the detail names the later region of the two.
AcceleratorFault AcceleratorRequest::check_regions() const {
    const std::vector<NamedRegion> all = regions();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].begin % kBaseAlignment != 0) {
            return {AcceleratorError::Misaligned, all[i].detail};
        }
        if (all[i].passes_last_address()) {
            return {AcceleratorError::Overlap, all[i].detail};
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (all[i].overlaps(all[j])) {
                return {AcceleratorError::Overlap, all[i].detail};
            }
        }
    }
    return {};
}

std::vector<AcceleratorRequest::NamedRegion> AcceleratorRequest::regions() const {
    const auto of = [](Register which) { return AcceleratorRegisters::offset_of(which); };
    std::vector<NamedRegion> all{{{scene.geometry, scene.geometry_bytes()}, of(Register::Geometry)},
                                 {{scene.sh, scene.sh_bytes()}, of(Register::Sh)},
                                 {{bases.workspace, workspace_bytes}, of(Register::Workspace)}};
    if (table.entries != 0) {
        all.push_back({{table.address, table.bytes()}, of(Register::Views)});
    }
    for (std::uint32_t v = 0; v < views.size(); ++v) {
        all.push_back({{views[v].frame_buffer, frame_bytes(views[v])},
                       table.entries == 0 ? of(Register::FrameBuffer)
                                          : detail_of_view(v, ViewField::FrameBuffer)});
    }
    return all;
}

std::uint64_t AcceleratorRequest::frame_bytes(const RequestedView& view) const {
    std::uint64_t end = 0;
    for (const FoveatedLevel& level : view.levels()) {
        end = aligned(end) + level.camera.pixels() * bases.pixel_bytes;
    }
    return end;
}

std::vector<DrawnView> AcceleratorRequest::drawn_views() const {
    std::vector<DrawnView> all;
    for (std::uint32_t v = 0; v < views.size(); ++v) {
        std::uint64_t end = views[v].frame_buffer;
        for (const FoveatedLevel& level : views[v].levels()) {
            DrawnView drawn{level};
            drawn.entry = v;
            drawn.address = aligned(end);
            end = drawn.address + level.camera.pixels() * bases.pixel_bytes;
            all.push_back(drawn);
        }
    }
    return all;
}

std::vector<FoveatedLevel> RequestedView::levels() const {
    return foveation ? levels_of(camera, *foveation)
                     : std::vector<FoveatedLevel>{
                           {1, {0, 0, camera.width - 1, camera.height - 1}, {0, 0}, camera}};
}

} // namespace degs
