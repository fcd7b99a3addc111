// SPDX-License-Identifier: Apache-2.0
// What the firmware of driver/firmware and the platform that boots it agree on.
#pragma once

#include <cstdint>
#include <vector>

#include "splat/model/camera.hpp"
#include "splat/model/gaussian.hpp"

namespace degs::sim {

/// Bus addresses: registers of the accelerator, console with the exit register 4 bytes behind it,
/// and the memory that core and accelerator share.
struct BootMap {
    std::uint64_t registers = 0, console = 0, memory = 0;
};
BootMap boot_map();

/// The first bytes of the shared memory: the table that the firmware reads, with one view, and the
/// scene. The table leaves frame buffer and workspace the rest of `capacity` bytes, as far as the
/// core's 32 bits reach. Throws InputError if that is not enough for a frame buffer.
std::vector<unsigned char> boot_memory(const GaussianCloud& cloud, const Camera& camera,
                                       std::uint64_t capacity);

} // namespace degs::sim
