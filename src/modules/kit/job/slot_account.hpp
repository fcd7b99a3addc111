// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "stats/statistics.hpp"
#include "tlm/clock_domain.hpp"

namespace degs {

/// Why a PE slot did no useful work. The same classes serve every accelerator.
enum class Idle { Conflict, Ports, Starved, Blocked };

/// PE-cycles by class. Every PE-cycle of the blending window falls in exactly one.
struct SlotAccount {
    std::uint64_t useful = 0, boundary = 0, terminated = 0;
    std::uint64_t conflict = 0, ports = 0, padding = 0, starved = 0, blocked = 0, drain = 0;

    void idle(Idle cause, std::uint64_t slots) {
        (cause == Idle::Conflict  ? conflict
         : cause == Idle::Ports   ? ports
         : cause == Idle::Starved ? starved
                                  : blocked) += slots;
    }
    std::uint64_t total() const {
        return executed() + conflict + ports + padding + starved + blocked + drain;
    }
    /// PE-cycles with a task.
    std::uint64_t executed() const { return useful + boundary + terminated; }
    SlotAccount& operator+=(const SlotAccount& o) {
        useful += o.useful;
        boundary += o.boundary;
        terminated += o.terminated;
        conflict += o.conflict;
        ports += o.ports;
        padding += o.padding;
        starved += o.starved;
        blocked += o.blocked;
        drain += o.drain;
        return *this;
    }
    void describe(StatsVisitor& visitor) const;
};

/// One class of PE-cycles and what it means.
struct SlotClass {
    const char* name; ///< in results
    std::uint64_t SlotAccount::*slots;
    const char* sentence;
    bool rare = false; ///< pictures and tables of runs without any leave it out
};
/// In the order of all results and pictures.
inline constexpr std::array<SlotClass, 9> kSlotClasses{{
    {"useful", &SlotAccount::useful, "A task inside the ellipse was blended."},
    {"boundary", &SlotAccount::boundary,
     "The task was outside the ellipse (alpha < 1/255) or outside the image."},
    {"terminated", &SlotAccount::terminated,
     "The task was inside, but its pixel had ended or refused the splat."},
    {"conflict", &SlotAccount::conflict,
     "No task: all that waited were within the reuse distance."},
    {"ports", &SlotAccount::ports,
     "No task: the ports of an SRAM took no more in this cycle; 0 if ports are unlimited."},
    {"padding", &SlotAccount::padding,
     "No task: the shape of a product of matrices left the PE out, or the array filled and "
     "drained; 0 where no matrices "
     "are multiplied.",
     true},
    {"starved", &SlotAccount::starved,
     "No task: none waited, or the issue width let no more through."},
    {"blocked", &SlotAccount::blocked,
     "No task: those that waited had no Pixel Buffer context or no place in a packet."},
    {"drain", &SlotAccount::drain, "No task: this part of the array had finished, others had not."},
}};

inline void SlotAccount::describe(StatsVisitor& visitor) const {
    for (const SlotClass& slot : kSlotClasses) {
        visitor.count(slot.name, this->*slot.slots, "PE-cycles", slot.sentence);
    }
}

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
