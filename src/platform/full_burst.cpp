// SPDX-License-Identifier: Apache-2.0
#include "platform/full_burst.hpp"

#include <algorithm>

#include "tlm/set_access.hpp"

namespace degs {

void FullBurst::open(tlm::tlm_generic_payload& payload, const AccessPiece& piece,
                     unsigned char* data) {
    set_access(payload, payload.get_command(), piece.address - piece.lead, data + piece.offset,
               piece.length());
    if (piece.length() == piece.bytes) {
        data_ = nullptr;
        return;
    }
    data_ = data + piece.offset;
    lead_ = piece.lead;
    bytes_ = piece.bytes;
    burst_.assign(piece.length(), 0);
    payload.set_data_ptr(burst_.data());
    if (payload.is_write()) {
        std::copy_n(data_, bytes_, burst_.data() + lead_);
        enables_.assign(piece.length(), TLM_BYTE_DISABLED);
        std::fill_n(enables_.data() + lead_, bytes_, TLM_BYTE_ENABLED);
        payload.set_byte_enable_ptr(enables_.data());
        payload.set_byte_enable_length(piece.length());
    }
}

void FullBurst::close(tlm::tlm_generic_payload& payload) {
    if (data_ != nullptr && payload.is_read() && payload.is_response_ok()) {
        std::copy_n(burst_.data() + lead_, bytes_, data_);
    }
    payload.set_byte_enable_ptr(nullptr);
    payload.set_byte_enable_length(0);
}

} // namespace degs
