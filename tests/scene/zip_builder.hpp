// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <zlib.h>

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
            const std::string packed = deflated ? deflate_raw(content) : content;
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

private:
    static std::string deflate_raw(const std::string& plain) {
        z_stream state{};
        deflateInit2(&state, 9, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY);
        std::string packed(deflateBound(&state, plain.size()), '\0');
        state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
        state.avail_in = static_cast<uInt>(plain.size());
        state.next_out = reinterpret_cast<Bytef*>(packed.data());
        state.avail_out = static_cast<uInt>(packed.size());
        deflate(&state, Z_FINISH);
        packed.resize(state.total_out);
        deflateEnd(&state);
        return packed;
    }
};

} // namespace degs::test
