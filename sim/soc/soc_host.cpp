// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/soc_host.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "degs/error.hpp"
#include "platform/scene_copy.hpp"
#include "tlm/has_process.hpp"
#include "tlm/set_access.hpp"

namespace degs::sim {
namespace {

degs_camera camera_words(const Camera& camera) {
    degs_camera view{};
    view.width = static_cast<std::uint32_t>(camera.width);
    view.height = static_cast<std::uint32_t>(camera.height);
    view.focal_x = camera.fx;
    view.focal_y = camera.fy;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 3; ++i) {
            view.axes[3 * axis + i] = camera.camera_to_world[axis][i];
        }
        view.position[axis] = camera.position[axis];
    }
    return view;
}

degs_view view_of(const Camera& camera, const std::optional<Foveation>& foveation) {
    degs_view view{};
    view.camera = camera_words(camera);
    view.window = {camera.shift.x, camera.shift.y, static_cast<std::uint32_t>(camera.origin.x),
                   static_cast<std::uint32_t>(camera.origin.y)};
    const LensCoefficients& lens = camera.lens.coefficients();
    view.lens.kind = static_cast<std::uint32_t>(lens.kind);
    std::copy(lens.radial.begin(), lens.radial.end(), view.lens.radial);
    std::copy(lens.denominator.begin(), lens.denominator.end(), view.lens.denominator);
    std::copy(lens.tangential.begin(), lens.tangential.end(), view.lens.tangential);
    if (foveation) {
        view.gaze = {foveation->centre.x, foveation->centre.y, foveation->fovea,
                     foveation->periphery};
    }
    return view;
}

/// The size of the frame buffer of an image, whose levels lie one behind the other.
std::uint64_t bytes_of(const FoveatedView& image) {
    constexpr std::uint64_t kAlignment = DEGS_BASE_ALIGNMENT;
    std::uint64_t bytes = 0;
    for (const FoveatedLevel& level : image.levels) {
        bytes += (4 * level.camera.pixels() + kAlignment - 1) / kAlignment * kAlignment;
    }
    return bytes;
}

} // namespace

SocHost::SocHost(const sc_core::sc_module_name& name, std::uint64_t registers, std::uint64_t memory,
                 std::uint64_t bytes)
    : sc_core::sc_module(name), out("out"),
      irq("irq"), device_{this,
                          [](void* host, std::uint32_t offset) {
                              return static_cast<SocHost*>(host)->access(tlm::TLM_READ_COMMAND,
                                                                         offset, 0);
                          },
                          [](void* host, std::uint32_t offset, std::uint32_t value) {
                              static_cast<SocHost*>(host)->access(tlm::TLM_WRITE_COMMAND, offset,
                                                                  value);
                          }},
      registers_(registers), next_(memory), end_(memory + bytes) {
    DEGS_HAS_PROCESS(SocHost);
    SC_THREAD(run);
}

void SocHost::run() {
    program(*this);
    finished_ = true;
}

std::uint32_t SocHost::access(tlm::tlm_command command, std::uint32_t offset, std::uint32_t value) {
    std::array<unsigned char, 4> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = value >> 8 * i & 0xFFU;
    }
    tlm::tlm_generic_payload payload;
    set_access(payload, command, registers_ + offset, bytes.data(), bytes.size());
    sc_core::sc_time delay = sc_core::SC_ZERO_TIME;
    out->b_transport(payload, delay);
    sc_core::wait(delay);
    if (payload.is_response_error()) {
        throw std::runtime_error("the accelerator refused an access to register offset " +
                                 std::to_string(offset));
    }
    value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        value |= std::uint32_t{bytes[i]} << 8 * i;
    }
    return value;
}

void SocHost::debug(tlm::tlm_command command, std::uint64_t address,
                    std::vector<unsigned char>& data) {
    constexpr std::size_t kPiece = 1U << 24U;
    for (std::size_t at = 0; at < data.size(); at += kPiece) {
        tlm::tlm_generic_payload payload;
        set_access(payload, command, address + at, data.data() + at,
                   std::min(kPiece, data.size() - at));
        if (out->transport_dbg(payload) != payload.get_data_length()) {
            throw std::runtime_error("the memory has no debug transport at address " +
                                     std::to_string(address + at));
        }
    }
}

std::uint64_t SocHost::reserve(std::uint64_t bytes) {
    constexpr std::uint64_t kPage = 4096;
    const std::uint64_t size = (bytes + kPage - 1) / kPage * kPage;
    if (size > end_ - next_) {
        throw InputError("The scene does not fit into the memory of this platform: " +
                         std::to_string(size - (end_ - next_)) +
                         " bytes are missing; half of the memory is the accelerator's.");
    }
    next_ += size;
    return next_ - size;
}

void SocHost::load_scene(const GaussianCloud& cloud) {
    std::vector<unsigned char> geometry;
    std::vector<unsigned char> sh;
    encode_scene(cloud, geometry, sh);
    const std::uint64_t geometry_at = reserve(geometry.size());
    const std::uint64_t sh_at = reserve(sh.size());
    debug(tlm::TLM_WRITE_COMMAND, geometry_at, geometry);
    debug(tlm::TLM_WRITE_COMMAND, sh_at, sh);
    const degs_scene scene{geometry_at, sh_at, static_cast<std::uint32_t>(cloud.size()),
                           static_cast<std::uint32_t>(cloud.sh_degree)};
    degs_set_scene(&device_, &scene);
}

