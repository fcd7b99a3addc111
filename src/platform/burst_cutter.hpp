// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tlm>

#include "degs/options.hpp"

namespace degs {

/// A part of an access that is a transaction of its own.
struct AccessPiece {
    std::uint64_t address = 0;
    unsigned int offset = 0, bytes = 0; ///< inside the data of the access, as TLM counts them
    /// Bytes of the transaction in front of the piece and behind it; 0 unless ends are full bursts.
    unsigned int lead = 0, tail = 0;
    /// Bytes of the transaction, which begins at `address - lead`.
    unsigned int length() const { return lead + bytes + tail; }
};

/// The pieces of an access: one per run of bytes that it moves, see Scattered. With `burst_bytes`
/// every run is cut into naturally aligned pieces of a power of two: whole bursts, and smaller ones
/// where a run begins or ends inside of one, unless `burst_ends` says that their transactions are
/// whole bursts, too. With `boundary_bytes` no transaction crosses a multiple of it.
std::vector<AccessPiece> cut_into_bursts(const tlm::tlm_generic_payload& access,
                                         const AcceleratorOptions::Memory& options);

} // namespace degs
