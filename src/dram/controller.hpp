// SPDX-License-Identifier: Apache-2.0
// The choices of a channel's controller: what may be chosen by name, and its numbers.
#pragma once

#include <cstdint>
#include <vector>

#include "config/config.hpp"
#include "dram/timing.hpp"

namespace degs {

/// Which of the queued accesses may send commands. Ready commands go first, column commands before
/// others, the oldest among equals.
struct Lpddr5Scheduler {
    const char* name;
    bool hits_first;  ///< a bank serves accesses to its open row before older ones
    bool oldest_only; ///< nothing overtakes the oldest access of the queue
};

/// What happens to a row that has been accessed.
struct Lpddr5PagePolicy {
    const char* name;
    bool auto_precharge; ///< the last queued access to a row closes it
};

/// In the order of the names in Lpddr5ControllerConfig.
const std::vector<Lpddr5Scheduler>& lpddr5_schedulers();
const std::vector<Lpddr5PagePolicy>& lpddr5_page_policies();

enum class Lpddr5Refresh : std::uint8_t { None, AllBank, PerBank };

struct Lpddr5ControllerConfig {
    int read_queue = 32, write_queue = 32;
    double write_high = 0.8, write_low = 0.2;
    int scheduler = 0;   ///< of lpddr5_schedulers()
    int page_policy = 0; ///< of lpddr5_page_policies()
    Lpddr5Refresh refresh = Lpddr5Refresh::AllBank;
    bool refresh_stagger = false;
    bool posted_writes = true;
    void describe(ConfigVisitor& visitor);
};

} // namespace degs
