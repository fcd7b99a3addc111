// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/bank_logic.hpp"

#include <algorithm>

namespace degs {
namespace {

/// Bits of a number below `count`.
int bits_of(int count) {
    int bits = 0;
    while ((std::int64_t{1} << bits) < count) {
        ++bits;
    }
    return bits;
}

} // namespace

// A domain has its first and its last segment, and that it has any. A segment has its mask, the
// next one, its domain, and that it waits.
int BankShape::queue_bits() const {
    const int entry = bits_of(depth);
    const int lists = domains * (1 + 2 * entry);
    return memory == QueueMemory::Sram ? lists
                                       : lists + depth * (1 + length + entry + bits_of(domains));
}

double BankShape::area(const cost::LogicLaws& laws) const {
    const double selection = scan != DomainScan::RoundRobin ? laws.area_oldest(domains, issued)
                             : select_cycles == 0
                                 ? laws.area_in_turn(domains, issued, true)
                                 : laws.area_pipelined(domains, issued, select_cycles);
    return selection + laws.area_queue(queue_bits(), cut, issued) +
           laws.area_domains(domains, issued) + laws.area_packing(issued, length, width, packets);
}

// An age matrix knows no dates: the dates of its picks come after them, in the same cycle or later.
double BankShape::selection_fo4(const cost::LogicLaws& laws, int cycles) const {
    if (scan != DomainScan::RoundRobin) {
        const double group = laws.fo4_group(domains, issued);
        const double oldest = laws.fo4_oldest(issued);
        return cycles < 2 ? oldest + group : std::max(oldest, group);
    }
    return cycles == 0 ? laws.fo4_in_turn(domains, issued, true)
                       : laws.fo4_pipelined(domains, issued, cycles);
}

} // namespace degs
