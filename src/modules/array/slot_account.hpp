// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "tlm/clock_domain.hpp"

namespace degs {

/// Why a PE slot did no useful work. The same classes serve every accelerator.
enum class Idle { Conflict, Starved, Blocked };

/// PE-cycles by class. Every PE-cycle of the blending window falls in exactly one.
struct SlotAccount {
    std::uint64_t useful = 0;     ///< inside the ellipse, pixel live, blended
    std::uint64_t boundary = 0;   ///< alpha < 1/255, or outside the image
    std::uint64_t terminated = 0; ///< the pixel has ended or refuses the splat
    std::uint64_t conflict = 0;   ///< work there, but within the reuse distance
    std::uint64_t starved = 0;    ///< no work there
    std::uint64_t blocked = 0;    ///< work there, but no room: a Pixel Buffer context, a packet
    std::uint64_t drain = 0;      ///< this slice is done with the frame, others are not

    void idle(Idle cause, std::uint64_t slots) {
        (cause == Idle::Conflict ? conflict : cause == Idle::Starved ? starved : blocked) += slots;
    }
    std::uint64_t total() const {
        return useful + boundary + terminated + conflict + starved + blocked + drain;
    }
    SlotAccount& operator+=(const SlotAccount& o) {
        useful += o.useful;
        boundary += o.boundary;
        terminated += o.terminated;
        conflict += o.conflict;
        starved += o.starved;
        blocked += o.blocked;
        drain += o.drain;
        return *this;
    }
};

/// First and last cycle in which an array slice executed tasks.
struct ActiveWindow {
    Cycle first = kNever;
    Cycle last = 0;
    bool empty() const { return first == kNever; }
    void include(Cycle date) {
        first = std::min(first, date);
        last = std::max(last, date);
    }
    void include(const ActiveWindow& other) {
        first = std::min(first, other.first);
        last = std::max(last, other.last);
    }
    Cycle cycles() const { return empty() ? 0 : last - first + 1; }
};

} // namespace degs
