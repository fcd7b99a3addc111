// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/soc_host.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "config/error.hpp"
#include "platform/scene_copy.hpp"

namespace degs::sim {

SocHost::SocHost(const sc_core::sc_module_name& name, std::uint64_t registers, std::uint64_t memory,
                 std::uint64_t bytes)
    : sc_core::sc_module(name), out("out"), irq("irq"), registers_(registers), next_(memory),
      end_(memory + bytes) {
    SC_HAS_PROCESS(SocHost);
    SC_THREAD(run);
}

void SocHost::run() {
    program(*this);
    finished_ = true;
}

void SocHost::access(tlm::tlm_command command, std::uint64_t offset, std::uint32_t& value) {
    std::array<unsigned char, 4> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = value >> 8 * i & 0xFFU;
    }
    tlm::tlm_generic_payload payload;
    payload.set_command(command);
    payload.set_address(registers_ + offset);
    payload.set_data_ptr(bytes.data());
    payload.set_data_length(4);
    payload.set_streaming_width(4);
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
}

void SocHost::write(Register which, std::uint32_t value, std::uint32_t word) {
    access(tlm::TLM_WRITE_COMMAND, AcceleratorRegisters::offset_of(which) + 4 * word, value);
}

void SocHost::write_pair(Register which, std::uint64_t value, std::uint32_t pair) {
    write(which, value & 0xFFFFFFFFU, 2 * pair);
    write(which, static_cast<std::uint32_t>(value >> 32U), 2 * pair + 1);
}

void SocHost::write_double(Register which, double value, std::uint32_t pair) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    write_pair(which, bits, pair);
}

std::uint32_t SocHost::read(Register which, std::uint32_t word) {
    std::uint32_t value = 0;
    access(tlm::TLM_READ_COMMAND, AcceleratorRegisters::offset_of(which) + 4 * word, value);
    return value;
}

std::uint64_t SocHost::read_pair(Register which) {
    const std::uint64_t low = read(which);
    return low | std::uint64_t{read(which, 1)} << 32U;
}

void SocHost::debug(tlm::tlm_command command, std::uint64_t address,
                    std::vector<unsigned char>& data) {
    constexpr std::size_t kPiece = 1U << 24U;
    for (std::size_t at = 0; at < data.size(); at += kPiece) {
        tlm::tlm_generic_payload payload;
        payload.set_command(command);
        payload.set_address(address + at);
        payload.set_data_ptr(data.data() + at);
        payload.set_data_length(static_cast<unsigned int>(std::min(kPiece, data.size() - at)));
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
    write_pair(Register::Geometry, geometry_at);
    write_pair(Register::Sh, sh_at);
    write(Register::Count, static_cast<std::uint32_t>(cloud.size()));
    write(Register::ShDegree, cloud.sh_degree);
}

void SocHost::set_camera(const Camera& camera) {
    camera_ = camera;
    write(Register::Width, camera.width);
    write(Register::Height, camera.height);
    write_double(Register::FocalX, camera.fx);
    write_double(Register::FocalY, camera.fy);
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 3; ++i) {
            write_double(Register::Axes, camera.camera_to_world[axis][i], 3 * axis + i);
        }
        write_double(Register::Position, camera.position[axis], axis);
    }
}

AcceleratorError SocHost::start_and_wait() {
    write(Register::IrqEnable, kIrqDone | kIrqError);
    write(Register::Control, kControlStart);
    while (!irq.read()) {
        sc_core::wait(irq.value_changed_event());
    }
    write(Register::IrqStatus, read(Register::IrqStatus));
    while (irq.read()) {
        sc_core::wait(irq.value_changed_event());
    }
    return static_cast<AcceleratorError>(read(Register::ErrorCode));
}

// A frame without a workspace ends at once and reports the bytes that it needs.
void SocHost::reserve_memory() {
    const std::uint64_t bytes = camera_.pixels() * 4;
    for (std::uint64_t& buffer : frame_buffers_) {
        buffer = reserve(bytes);
    }
    write_pair(Register::FrameBuffer, frame_buffers_[0]);
    write_pair(Register::Workspace, next_);
    write_pair(Register::WorkspaceBytes, 0);
    if (const AcceleratorError error = start_and_wait();
        error != AcceleratorError::SmallWorkspace) {
        throw std::runtime_error("the accelerator did not ask for a workspace, error " +
                                 std::to_string(static_cast<int>(error)));
    }
    const std::uint64_t needed = read_pair(Register::WorkspaceNeeded);
    write_pair(Register::Workspace, reserve(needed));
    write_pair(Register::WorkspaceBytes, needed);
}

SocFrame SocHost::render() {
    SocFrame frame;
    frame.frame_buffer = frame_buffers_[frames_++ % frame_buffers_.size()];
    write_pair(Register::FrameBuffer, frame.frame_buffer);
    const sc_core::sc_time start = sc_core::sc_time_stamp();
    if (const AcceleratorError error = start_and_wait(); error != AcceleratorError::None) {
        throw std::runtime_error("a frame ended with error " +
                                 std::to_string(static_cast<int>(error)) + " of the accelerator");
    }
    frame.latency_ns = (sc_core::sc_time_stamp() - start).to_seconds() * 1e9;
    frame.cycles = read_pair(Register::Cycles);
    frame.load_cycles = read_pair(Register::LoadCycles);
    frame.bytes_read = read_pair(Register::BytesRead);
    frame.bytes_written = read_pair(Register::BytesWritten);
    frame.fragments = read_pair(Register::Fragments);
    return frame;
}

std::vector<unsigned char> SocHost::pixels(const SocFrame& frame) {
    std::vector<unsigned char> bytes(camera_.pixels() * 4);
    debug(tlm::TLM_READ_COMMAND, frame.frame_buffer, bytes);
    return bytes;
}

} // namespace degs::sim
