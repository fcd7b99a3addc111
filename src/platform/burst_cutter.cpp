// SPDX-License-Identifier: Apache-2.0
#include "platform/burst_cutter.hpp"

#include <algorithm>

#include "tlm/scattered_records.hpp"

namespace degs {
namespace {

/// Bytes from `address` to the next multiple of `boundary`; no end if that is 0.
std::uint64_t up_to(std::uint64_t address, std::uint64_t boundary) {
    return boundary == 0 ? ~std::uint64_t{0} : boundary - address % boundary;
}

/// The largest naturally aligned power of two that starts at `address`, up to `burst` and to
/// `room`.
std::uint64_t aligned_piece(std::uint64_t address, std::uint64_t burst, std::uint64_t room) {
    std::uint64_t piece = burst;
    while (address % piece != 0 || piece > room) {
        piece /= 2;
    }
    return piece;
}

} // namespace

std::vector<AccessPiece> cut_into_bursts(const tlm::tlm_generic_payload& access,
                                         const AcceleratorOptions::Memory& options) {
    const std::uint64_t burst_bytes = options.burst_bytes;
    const bool full = options.burst_ends == BurstEnds::FullBursts && burst_bytes != 0;
    std::vector<AccessPiece> pieces;
    unsigned int offset = 0;
    const auto add = [&](std::uint64_t address, std::uint64_t bytes, std::uint64_t lead,
                         std::uint64_t tail) {
        const auto count = [](std::uint64_t value) { return static_cast<unsigned int>(value); };
        pieces.push_back({address, offset, count(bytes), count(lead), count(tail)});
        offset += count(bytes);
    };
    for_each_run(access, [&](std::uint64_t address, const unsigned char*, std::uint64_t bytes) {
        for (const std::uint64_t end = address + bytes; address != end;) {
            // A naturally aligned piece that ends before a boundary crosses none.
            const std::uint64_t room =
                std::min(end - address, up_to(address, options.boundary_bytes));
            const std::uint64_t lead = full ? address % burst_bytes : 0;
            const std::uint64_t piece = full ? std::min(room, burst_bytes - lead)
                                        : burst_bytes == 0
                                            ? room
                                            : aligned_piece(address, burst_bytes, room);
            add(address, piece, lead, full ? burst_bytes - lead - piece : 0);
            address += piece;
        }
    });
    return pieces;
}

} // namespace degs
