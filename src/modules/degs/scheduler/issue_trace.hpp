// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tlm/clock_domain.hpp"

namespace degs {

/// Digest of everything that an Issue Bank issues, in its order: two banks that decide alike have
/// the same one.
class IssueTrace {
public:
    /// A segment of `tasks` tasks goes in cycle `now` for the execution date `slot`. Its domain may
    /// be touched again from `ready` on.
    void add(Cycle now, Cycle slot, std::int16_t context, int domain, Cycle ready, int tasks) {
        ++segments_;
        for (const std::uint64_t word :
             {now, slot, static_cast<Cycle>(context), static_cast<Cycle>(domain), ready,
              static_cast<Cycle>(tasks)}) {
            digest_ = (digest_ ^ word) * 0x9E3779B97F4A7C15U;
            digest_ ^= digest_ >> 29U;
        }
    }
    std::uint64_t digest() const { return digest_; }
    std::uint64_t segments() const { return segments_; }

private:
    std::uint64_t digest_ = 0, segments_ = 0;
};

} // namespace degs
