// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/scene/zlib_packed.hpp"

namespace degs::test {

/// Builds zip archives with code that shares nothing with the library's reader: stored or deflated.
struct ZipBuilder {
    std::vector<std::pair<std::string, std::string>> files;
    bool deflated = false;

    static std::string little(std::uint64_t value, int bytes) {
        std::string out;
        for (int i = 0; i < bytes; ++i) {
            out += static_cast<char>(value >> (8 * i));
        }
        return out;
    }

    std::string file() const {
        std::string body, directory;
        for (const auto& [name, content] : files) {
            const std::string packed = deflated ? zlib_packed(content, -MAX_WBITS) : content;
            const std::string facts =
                little(20, 2) + little(0, 2) + little(deflated ? 8 : 0, 2) + little(0, 4) +
                little(crc32(0, reinterpret_cast<const Bytef*>(content.data()),
                             static_cast<uInt>(content.size())),
                       4) +
                little(packed.size(), 4) + little(content.size(), 4) + little(name.size(), 2) +
                little(0, 2);
            directory += "PK\x01\x02" + little(20, 2) + facts + little(0, 2) + little(0, 2) +
                         little(0, 2) + little(0, 4) + little(body.size(), 4) + name;
            body += "PK\x03\x04" + facts + name + packed;
        }
        return body + directory + "PK\x05\x06" + little(0, 4) + little(files.size(), 2) +
               little(files.size(), 2) + little(directory.size(), 4) + little(body.size(), 4) +
               little(0, 2);
    }
};

} // namespace degs::test
