// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "dram/lpddr5.hpp"
#include "modules/record_places.hpp"
#include "tlm/memory.hpp"

namespace degs {

/// `Bus`: one data bus with latency, the fields of Memory::Config. `Lpddr5`: channels, banks and
/// rows.
enum class MemoryModel { Bus, Lpddr5 };

/// The off-chip memory of an accelerator: which model, and the parameters of each.
struct MainMemoryConfig : Memory::Config {
    MemoryModel model = MemoryModel::Bus;
    dram::Config lpddr5;
    RecordOrder layout = RecordOrder::Index;
    void describe(ConfigVisitor& visitor);
    double peak_gb_per_s() const {
        return model == MemoryModel::Bus ? bandwidth_gb_per_s : lpddr5.peak_gb_per_s();
    }
};

} // namespace degs
