// SPDX-License-Identifier: Apache-2.0
// The registers of degs::Accelerator for programs in C++. docs/accelerator.md has the table, and
// degs_registers.h the same numbers for programs in C.
#pragma once

#include <cstdint>

namespace degs {

/// Byte offsets. Values of 64 bits are pairs, the low word first.
enum class Register : std::uint32_t {
    Id = 0x000,
    Version = 0x004,
    Control = 0x008,
    Status = 0x00C,
    IrqEnable = 0x010,
    IrqStatus = 0x014,
    ErrorCode = 0x018,
    ErrorDetail = 0x01C,
    Geometry = 0x020,
    Sh = 0x028,
    Count = 0x030,
    ShDegree = 0x034,
    Workspace = 0x038,
    WorkspaceBytes = 0x040,
    FrameBuffer = 0x048,
    Format = 0x050,
    Width = 0x054,
    Height = 0x058,
    FocalX = 0x060,
    FocalY = 0x068,
    Axes = 0x070,
    Position = 0x0B8,
    ShiftX = 0x0D0,
    ShiftY = 0x0D8,
    OriginX = 0x0E0,
    OriginY = 0x0E4,
    Cycles = 0x100,
    LoadCycles = 0x108,
    BytesRead = 0x110,
    BytesWritten = 0x118,
    Fragments = 0x120,
    WorkspaceNeeded = 0x128,
    Frames = 0x130,
    Dropped = 0x134,
    FrameEnergy = 0x138,
    ViewCount = 0x140,
    View = 0x144,
    Views = 0x148,
    ViewsDrawn = 0x150,
    ViewScale = 0x154,
    ViewAddress = 0x158,
    ViewCycles = 0x160,
    ViewFragments = 0x168,
    ViewWidth = 0x170,
    ViewHeight = 0x174,
    ViewX = 0x178,
    ViewY = 0x17C,
    FaultAddress = 0x180,
    FaultStream = 0x188,
    FaultAnswer = 0x18C,
    IdleEnergy = 0x190,
    Power = 0x198,
    ViewShown = 0x200,
    ViewEntry = 0x210,
};
constexpr std::uint32_t kRegisterBytes = 0x214;
constexpr std::uint32_t kAcceleratorId = 0x53476544; ///< "DeGS" as bytes
constexpr std::uint32_t kAcceleratorVersion = 0x00010004;

// Bits of Control, Status, of IrqEnable and IrqStatus, and of Power.
constexpr std::uint32_t kControlStart = 1U << 0U;
constexpr std::uint32_t kControlClearError = 1U << 1U;
constexpr std::uint32_t kControlReset = 1U << 2U;
constexpr std::uint32_t kControlAbort = 1U << 3U;
constexpr std::uint32_t kControlResume = 1U << 4U;
constexpr std::uint32_t kStatusBusy = 1U << 0U;
constexpr std::uint32_t kStatusDone = 1U << 1U;
constexpr std::uint32_t kStatusError = 1U << 2U;
constexpr std::uint32_t kStatusStartIgnored = 1U << 3U;
constexpr std::uint32_t kStatusInReset = 1U << 4U;
constexpr std::uint32_t kStatusAborted = 1U << 5U;
constexpr std::uint32_t kStatusFaulted = 1U << 6U;
constexpr std::uint32_t kIrqDone = 1U << 0U;
constexpr std::uint32_t kIrqError = 1U << 1U;
constexpr std::uint32_t kIrqAborted = 1U << 2U;
constexpr std::uint32_t kIrqFault = 1U << 3U;
constexpr std::uint32_t kPowerGateIdle = 1U << 0U;

enum class FrameFormat : std::uint32_t { Rgba8 = 0, Rgba16F = 1 };

/// Why a frame was not rendered, or cannot be trusted.
enum class AcceleratorError : std::uint32_t {
    None = 0,
    BadSize = 1,        ///< width or height 0 or over 65536, or too many pixels
    BadCount = 2,       ///< no Gaussians, or too many
    BadDegree = 3,      ///< SH degree over 3
    BadFormat = 4,      ///< no FrameFormat
    Misaligned = 5,     ///< a base is not a multiple of kBaseAlignment
    Overlap = 6,        ///< two regions overlap, or one passes the end of the address space
    BadCamera = 7,      ///< not finite, focal length not positive, axes not orthonormal, or the
                        ///< image outside its raster
    SmallWorkspace = 8, ///< WorkspaceNeeded holds the bytes that it takes
    LoadError = 9,      ///< memory refused a read while the scene was loaded
    BusError = 10,      ///< memory refused an access while the frame was rendered
    SceneChanged = 11,  ///< the scene was written while the frame was rendered
    OutOfMemory = 12,   ///< of the host that simulates
    BadViewCount = 13,  ///< more views than kMostViews
    BadFoveation = 14,  ///< a gaze that is not in the image, or angles that are not in order
};
constexpr std::uint64_t kBaseAlignment = 64; ///< B

/// Byte offsets in an entry of the table of views, which has the layout of registers.
enum class ViewField : std::uint32_t {
    FrameBuffer = 0x000,
    Width = 0x008,
    Height = 0x00C,
    FocalX = 0x010,
    FocalY = 0x018,
    Axes = 0x020,
    Position = 0x068,
    ShiftX = 0x080,
    ShiftY = 0x088,
    OriginX = 0x090,
    OriginY = 0x094,
    Lens = 0x098,
    Radial = 0x0A0,
    Denominator = 0x0C0,
    Tangential = 0x0D8,
    GazeX = 0x0E8,
    GazeY = 0x0F0,
    Fovea = 0x0F8,
    Periphery = 0x100,
};
constexpr std::uint32_t kViewBytes = 0x140; ///< of an entry
constexpr std::uint32_t kMostViews = 64;    ///< of a table

enum class LensKind : std::uint32_t { Pinhole = 0, OpenCv = 1, Fisheye = 2 };

/// ErrorDetail of something that is wrong in the table: the entry, counted from 1, in the upper
/// half, and the offset in it in the lower half. The upper half of a register's offset is 0.
constexpr std::uint32_t detail_of_view(std::uint32_t entry, ViewField field) {
    return (entry + 1) << 16U | static_cast<std::uint32_t>(field);
}

} // namespace degs
