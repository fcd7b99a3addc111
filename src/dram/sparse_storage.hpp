// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <unordered_map>

namespace degs::dram {

/// Contents of a memory, in pages that exist only where something was written; the rest reads as 0.
class SparseStorage {
public:
    static constexpr std::uint64_t kPageBytes = 4096;

    void write(std::uint64_t address, const unsigned char* data, std::uint64_t bytes) {
        each_piece(
            address, bytes,
            [&](std::uint64_t page, std::uint64_t offset, std::uint64_t at, std::uint64_t size) {
                std::memcpy(pages_[page].data() + offset, data + at, size);
            });
    }
    void read(std::uint64_t address, unsigned char* data, std::uint64_t bytes) const {
        each_piece(
            address, bytes,
            [&](std::uint64_t page, std::uint64_t offset, std::uint64_t at, std::uint64_t size) {
                const auto found = pages_.find(page);
                if (found == pages_.end()) {
                    std::memset(data + at, 0, size);
                } else {
                    std::memcpy(data + at, found->second.data() + offset, size);
                }
            });
    }
    /// The page that holds `address`; stays where it is.
    unsigned char* page(std::uint64_t address) { return pages_[address / kPageBytes].data(); }
    std::size_t pages() const { return pages_.size(); }

private:
    template <class Piece>
    static void each_piece(std::uint64_t address, std::uint64_t bytes, const Piece& piece) {
        for (std::uint64_t at = 0; at != bytes;) {
            const std::uint64_t offset = (address + at) % kPageBytes;
            const std::uint64_t size = std::min(bytes - at, kPageBytes - offset);
            piece((address + at) / kPageBytes, offset, at, size);
            at += size;
        }
    }
    std::unordered_map<std::uint64_t, std::array<unsigned char, kPageBytes>> pages_;
};

} // namespace degs::dram
