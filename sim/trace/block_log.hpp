// SPDX-License-Identifier: Apache-2.0
// --block-log: what happens at one block of an accelerator, for a test bench of that block.
#pragma once

#include <string>
#include <vector>

#include "tlm/event_log.hpp"

namespace degs::sim {

struct BlockLogRequest {
    std::vector<std::string> words; ///< block and file; empty: no log
    bool given() const { return !words.empty(); }
    const std::string& block() const { return words.front(); }
    const std::string& file() const { return words.back(); }
};

/// For a request that is given: throws InputError if the file cannot be written, before a long run.
void check_block_log(const BlockLogRequest& request);
/// In the form of docs/block-log.md.
void write_block_log(const std::string& design, const BlockLogRequest& request,
                     const EventLog& log);

} // namespace degs::sim
