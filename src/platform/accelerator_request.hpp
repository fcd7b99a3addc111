// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "degs/options.hpp"
#include "modules/kit/job/traffic.hpp"
#include "platform/accelerator_registers.hpp"
#include "platform/scene_copy.hpp"
#include "splat/foveation/foveation.hpp"
#include "splat/model/camera.hpp"

namespace degs {

/// Why a request cannot be served; `detail` goes to ErrorDetail.
struct AcceleratorFault {
    AcceleratorError error = AcceleratorError::None;
    std::uint32_t detail = 0; ///< what is wrong, see docs/accelerator.md
    explicit operator bool() const { return error != AcceleratorError::None; }
};

/// A view as a host asks for it.
struct RequestedView {
    Camera camera;
    std::optional<Foveation> foveation{};
    std::uint64_t frame_buffer = 0;

    /// The views that draw its image, finest first; the camera itself unless it is foveated.
    std::vector<FoveatedLevel> levels() const;
};

/// A view that is drawn: one that a host asks for, or a level of it.
struct DrawnView {
    FoveatedLevel level;
    std::uint32_t entry = 0;   ///< of the table
    std::uint64_t address = 0; ///< of its pixels
    std::uint64_t cycles = 0;  ///< scene loaded to last pixel in memory
    std::uint64_t fragments = 0;
};

/// The request of a frame: the values of the registers when it was started, the table of views that
/// they name, and nothing else, so that no frame inherits anything of the one before it.
struct AcceleratorRequest {
    using Limits = AcceleratorOptions::Limits;

    AcceleratorFault fault; ///< why it cannot be served; the values behind it are not complete
    SceneCopy::Place scene;
    MemoryBases bases; ///< those of a view have a frame buffer and a part of the workspace, too
    std::uint64_t workspace_bytes = 0;
    /// Where the table of views lies; without entries, the registers describe the one view.
    struct {
        std::uint64_t address = 0;
        std::uint32_t entries = 0;
        std::uint64_t bytes() const { return std::uint64_t{entries} * kViewBytes; }
    } table;
    std::vector<RequestedView> views; ///< without those of a table that has not been read

    /// Reads and checks the registers.
    static AcceleratorRequest read(const AcceleratorRegisters& registers, const Limits& limits);
    /// Reads and checks the table of views, of which these are the bytes.
    void read_table(const std::vector<unsigned char>& bytes, const Limits& limits);
    /// The views that are drawn, with the addresses of their pixels: the levels of a foveated view
    /// lie one behind the other in its frame buffer.
    std::vector<DrawnView> drawn_views() const;
    /// A part of memory that belongs to the accelerator.
    struct Region {
        std::uint64_t begin = 0, bytes = 0;
        /// A region may end with the last address.
        bool passes_last_address() const { return bytes != 0 && bytes - 1 > ~begin; }
        bool overlaps(const Region& other) const {
            return bytes != 0 && other.bytes != 0 &&
                   (begin - other.begin < other.bytes || other.begin - begin < bytes);
        }
    };

private:
    /// A region, and what ErrorDetail says of it.
    struct NamedRegion : Region {
        std::uint32_t detail = 0;
        NamedRegion(const Region& region, std::uint32_t of) : Region(region), detail(of) {}
    };
    /// The regions of geometry, SH, workspace, table and frame buffers.
    std::vector<NamedRegion> regions() const;
    AcceleratorFault check_regions() const;
    std::uint64_t frame_bytes(const RequestedView& view) const;
};

} // namespace degs
