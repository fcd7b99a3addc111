// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <tlm>

namespace degs {

/// Sets every attribute that an initiator must set before it passes a payload on (IEEE
/// 1666-2011, 14.7): an access to `bytes` bytes without byte enables, not answered yet and without
/// a hint at direct memory access. Extensions stay. TLM-2.0 has 32 bits for the number of bytes.
inline void set_access(tlm::tlm_generic_payload& payload, tlm::tlm_command command,
                       std::uint64_t address, unsigned char* data, std::uint64_t bytes) {
    const auto length = static_cast<unsigned int>(bytes);
    payload.set_command(command);
    payload.set_address(address);
    payload.set_data_ptr(data);
    payload.set_data_length(length);
    payload.set_streaming_width(length);
    payload.set_byte_enable_ptr(nullptr);
    payload.set_byte_enable_length(0);
    payload.set_dmi_allowed(false);
    payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
}

} // namespace degs
