// SPDX-License-Identifier: Apache-2.0
#include "platform/accelerator_registers.hpp"

#include <cstring>

#include "degs/request_info.hpp"

namespace degs {

namespace {

std::uint32_t bit_of(std::uint32_t mask) {
    std::uint32_t bit = 0;
    for (; (mask >> bit & 1U) == 0; ++bit) {
    }
    return bit;
}

std::vector<RegisterField> interrupts() {
    return {{"DONE", bit_of(kIrqDone), "a frame is done"},
            {"ERROR", bit_of(kIrqError), "a frame ended with an error"},
            {"ABORTED", bit_of(kIrqAborted), "a frame has been given up"},
            {"FAULT", bit_of(kIrqFault), "an access waits for software"}};
}

std::vector<RegisterValue> formats() {
    return {{"RGBA8", static_cast<std::uint32_t>(FrameFormat::Rgba8), "4 B per pixel"},
            {"RGBA16F", static_cast<std::uint32_t>(FrameFormat::Rgba16F), "8 B per pixel"}};
}

RegisterValue error(const char* name, AcceleratorError which, const char* meaning) {
    return {name, static_cast<std::uint32_t>(which), meaning};
}

std::vector<RegisterValue> errors() {
    using E = AcceleratorError;
    return {
        error("NONE", E::None, "no error"),
        error("BAD_SIZE", E::BadSize, "width or height is 0 or too large"),
        error("BAD_COUNT", E::BadCount, "no Gaussians, or too many"),
        error("BAD_DEGREE", E::BadDegree, "SH degree over 3"),
        error("BAD_FORMAT", E::BadFormat, "unknown format"),
        error("MISALIGNED", E::Misaligned, "a base is not a multiple of 64"),
        error("OVERLAP", E::Overlap, "a region overlaps another, or passes the last address"),
        error("BAD_CAMERA", E::BadCamera, "the camera is not finite, or its axes no rotation"),
        error("SMALL_WORKSPACE", E::SmallWorkspace, "the workspace is too small"),
        error("LOAD_ERROR", E::LoadError, "memory refused a read of the scene"),
        error("BUS_ERROR", E::BusError, "memory refused an access of the frame"),
        error("SCENE_CHANGED", E::SceneChanged, "the scene was written during the frame"),
        error("OUT_OF_MEMORY", E::OutOfMemory, "the host that simulates has too little memory"),
        error("BAD_VIEW_COUNT", E::BadViewCount, "more than 64 views"),
        error("BAD_FOVEATION", E::BadFoveation,
              "a gaze outside of the image, or angles that are not in order"),
    };
}

RegisterValue stream(const char* name, RequestStream which, const char* meaning) {
    return {name, static_cast<std::uint32_t>(which), meaning};
}

std::vector<RegisterValue> streams() {
    using S = RequestStream;
    return {
        stream("OTHER", S::Other, "one without a name here"),
        stream("SCENE_LOAD", S::SceneLoad, "reading the scene before the frame"),
        stream("GEOMETRY", S::Geometry, "geometry records"),
        stream("SH", S::Sh, "SH coefficients"),
        stream("SPLATS_WRITTEN", S::SplatsWritten, "splat records, written"),
        stream("SPLATS_READ", S::SplatsRead, "splat records, read"),
        stream("TILE_LISTS_WRITTEN", S::TileListsWritten, "lists of tiles, written"),
        stream("TILE_LISTS_SORTED", S::TileListsSorted, "lists of tiles, read and sorted"),
        stream("LIST_HEADS", S::ListHeads, "where lists end"),
        stream("FRAME_BUFFER", S::FrameBuffer, "pixels"),
        stream("MEANS", S::Means, "means of the geometry"),
        stream("SHAPES", S::Shapes, "the rest of the geometry"),
        stream("GROUP_LISTS_WRITTEN", S::GroupListsWritten, "lists of groups, written"),
        stream("GROUP_LISTS_READ", S::GroupListsRead, "lists of groups, read"),
    };
}

// What a driver sets, then what the accelerator answers.
std::vector<RegisterInfo> rows() {
    using R = Register;
    constexpr Access r = Access::Read;
    constexpr Access rw = Access::ReadWrite;
    return {
        {R::Id, 1, "ID", r, "the bytes \"DeGS\"", {}, {}, kAcceleratorId},
        {R::Version, 1, "VERSION", r, "major and minor, 16 bits each", {}, {}, kAcceleratorVersion},
        {R::Control,
         1,
         "CONTROL",
         Access::Command,
         "commands",
         {{"START", bit_of(kControlStart), "start a frame"},
          {"CLEAR_ERROR", bit_of(kControlClearError),
           R"(clear the error and the flags "aborted" and "start ignored")"},
          {"RESET", bit_of(kControlReset), "reset; the other bits are ignored"},
          {"ABORT", bit_of(kControlAbort), "give up the present frame"},
          {"RESUME", bit_of(kControlResume), "issue the access that has faulted again"}}},
        {R::Status,
         1,
         "STATUS",
         r,
         "state",
         {{"BUSY", bit_of(kStatusBusy), "a frame is being rendered"},
          {"DONE", bit_of(kStatusDone), "the last frame is done"},
          {"ERROR", bit_of(kStatusError), "the last frame ended with an error"},
          {"START_IGNORED", bit_of(kStatusStartIgnored),
           "a start was ignored because the accelerator was busy"},
          {"IN_RESET", bit_of(kStatusInReset), "a reset has not ended yet"},
          {"ABORTED", bit_of(kStatusAborted), "the last frame has been given up"},
          {"FAULTED", bit_of(kStatusFaulted),
           "a refused access waits for RESUME or ABORT (an option of the model)"}}},
        {R::IrqEnable, 1, "IRQ_ENABLE", rw, "interrupts that reach `irq`", interrupts()},
        {R::IrqStatus, 1, "IRQ_STATUS", Access::WriteOneToClear,
         "pending interrupts; writing 1 clears; `irq` is high while an enabled bit is set",
         interrupts()},
        {R::ErrorCode, 1, "ERROR_CODE", r, "see errors; 0 after a start", {}, errors()},
        {R::ErrorDetail, 1, "ERROR_DETAIL", r,
         "offset of the register that is wrong, or, in the upper half, the entry of the table of "
         "views from 1 on, and in the lower half the offset in it; or the answer of the bus"},
        {R::Geometry, 2, "GEOMETRY", rw, "address of the geometry records"},
        {R::Sh, 2, "SH", rw, "address of the SH coefficients"},
        {R::Count, 1, "COUNT", rw, "Gaussians, 1 to 2^30 (an option of the model)"},
        {R::ShDegree, 1, "SH_DEGREE", rw, "0 to 3"},
        {R::Workspace, 2, "WORKSPACE", rw, "address of memory for splat records and lists"},
        {R::WorkspaceBytes, 2, "WORKSPACE_BYTES", rw, "its size"},
        {R::FrameBuffer, 2, "FRAME_BUFFER", rw, "address of the frame buffer"},
        {R::Format, 1, "FORMAT", rw, "format of a pixel", {}, formats()},
        {R::Width, 1, "WIDTH", rw, "pixels, 1 to 65536"},
        {R::Height, 1, "HEIGHT", rw,
         "pixels, 1 to 65536; at most 2^26 pixels in all (an option of the model)"},
        {R::FocalX, 2, "FOCAL_X", rw, "double, focal length in pixels of the width"},
        {R::FocalY, 2, "FOCAL_Y", rw, "double, focal length in pixels of the height"},
        {R::Axes, 18, "AXES", rw,
         "9 doubles: view axes x (right), y (down), z (forward) in world space"},
        {R::Position, 6, "POSITION", rw, "3 doubles: camera centre in world space"},
        {R::ShiftX, 2, "SHIFT_X", rw,
         "double, pixels from the middle of the image to the right, where the principal point is"},
        {R::ShiftY, 2, "SHIFT_Y", rw, "double, the same downwards"},
        {R::OriginX, 1, "ORIGIN_X", rw,
         "first column of the image in its raster, whose tiles begin at column 0; at least -2 "
         "`SHIFT_X`, rounded down, is taken"},
        {R::OriginY, 1, "ORIGIN_Y", rw, "the same of its first row"},
        {R::Cycles, 2, "CYCLES", r, "of the last frame: scene loaded to last pixel in memory"},
        {R::LoadCycles, 2, "LOAD_CYCLES", r,
         "of the last frame: reading the scene; 0 if the memory has debug transport"},
        {R::BytesRead, 2, "BYTES_READ", r,
         "of the last frame, in `CYCLES`: of its transactions, full bursts as a whole"},
        {R::BytesWritten, 2, "BYTES_WRITTEN", r, "of the last frame, likewise"},
        {R::Fragments, 2, "FRAGMENTS", r,
         "of the last frame: pixel updates; with outward span ends more than its useful PE slots"},
        {R::WorkspaceNeeded, 2, "WORKSPACE_NEEDED", r,
         "of the last frame, bytes; 0 if its scene could not be loaded"},
        {R::Frames, 1, "FRAMES", r,
         "frames rendered so far, those with a bus error or a changed scene included"},
        {R::Dropped, 1, "DROPPED", r, "of the last frame: Gaussians that no renderer can draw"},
        {R::FrameEnergy, 2, "FRAME_ENERGY", r,
         "of the last frame, nJ: what its blocks have done, and leakage over `CYCLES`; without the "
         "memory"},
        {R::ViewCount, 1, "VIEW_COUNT", rw,
         "views in the table, up to 64; 0: `FRAME_BUFFER` and the registers from `WIDTH` to "
         "`ORIGIN_Y` describe the one view"},
        {R::View, 1, "VIEW", rw,
         "drawn view, from 0 on, of which the registers from `VIEW_SCALE` on tell whose names "
         "begin "
         "with VIEW"},
        {R::Views, 2, "VIEWS", rw, "address of the table of views"},
        {R::ViewsDrawn, 1, "VIEWS_DRAWN", r,
         "of the last frame: its drawn views; each level of a foveated view is one"},
        {R::ViewScale, 1, "VIEW_SCALE", r,
         "pixels of the image along a side of a pixel of the drawn view: 1, 2 or 4; 0 if there is "
         "no such view"},
        {R::ViewAddress, 2, "VIEW_ADDRESS", r, "address of its pixels"},
        {R::ViewCycles, 2, "VIEW_CYCLES", r,
         "of the last frame: scene loaded to last pixel of this view, and those before it, in "
         "memory"},
        {R::ViewFragments, 2, "VIEW_FRAGMENTS", r, "its part of `FRAGMENTS`"},
        {R::ViewWidth, 1, "VIEW_WIDTH", r, "its pixels in a row"},
        {R::ViewHeight, 1, "VIEW_HEIGHT", r, "its rows"},
        {R::ViewX, 1, "VIEW_X", r, "its first column among all of its size in the image"},
        {R::ViewY, 1, "VIEW_Y", r, "the same of its first row"},
        {R::FaultAddress, 2, "FAULT_ADDRESS", r,
         "of the access that has faulted, or of the last one; 0 after a start"},
        {R::FaultStream, 1, "FAULT_STREAM", r, "its stream", {}, streams()},
        {R::FaultAnswer, 1, "FAULT_ANSWER", r, "the answer of the bus to it"},
        {R::IdleEnergy, 2, "IDLE_ENERGY", r,
         "of the last frame, nJ: leakage before it, from the end of the frame before, or from "
         "power-on or reset on"},
        {R::Power,
         1,
         "POWER",
         rw,
         "power states",
         {{"GATE_IDLE", bit_of(kPowerGateIdle),
           "the supply is gated while no frame is being rendered"}}},
        {R::ViewShown, 4, "VIEW_SHOWN", r,
         "first column and row, width and height of what it shows of the image, in pixels of the "
         "image, with what finer levels show"},
        {R::ViewEntry, 1, "VIEW_ENTRY", r, "entry of the table, from 0 on, that it belongs to"},
    };
}

std::vector<RegisterValue> lenses() {
    const auto value = [](const char* name, LensKind kind, const char* meaning) {
        return RegisterValue{name, static_cast<std::uint32_t>(kind), meaning};
    };
    return {value("PINHOLE", LensKind::Pinhole, "all coefficients are 0"),
            value("OPENCV", LensKind::OpenCv, "OpenCV's lens"),
            value("FISHEYE", LensKind::Fisheye, "OpenCV's fisheye")};
}

std::vector<ViewFieldInfo> entry_rows() {
    using F = ViewField;
    using R = Register;
    return {
        {F::FrameBuffer, 2, "FRAME_BUFFER", "", {}, R::FrameBuffer},
        {F::Width, 1, "WIDTH", "", {}, R::Width},
        {F::Height, 1, "HEIGHT", "", {}, R::Height},
        {F::FocalX, 2, "FOCAL_X", "", {}, R::FocalX},
        {F::FocalY, 2, "FOCAL_Y", "", {}, R::FocalY},
        {F::Axes, 18, "AXES", "", {}, R::Axes},
        {F::Position, 6, "POSITION", "", {}, R::Position},
        {F::ShiftX, 2, "SHIFT_X", "", {}, R::ShiftX},
        {F::ShiftY, 2, "SHIFT_Y", "", {}, R::ShiftY},
        {F::OriginX, 1, "ORIGIN_X", "", {}, R::OriginX},
        {F::OriginY, 1, "ORIGIN_Y", "", {}, R::OriginY},
        {F::Lens, 1, "LENS", "kind of lens", lenses()},
        {F::Radial, 8, "RADIAL",
         "4 doubles: k1, k2, k3 and the factor of r^8; of a fisheye k1 to k4"},
        {F::Denominator, 6, "DENOMINATOR", "3 doubles: k4, k5, k6 of OpenCV's lens"},
        {F::Tangential, 4, "TANGENTIAL", "2 doubles: p1, p2 of OpenCV's lens"},
        {F::GazeX, 2, "GAZE_X",
         "double, point looked at, in shares of the width from the left, 0 to 1"},
        {F::GazeY, 2, "GAZE_Y", "double, the same of the height from the top"},
        {F::Fovea, 2, "FOVEA",
         "double, degrees from there with full resolution, up to 90; 0: the view is not foveated"},
        {F::Periphery, 2, "PERIPHERY", "double, degrees from there with half of it, `FOVEA` to 90"},
    };
}

} // namespace

std::uint32_t RegisterInfo::bits() const {
    if (fields.empty()) {
        return ~std::uint32_t{0};
    }
    std::uint32_t bits = 0;
    for (const RegisterField& field : fields) {
        bits |= 1U << field.bit;
    }
    return bits;
}

const std::vector<RegisterInfo>& register_map() {
    static const std::vector<RegisterInfo> map = rows();
    return map;
}

// A field that has the name of a register has its meaning, too.
const std::vector<ViewFieldInfo>& view_layout() {
    static const std::vector<ViewFieldInfo> layout = [] {
        std::vector<ViewFieldInfo> rows = entry_rows();
        for (ViewFieldInfo& field : rows) {
            for (const RegisterInfo& info : register_map()) {
                if (field.same != Register::Id && info.offset == field.same) {
                    field.meaning = info.meaning;
                }
            }
        }
        return rows;
    }();
    return layout;
}

AcceleratorRegisters::AcceleratorRegisters() {
    for (const RegisterInfo& info : register_map()) {
        for (std::uint32_t i = 0; i < info.words; ++i) {
            set_word(offset_of(info.offset) + 4 * i, info.reset);
        }
    }
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