void SocHost::set_images(const std::vector<FoveatedView>& images,
                         const std::optional<Foveation>& foveation) {
    views_.clear();
    for (const FoveatedView& image : images) {
        views_.push_back(view_of(image.camera, foveation));
        for (Target& target : targets_) {
            target.frame_buffers.push_back(reserve(bytes_of(image)));
        }
    }
    in_table_ = images.size() > 1 || foveation || !images.front().camera.lens.is_pinhole();
    for (Target& target : targets_) {
        if (in_table_) {
            target.table = reserve(views_.size() * DEGS_VIEW_BYTES);
            write_table(target);
        }
    }
    if (!in_table_) {
        if (!images.front().camera.is_centred()) {
            degs_set_window(&device_, &views_.front().window);
        }
        degs_set_camera(&device_, &views_.front().camera);
    }
}

void SocHost::write_table(const Target& target) {
    std::vector<unsigned char> table(views_.size() * DEGS_VIEW_BYTES);
    for (std::size_t v = 0; v < views_.size(); ++v) {
        views_[v].frame_buffer = target.frame_buffers[v];
        degs_encode_view(&views_[v], table.data() + v * DEGS_VIEW_BYTES);
    }
    debug(tlm::TLM_WRITE_COMMAND, target.table, table);
}

void SocHost::set_target(const Target& target) {
    degs_set_frame_buffer(&device_, target.frame_buffers.front(), DEGS_FORMAT_RGBA8);
    if (in_table_) {
        degs_set_views(&device_, target.table, static_cast<std::uint32_t>(views_.size()));
    }
}

std::uint32_t SocHost::start_and_wait() {
    degs_start(&device_, DEGS_IRQ_ENABLE_DONE | DEGS_IRQ_ENABLE_ERROR);
    while (!irq.read()) {
        sc_core::wait(irq.value_changed_event());
    }
    degs_acknowledge(&device_);
    while (irq.read()) {
        sc_core::wait(irq.value_changed_event());
    }
    return degs_error(&device_);
}

// A frame without a workspace ends at once and reports the bytes that it needs.
void SocHost::reserve_memory() {
    if (degs_probe(&device_) == 0) {
        throw std::runtime_error("the driver does not know these registers");
    }
    set_target(targets_[0]);
    degs_set_workspace(&device_, next_, 0);
    if (const std::uint32_t error = start_and_wait(); error != DEGS_ERROR_CODE_SMALL_WORKSPACE) {
        throw std::runtime_error("the accelerator did not ask for a workspace, error " +
                                 std::to_string(error));
    }
    const std::uint64_t needed = degs_workspace_needed(&device_);
    degs_set_workspace(&device_, reserve(needed), needed);
}

SocFrame SocHost::render() {
    SocFrame frame;
    const Target& target = targets_[frames_++ % targets_.size()];
    set_target(target);
    const sc_core::sc_time start = sc_core::sc_time_stamp();
    if (const std::uint32_t error = start_and_wait(); error != DEGS_ERROR_CODE_NONE) {
        throw std::runtime_error("a frame ended with error " + std::to_string(error) +
                                 " of the accelerator");
    }
    frame.latency_ns = (sc_core::sc_time_stamp() - start).to_seconds() * 1e9;
    degs_counters counters{};
    degs_read_counters(&device_, &counters);
    frame.cycles = counters.cycles;
    frame.bytes_read = counters.bytes_read;
    frame.bytes_written = counters.bytes_written;
    frame.fragments = counters.fragments;
    frame.energy_nj = counters.frame_energy;
    frame.views = in_table_ ? drawn_views() : std::vector<degs_drawn_view>{only_view(target)};
    check_pixels(frame);
    return frame;
}

std::vector<degs_drawn_view> SocHost::drawn_views() {
    std::vector<degs_drawn_view> views(degs_views_drawn(&device_));
    for (std::size_t v = 0; v < views.size(); ++v) {
        degs_read_view(&device_, static_cast<std::uint32_t>(v), &views[v]);
    }
    return views;
}

// The program knows all about the one view that registers describe, and reads none of them.
degs_drawn_view SocHost::only_view(const Target& target) const {
    degs_drawn_view view{};
    view.scale = 1;
    view.address = target.frame_buffers.front();
    view.width = views_.front().camera.width;
    view.height = views_.front().camera.height;
    return view;
}

void SocHost::check_pixels(const SocFrame& frame) {
    Pixels pixels;
    for (const degs_drawn_view& view : frame.views) {
        pixels.emplace_back(std::size_t{4} * view.width * view.height);
        debug(tlm::TLM_READ_COMMAND, view.address, pixels.back());
    }
    if (pixels_.empty()) {
        pixels_ = pixels;
    } else if (pixels_ != pixels) {
        throw std::logic_error("the model is broken: pixels depend on the memory's load");
    }
}

} // namespace degs::sim
