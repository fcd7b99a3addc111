// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"

namespace degs {

/// The ports of an SRAM, or of each bank of one whose addresses are dealt to its banks in turn. The
/// paper's simulators have "SRAM capacity and port/bank conflicts" (Sec. V-A), but it gives neither
/// ports nor banks [assumed].
struct SramPorts {
    int ports = 0; ///< reads and as many writes per cycle and bank; 0: as many as anybody wants

    bool limited() const { return ports != 0; }
    /// `wanted` accesses per cycle, or what the ports allow of them.
    int of(int wanted) const { return limited() && ports < wanted ? ports : wanted; }
    void describe(ConfigVisitor& visitor, const char* what) {
        visitor.integer("ports", ports, 0, 64, what);
    }
};

/// The ports of an SRAM of several banks.
struct BankedSramPorts : SramPorts {
    int sram_banks = 1;

    /// Accesses per cycle to neighbouring addresses, which lie in different banks.
    int neighbours(int wanted) const { return SramPorts{ports * sram_banks}.of(wanted); }
    void describe(ConfigVisitor& visitor, const char* what, const char* banks) {
        SramPorts::describe(visitor, what);
        visitor.integer("sram_banks", sram_banks, 1, 4096, banks);
        if (!limited()) {
            visitor.unused("sram_banks", "ports", "ports is 0, which is unlimited");
        }
    }
};

} // namespace degs
