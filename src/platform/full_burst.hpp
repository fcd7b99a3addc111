// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tlm>

#include "platform/burst_cutter.hpp"

namespace degs {

/// The bytes of a transaction that is longer than the piece of an access that it carries. A read
/// fetches all of them and keeps those of the piece; a write enables those of the piece
/// (TLM-2.0, byte enables). A piece that fills its transaction needs none of this and is moved in
/// place.
class FullBurst {
public:
    /// Makes `payload`, whose command is set, the transaction of a piece of the access whose bytes
    /// are at `data`. They and the piece may go, but `data` must stay until close().
    void open(tlm::tlm_generic_payload& payload, const AccessPiece& piece, unsigned char* data);
    /// Takes what a read has brought and removes the byte enables. Once for every open().
    void close(tlm::tlm_generic_payload& payload);

private:
    unsigned char* data_ = nullptr; ///< of the piece in the access; null: moved in place
    unsigned int lead_ = 0, bytes_ = 0;
    std::vector<unsigned char> burst_, enables_;
};

} // namespace degs
