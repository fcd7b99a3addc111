// SPDX-License-Identifier: Apache-2.0
// The parts of a workload file that are no text, no splats and no lists.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <xxhash.h>

namespace degs::sim {

constexpr std::string_view kWorkloadMagic = "degswork";
constexpr std::uint32_t kWorkloadVersion = 2;
constexpr std::size_t kVersionAt = 8, kHeadBytesAt = 12, kHeadAt = 16; ///< bytes from the start
constexpr std::size_t kChecksumBytes = 16;
constexpr std::uint32_t kMostHeadBytes = 16U << 20U;

/// A number of four bytes, the lowest first.
inline std::string little_endian(std::uint32_t value) {
    std::string bytes;
    for (unsigned byte = 0; byte < 4; ++byte) {
        bytes += static_cast<char>(value >> 8 * byte & 0xffU);
    }
    return bytes;
}
inline std::uint32_t little_endian_at(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (unsigned byte = 0; byte < 4; ++byte) {
        value |= std::uint32_t{static_cast<unsigned char>(bytes[at + byte])} << 8 * byte;
    }
    return value;
}

/// The XXH3 of 128 bits of some bytes, the highest byte first.
inline std::string checksum_bytes(std::string_view bytes) {
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
    return {reinterpret_cast<const char*>(canonical.digest), sizeof canonical.digest};
}

/// Bytes in hexadecimal digits.
inline std::string in_digits(std::string_view bytes) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string digits;
    for (const char byte : bytes) {
        digits += kDigits[static_cast<unsigned char>(byte) >> 4U];
        digits += kDigits[static_cast<unsigned char>(byte) & 0xfU];
    }
    return digits;
}

} // namespace degs::sim
