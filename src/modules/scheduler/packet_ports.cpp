// SPDX-License-Identifier: Apache-2.0
#include "modules/scheduler/packet_ports.hpp"

#include <algorithm>

namespace degs {

void PacketPorts::clear() {
    pixels_.clear();
    entries_.clear();
}

std::uint32_t PacketPorts::take(const BlendTask& task, std::uint32_t mask, int entry, int most) {
    if (!reads_parameters(entry)) {
        return 0;
    }
    const int first = task.row / config_.banks * config_.tile_size + task.column;
    std::uint32_t taken = 0;
    for (; mask != 0 && most > 0; mask &= mask - 1, --most) {
        if (!reads_pixel(task.context, first + __builtin_ctz(mask))) {
            break;
        }
        taken |= mask & (0U - mask);
    }
    return taken;
}

bool PacketPorts::reads_parameters(int entry) {
    if (!config_.features.limited() ||
        std::find(entries_.begin(), entries_.end(), entry) != entries_.end()) {
        return true;
    }
    const int bank = entry % config_.features.sram_banks;
    const auto same_bank = [&](int other) { return other % config_.features.sram_banks == bank; };
    if (std::count_if(entries_.begin(), entries_.end(), same_bank) == config_.features.ports) {
        return false;
    }
    entries_.push_back(entry);
    return true;
}

bool PacketPorts::reads_pixel(int context, int address) {
    if (!config_.pixels.limited()) {
        return true;
    }
    const int bank = address % config_.pixels.sram_banks;
    for (PixelReads& reads : pixels_) {
        if (reads.context == context && reads.sram_bank == bank) {
            return reads.count++ < config_.pixels.ports;
        }
    }
    pixels_.push_back({context, bank, 1});
    return true;
}

} // namespace degs
