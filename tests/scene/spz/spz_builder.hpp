// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <zstd.h>

#include "tests/scene/zlib_packed.hpp"

namespace degs::test {

/// Builds SPZ files, right and wrong ones, with an encoder that shares nothing with the library.
struct SpzBuilder {
    std::uint32_t magic = 0x5053474e, version = 3, count = 0;
    int degree = 0, fractional_bits = 12, flags = 0;
    std::array<std::string, 6> attributes; ///< bytes as they stand in the file
    std::string records;

    /// `count` Gaussians whose bytes count up, of a valid rotation.
    static SpzBuilder scene(std::uint32_t version, std::uint32_t count, int degree) {
        SpzBuilder spz;
        spz.version = version;
        spz.count = count;
        spz.degree = degree;
        const std::size_t rest = std::size_t{3} * degree * (degree + 2);
        const std::size_t each[] = {version == 1 ? 6U : 9U, 1, 3, 3, version >= 3 ? 4U : 3U, rest};
        for (int i = 0; i < 6; ++i) {
            for (std::size_t b = 0; b < each[i] * count; ++b) {
                spz.attributes[i] += static_cast<char>(b * 37 + i);
            }
        }
        return spz;
    }

    static std::string u32(std::uint32_t value) {
        return {static_cast<char>(value), static_cast<char>(value >> 8),
                static_cast<char>(value >> 16), static_cast<char>(value >> 24)};
    }
    static std::string u64(std::uint64_t value) {
        return u32(static_cast<std::uint32_t>(value)) +
               u32(static_cast<std::uint32_t>(value >> 32));
    }
    static std::string record(std::uint32_t type, const std::string& payload) {
        return u32(type) + u32(static_cast<std::uint32_t>(payload.size())) + payload;
    }
    static std::string gzip(const std::string& plain) { return zlib_packed(plain, 16 + MAX_WBITS); }
    static std::string zstd(const std::string& plain) {
        std::string packed(ZSTD_compressBound(plain.size()), '\0');
        packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 12));
        return packed;
    }

    std::string head() const {
        return u32(magic) + u32(version) + u32(count) +
               std::string{static_cast<char>(degree), static_cast<char>(fractional_bits),
                           static_cast<char>(flags), '\0'};
    }
    std::string inflated() const {
        std::string bytes = head();
        for (const std::string& attribute : attributes) {
            bytes += attribute;
        }
        return bytes + records;
    }
    std::string file() const { return version == 4 ? file_4() : gzip(inflated()); }

private:
    std::string file_4() const {
        std::string table, streams;
        char used = 0;
        for (const std::string& attribute : attributes) {
            if (!attribute.empty()) {
                const std::string packed = zstd(attribute);
                table += u64(packed.size()) + u64(attribute.size());
                streams += packed;
                ++used;
            }
        }
        std::string bytes = head();
        bytes[15] = used;
        const auto offset = static_cast<std::uint32_t>(32 + records.size());
        return bytes + u32(offset) + std::string(12, '\0') + records + table + streams;
    }
};

} // namespace degs::test
