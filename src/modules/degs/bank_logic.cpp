// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/bank_logic.hpp"

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
    const double selection = scan == DomainScan::RoundRobin
                                 ? laws.area_in_turn(domains, issued, true)
                                 : laws.area_oldest(domains, issued);
    return selection + laws.area_queue(queue_bits(), cut, issued) +
           laws.area_domains(domains, issued) + laws.area_packing(issued, length, width, packets);
}

double BankShape::selection_fo4(const cost::LogicLaws& laws) const {
    return scan == DomainScan::RoundRobin ? laws.fo4_in_turn(domains, issued, true)
                                          : laws.fo4_oldest(issued);
}

} // namespace degs
