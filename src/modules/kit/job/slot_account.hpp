// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "stats/statistics.hpp"
#include "tlm/clock_domain.hpp"

namespace degs {

/// What a PE slot was used for, in the order of all results and pictures. The same classes serve
/// every accelerator.
enum class Slot { Useful, Boundary, Terminated, Conflict, Ports, Padding, Starved, Blocked, Drain };

/// A class of PE-cycles and what it means.
struct SlotClass {
    Slot slot;
    const char* name; ///< in results
    const char* sentence;
    bool rare = false; ///< pictures and tables of runs without any leave it out
};
inline constexpr std::array<SlotClass, 9> kSlotClasses{{
    {Slot::Useful, "useful", "A task inside the ellipse was blended."},
    {Slot::Boundary, "boundary",
     "The task was outside the ellipse (alpha < 1/255) or outside the image."},
    {Slot::Terminated, "terminated",
     "The task was inside, but its pixel had ended or refused the splat."},
    {Slot::Conflict, "conflict", "No task: all that waited were within the reuse distance."},
    {Slot::Ports, "ports", "No task: the ports of an SRAM took no more in this cycle."},
    {Slot::Padding, "padding",
     "No task: the shape of a product of matrices left the PE out, or the array filled and "
     "drained.",
     true},
    {Slot::Starved, "starved", "No task: none waited, or the issue width let no more through."},
    {Slot::Blocked, "blocked",
     "No task: those that waited had no Pixel Buffer context or no place in a packet."},
    {Slot::Drain, "drain", "No task: this part of the array had finished, others had not."},
}};

/// True if the PE had a task.
constexpr bool is_executed(Slot slot) {
    return slot == Slot::Useful || slot == Slot::Boundary || slot == Slot::Terminated;
}

/// PE-cycles by class. Every PE-cycle of the blending window falls in exactly one.
class SlotAccount {
public:
    std::uint64_t& operator[](Slot slot) { return slots_[static_cast<std::size_t>(slot)]; }
    std::uint64_t operator[](Slot slot) const { return slots_[static_cast<std::size_t>(slot)]; }

    std::uint64_t total() const {
        return std::accumulate(slots_.begin(), slots_.end(), std::uint64_t{0});
    }
    /// PE-cycles with a task.
    std::uint64_t executed() const {
        return (*this)[Slot::Useful] + (*this)[Slot::Boundary] + (*this)[Slot::Terminated];
    }
    SlotAccount& operator+=(const SlotAccount& other) {
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            slots_[i] += other.slots_[i];
        }
        return *this;
    }
    void describe(StatsVisitor& visitor) const {
        for (const SlotClass& each : kSlotClasses) {
            visitor.count(each.name, (*this)[each.slot], "PE-cycles", each.sentence);
        }
    }

private:
    std::array<std::uint64_t, kSlotClasses.size()> slots_{};
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
