// SPDX-License-Identifier: Apache-2.0
#include "scene/spz/spz_header.hpp"

#include <cstdio>
#include <limits>

#include "scene/files/input_file.hpp"

namespace degs {
namespace {

constexpr std::uint32_t kAxesRecord = 0xADBE0003;
constexpr std::uint32_t kOrbitRecord = 0xADBE0002; ///< limits of a viewer's camera; nothing here

/// Systems 1 to 8 count in binary: bit 0 is right, bit 1 up, bit 2 front.
Axes axes_of_record(const std::string& where, std::string_view payload) {
    constexpr std::uint32_t kUnswapped = 8;
    constexpr std::uint32_t kLast = 16;
    const std::uint32_t system = payload.size() == 4 ? load_u32(payload.data()) : 0;
    if (system < 1 || system > kLast) {
        fail_file(where, "its coordinate-system record must hold one number from 1 to 16.");
    }
    if (system > kUnswapped) {
        fail_file(where, "its coordinate-system record names system " + std::to_string(system) +
                             ", whose Y axis is neither up nor down; supported are 1 to 8, those "
                             "in which it is.");
    }
    const std::uint32_t bits = system - 1;
    Axes axes;
    axes.signs = {(bits & 1) != 0 ? 1 : -1, (bits & 2) != 0 ? -1 : 1, (bits & 4) != 0 ? 1 : -1};
    return axes;
}

std::string hexadecimal(std::uint32_t value) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%08X", value);
    return text;
}

} // namespace

std::uint32_t load_u32(const char* bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) {
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    }
    return value;
}

std::uint64_t load_u64(const char* bytes) {
    return std::uint64_t{load_u32(bytes + 4)} << 32 | load_u32(bytes);
}

std::array<std::uint64_t, 6> SpzHeader::attribute_bytes() const {
    const std::uint64_t position = version == 1 ? 6 : 9, rotation = version >= 3 ? 4 : 3;
    return {position, 1, 3, 3, rotation, 3 * sh_rest()};
}

std::uint64_t SpzHeader::body_bytes() const {
    std::uint64_t bytes = 0;
    for (const std::uint64_t each : attribute_bytes()) {
        bytes += each;
    }
    return bytes * count;
}

SpzHeader parse_spz_header(const std::string& where, const char* bytes) {
    SpzHeader header;
    if (load_u32(bytes) != kSpzMagic) {
        fail_file(where,
                  "its first bytes are not 'NGSP', so this is no SPZ scene; a compressed file "
                  "of another format must be decompressed first.");
    }
    header.version = load_u32(bytes + 4);
    if (header.version < 1 || header.version > 4) {
        fail_file(where, "SPZ version " + std::to_string(header.version) +
                             " is not supported; supported are 1 to 4.");
    }
    header.count = load_u32(bytes + 8);
    header.sh_degree = static_cast<unsigned char>(bytes[12]);
    header.fractional_bits = static_cast<unsigned char>(bytes[13]);
    header.flags = static_cast<std::uint8_t>(bytes[14]);
    if (header.count == 0 || header.count > std::numeric_limits<std::int32_t>::max()) {
        fail_file(where, "its header claims " + std::to_string(header.count) +
                             " Gaussians; allowed are 1 to 2147483647.");
    }
    if (header.sh_degree > kSpzMaxDegree) {
        fail_file(where, "its spherical harmonics are of degree " +
                             std::to_string(header.sh_degree) + "; allowed are 0 to 4.");
    }
    if (header.fractional_bits > 31) {
        fail_file(where, "its positions have " + std::to_string(header.fractional_bits) +
                             " fractional bits; allowed are 0 to 31.");
    }
    return header;
}

SpzRecords parse_spz_records(const std::string& where, std::string_view bytes) {
    SpzRecords records;
    while (!bytes.empty()) {
        constexpr std::size_t kHead = 8;
        if (bytes.size() < kHead || load_u32(bytes.data() + 4) > bytes.size() - kHead) {
            fail_file(where,
                      "an extension record is longer than the file; the file is truncated or "
                      "damaged.");
        }
        const std::uint32_t type = load_u32(bytes.data());
        const std::uint32_t length = load_u32(bytes.data() + 4);
        if (type == kAxesRecord) {
            records.axes = axes_of_record(where, bytes.substr(kHead, length));
        } else if (type != kOrbitRecord) {
            records.notes.push_back("An extension record of the unknown type " + hexadecimal(type) +
                                    " (" + std::to_string(length) +
                                    " bytes) was passed over; if it changes the meaning of the "
                                    "others, the image is wrong.");
        }
        bytes.remove_prefix(kHead + length);
    }
    return records;
}

} // namespace degs
