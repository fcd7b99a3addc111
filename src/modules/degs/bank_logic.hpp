// SPDX-License-Identifier: Apache-2.0
// What an Issue Bank with its Packing Unit takes and how fast it can be, by its widths.
#pragma once

#include "cost/logic_laws.hpp"
#include "modules/degs/scheduler/issue_bank.hpp"

namespace degs {

/// Where masks and links of waiting segments lie.
enum class QueueMemory { Sram, FlipFlops };

/// The widths of a bank.
struct BankShape {
    int domains = 16;                     ///< of all tiles in flight
    int depth = 32;                       ///< segments that wait
    int cut = 2, issued = 2, packets = 1; ///< per cycle
    int select_cycles = 0;                ///< from the choice of segments to their packing
    int length = 16;                      ///< px, of a segment
    int width = 8;                        ///< tasks of a packet
    DomainScan scan = DomainScan::RoundRobin;
    QueueMemory memory = QueueMemory::Sram;

    /// Area in units of the laws: selection, queue, domain state, Packing Unit.
    double area(const cost::LogicLaws& laws) const;
    /// The slowest cycle of the choice, if `select_cycles` were `cycles`.
    double selection_fo4(const cost::LogicLaws& laws, int cycles) const;

private:
    int queue_bits() const;
};

} // namespace degs
