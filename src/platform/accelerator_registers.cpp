// SPDX-License-Identifier: Apache-2.0
#include "platform/accelerator_registers.hpp"

#include <cstring>

namespace degs {

const std::vector<RegisterInfo>& register_map() {
    using R = Register;
    static const std::vector<RegisterInfo> map{
        {R::Id, 1, "ID", Access::Read},
        {R::Version, 1, "VERSION", Access::Read},
        {R::Control, 1, "CONTROL", Access::Command},
        {R::Status, 1, "STATUS", Access::Read},
        {R::IrqEnable, 1, "IRQ_ENABLE", Access::ReadWrite},
        {R::IrqStatus, 1, "IRQ_STATUS", Access::WriteOneToClear},
        {R::ErrorCode, 1, "ERROR_CODE", Access::Read},
        {R::ErrorDetail, 1, "ERROR_DETAIL", Access::Read},
        {R::Geometry, 2, "GEOMETRY", Access::ReadWrite},
        {R::Sh, 2, "SH", Access::ReadWrite},
        {R::Count, 1, "COUNT", Access::ReadWrite},
        {R::ShDegree, 1, "SH_DEGREE", Access::ReadWrite},
        {R::Workspace, 2, "WORKSPACE", Access::ReadWrite},
        {R::WorkspaceBytes, 2, "WORKSPACE_BYTES", Access::ReadWrite},
        {R::FrameBuffer, 2, "FRAME_BUFFER", Access::ReadWrite},
        {R::Format, 1, "FORMAT", Access::ReadWrite},
        {R::Width, 1, "WIDTH", Access::ReadWrite},
        {R::Height, 1, "HEIGHT", Access::ReadWrite},
        {R::FocalX, 2, "FOCAL_X", Access::ReadWrite},
        {R::FocalY, 2, "FOCAL_Y", Access::ReadWrite},
        {R::Axes, 18, "AXES", Access::ReadWrite},
        {R::Position, 6, "POSITION", Access::ReadWrite},
        {R::Cycles, 2, "CYCLES", Access::Read},
        {R::LoadCycles, 2, "LOAD_CYCLES", Access::Read},
        {R::BytesRead, 2, "BYTES_READ", Access::Read},
        {R::BytesWritten, 2, "BYTES_WRITTEN", Access::Read},
        {R::Fragments, 2, "FRAGMENTS", Access::Read},
        {R::WorkspaceNeeded, 2, "WORKSPACE_NEEDED", Access::Read},
        {R::Frames, 1, "FRAMES", Access::Read},
        {R::Dropped, 1, "DROPPED", Access::Read},
    };
    return map;
}

AcceleratorRegisters::AcceleratorRegisters() {
    set(Register::Id, kAcceleratorId);
    set(Register::Version, kAcceleratorVersion);
}

std::uint64_t AcceleratorRegisters::get_pair(Register which, std::uint32_t index) const {
    const std::uint32_t low = offset_of(which) + index * 8;
    return word(low) | std::uint64_t{word(low + 4)} << 32U;
}

void AcceleratorRegisters::set_pair(Register which, std::uint64_t value) {
    set_word(offset_of(which), value & 0xFFFFFFFFU);
    set_word(offset_of(which) + 4, static_cast<std::uint32_t>(value >> 32U));
}

double AcceleratorRegisters::get_double(Register which, std::uint32_t index) const {
    const std::uint64_t bits = get_pair(which, index);
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

const RegisterInfo* AcceleratorRegisters::find(std::uint32_t offset) {
    for (const RegisterInfo& info : register_map()) {
        if (offset - offset_of(info.offset) < info.words * 4) {
            return &info;
        }
    }
    return nullptr;
}

} // namespace degs
