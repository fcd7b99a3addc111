// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tlm/clock_domain.hpp"

namespace degs {

/// One run of bytes that an initiator asks its memory for.
struct MemoryRequest {
    Cycle date = 0; ///< at which the request leaves
    std::uint64_t address = 0, bytes = 0;
    std::size_t initiator = 0;
    bool write = false;
};

/// Somebody who wants to know every request of an accelerator. Requests of one initiator come in
/// the order in which it makes them; their dates do not fall.
class RequestListener {
public:
    RequestListener() = default;
    RequestListener(const RequestListener&) = delete;
    RequestListener& operator=(const RequestListener&) = delete;
    virtual ~RequestListener() = default;

    /// Names the next initiator, before the simulation starts; several may have one name.
    virtual void initiator(const std::string& name) = 0;
    virtual void request(const MemoryRequest& request) = 0;
};

} // namespace degs
