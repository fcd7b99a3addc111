// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/files/axes.hpp"

namespace degs {

constexpr std::size_t kSpzHeaderBytes = 16;                     ///< versions 1 to 3, inflated
constexpr std::size_t kSpz4HeaderBytes = 32;                    ///< version 4, plain
constexpr std::uint32_t kSpzMagic = 0x5053474e;                 ///< "NGSP"
constexpr std::uint8_t kSpzAntialiased = 1, kSpzHasRecords = 2; ///< flags
constexpr int kSpzMaxDegree = 4;

/// What the header of an SPZ file says.
struct SpzHeader {
    std::uint32_t version = 0;
    std::uint32_t count = 0; ///< Gaussians
    int sh_degree = 0;       ///< 0..4
    int fractional_bits = 0; ///< of positions, 0..31; version 1 has none
    std::uint8_t flags = 0;

    /// Coefficients per channel without the one of degree 0.
    std::uint64_t sh_rest() const { return std::uint64_t{1} * sh_degree * (sh_degree + 2); }
    /// Bytes per Gaussian of the six attributes, in the order of the file: positions, opacities,
    /// colours, scales, rotations, spherical harmonics.
    std::array<std::uint64_t, 6> attribute_bytes() const;
    /// Bytes of all attributes of all Gaussians.
    std::uint64_t body_bytes() const;
};

/// Parses the part that all versions share: the first 16 bytes. InputError "<where>: ..." for a
/// version, count, degree or number of fractional bits that no file can have.
SpzHeader parse_spz_header(const std::string& where, const char* bytes);

/// The records of vendors that `flags` announces: [u32 type][u32 length][payload], back to back.
struct SpzRecords {
    std::optional<Axes> axes;       ///< record 0xADBE0003
    std::vector<std::string> notes; ///< a sentence for each record of a type unknown here
};
SpzRecords parse_spz_records(const std::string& where, std::string_view bytes);

/// Little-endian, at `bytes`.
std::uint32_t load_u32(const char* bytes);
std::uint64_t load_u64(const char* bytes);

} // namespace degs
