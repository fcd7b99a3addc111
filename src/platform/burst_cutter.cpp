// SPDX-License-Identifier: Apache-2.0
#include "platform/burst_cutter.hpp"

#include "tlm/scattered_records.hpp"

namespace degs {
namespace {

/// The largest naturally aligned power of two that starts at `address`, up to `burst` and to `room`.
std::uint64_t aligned_piece(std::uint64_t address, std::uint64_t burst, std::uint64_t room) {
    std::uint64_t piece = burst;
    while (address % piece != 0 || piece > room) {
        piece /= 2;
    }
    return piece;
}

} // namespace

std::vector<AccessPiece> cut_into_bursts(const tlm::tlm_generic_payload& access,
                                         std::uint64_t burst_bytes) {
    std::vector<AccessPiece> pieces;
    unsigned int offset = 0;
    for_each_run(access, [&](std::uint64_t address, const unsigned char*, std::uint64_t bytes) {
        for (const std::uint64_t end = address + bytes; address != end;) {
            const std::uint64_t room = end - address;
            const auto piece = static_cast<unsigned int>(
                burst_bytes == 0 ? room : aligned_piece(address, burst_bytes, room));
            pieces.push_back({address, offset, piece});
            address += piece;
            offset += piece;
        }
    });
    return pieces;
}

} // namespace degs
