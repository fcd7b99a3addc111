// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "platform/memory_gateway.hpp"
#include "splat/model/gaussian.hpp"

namespace degs {

/// Reads bytes by debug transport or, where the memory has none, by transactions whose time passes.
/// Returns the first failing response, or OK. Must be called from a process.
tlm::tlm_response_status read_memory(MemoryGateway& memory, std::uint64_t address,
                                     std::uint64_t bytes, std::vector<unsigned char>& out);

/// The scene as it lies in a platform's memory, and the copy of it from which the values of a frame
/// are computed. Per Gaussian 11 little-endian floats: mean x y z, scale x y z, rotation w x y z,
/// opacity; in a second array 3 (degree + 1)^2 floats of SH, [coefficient][channel].
class SceneCopy {
public:
    struct Place {
        std::uint64_t geometry = 0, sh = 0; ///< addresses
        std::uint32_t count = 0;            ///< Gaussians
        int sh_degree = 0;
        std::uint64_t geometry_bytes() const;
        std::uint64_t sh_bytes() const;
    };

    /// Reads both arrays, see read_memory().
    tlm::tlm_response_status load(MemoryGateway& memory, const Place& place);

    /// Decodes the bytes. A Gaussian that cannot be drawn (see sanitize()) stays, without opacity,
    /// so that the indices of the others are those of their records.
    GaussianCloud cloud(std::uint32_t& dropped) const;

    /// True if these are the bytes of the copy, or of neither array. An access that starts in an
    /// array ends in it.
    bool matches(std::uint64_t address, const unsigned char* data, std::uint64_t bytes) const;

private:
    Place place_;
    std::vector<unsigned char> geometry_, sh_;
};

/// Encodes a cloud as these bytes, for a program that puts a scene into memory. Means are rounded
/// to float.
void encode_scene(const GaussianCloud& cloud, std::vector<unsigned char>& geometry,
                  std::vector<unsigned char>& sh);

} // namespace degs
