// SPDX-License-Identifier: Apache-2.0
// The configuration of a channel's controller: choices by name, and numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "config/config.hpp"
#include "dram/policies.hpp"

namespace degs::dram {

/// What happens to a row after an access.
struct PagePolicy {
    const char* name;
    bool auto_precharge; ///< the last queued access to a row closes it
};

/// In the order of the names in ControllerConfig.
const std::vector<PagePolicy>& page_policies();

enum class Refresh : std::uint8_t { None, AllBank, PerBank };

struct ControllerConfig {
    int read_queue = 32, write_queue = 32;
    double write_high = 0.8, write_low = 0.2;
    std::vector<PolicyHolder> policies = all_policies(); ///< to choose from
    int scheduler = 0;                                   ///< of policies
    int page_policy = 0;                                 ///< of page_policies()
    Refresh refresh = Refresh::AllBank;
    bool refresh_stagger = false;
    bool posted_writes = true;
    int qos_step = 64; ///< accesses
    double urgent_share =
        0; ///< of the read queue, kept free for urgent reads; set by the requester
    void describe(ConfigVisitor& visitor);
};

} // namespace degs::dram
