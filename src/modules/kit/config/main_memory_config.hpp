// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "dram/lpddr5.hpp"
#include "modules/kit/job/record_places.hpp"
#include "tlm/memory.hpp"

namespace degs {

/// `Bus`: one data bus with latency, the fields of Memory::Config. `Lpddr5`: channels, banks and
/// rows.
enum class MemoryModel { Bus, Lpddr5 };

/// Which reads wait for room in the queues of an LPDDR5 channel first: the older ones, or those of
/// the frame that is blended (tile lists, splat records) before those of preprocessing.
enum class ReadPriority { Age, Blending };

/// The off-chip memory of an accelerator: which model, and the parameters of each.
struct MainMemoryConfig : Memory::Config {
    MemoryModel model = MemoryModel::Bus;
    dram::Config lpddr5;
    RecordOrder layout = RecordOrder::Index;
    ReadPriority priority = ReadPriority::Age;
    double urgent_share = 0.5;
    void describe(ConfigVisitor& visitor);
    /// The keys of `lpddr5`, and what the priority means for its controllers.
    dram::Config channels() const {
        dram::Config config = lpddr5;
        config.controller.urgent_share = priority == ReadPriority::Blending ? urgent_share : 0;
        return config;
    }
    double peak_gb_per_s() const {
        return model == MemoryModel::Bus ? bandwidth_gb_per_s : lpddr5.peak_gb_per_s();
    }
};

} // namespace degs
