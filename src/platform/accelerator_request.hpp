// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "degs/options.hpp"
#include "modules/kit/job/traffic.hpp"
#include "platform/accelerator_registers.hpp"
#include "platform/scene_copy.hpp"
#include "splat/model/camera.hpp"

namespace degs {

/// Why a request cannot be served; `detail` goes to ErrorDetail.
struct AcceleratorFault {
    AcceleratorError error = AcceleratorError::None;
    std::uint32_t detail = 0; ///< offset of the register that is wrong, or see docs/accelerator.md
    explicit operator bool() const { return error != AcceleratorError::None; }
};

/// The request of a frame: the values of the registers when it was started, and of nothing else, so
/// that no frame inherits anything of the one before it.
struct AcceleratorRequest {
    using Limits = AcceleratorOptions::Limits;

    AcceleratorFault fault; ///< why it cannot be served; the values behind it are not complete
    SceneCopy::Place scene;
    MemoryBases bases;
    std::uint64_t workspace_bytes = 0;
    Camera camera;

    /// Reads and checks the registers.
    static AcceleratorRequest read(const AcceleratorRegisters& registers, const Limits& limits);
    std::uint64_t frame_bytes() const;
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
    /// The regions of geometry, SH, workspace and frame buffer.
    std::vector<Region> regions() const;
};

} // namespace degs
