// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/packet_ports.hpp"

#include <algorithm>

#include "splat/frame/pixel_mask.hpp"
#include "tlm/ceil_div.hpp"

namespace degs {
namespace {

constexpr int kWordBits = 64;
constexpr int kMaskBits = 32;

std::uint32_t lowest_of(std::uint32_t mask, int most) {
    return __builtin_popcount(mask) > most ? lowest_bits(mask, most) : mask;
}

} // namespace

PacketPorts::PacketPorts(const Config& config)
    : config_(config), words_(ceil_div(config.pixels.sram_banks, kWordBits)),
      context_words_(words_ * config.pixels.ports) {
    for (int i = 0; i < config.tile_size; ++i) {
        first_of_row_.push_back(i / config.banks * config.tile_size % config.pixels.sram_banks);
        bank_of_column_.push_back(i % config.pixels.sram_banks);
    }
}

void PacketPorts::imitate(const PacketPorts& other, int context) {
    clear();
    reads_ = other.reads_;
    const std::size_t c = context;
    if (c < other.last_use_.size() && other.last_use_[c] == other.packet_) {
        std::copy_n(&other.taken_[c * context_words_], context_words_, ports_of(c));
    }
}

std::uint32_t PacketPorts::take(const BlendTask& task, std::uint32_t mask, int entry, int most) {
    if (!reads_parameters(entry)) {
        return 0;
    }
    return config_.pixels.limited() ? take_pixels(task, mask, most) : lowest_of(mask, most);
}

bool PacketPorts::reads_parameters(int entry) {
    if (!config_.features.limited()) {
        return true;
    }
    const int bank = entry % config_.features.sram_banks;
    int same_bank = 0;
    for (const Read& read : reads_) {
        if (read.entry == entry) {
            return true;
        }
        same_bank += read.sram_bank == bank ? 1 : 0;
    }
    if (same_bank == config_.features.ports) {
        return false;
    }
    reads_.push_back({entry, bank});
    return true;
}

// Takes pixels stretch by stretch. The SRAM banks of a stretch ascend, so that two of its pixels
// never want the same one.
std::uint32_t PacketPorts::take_pixels(const BlendTask& task, std::uint32_t mask, int most) {
    std::uint64_t* const ports = ports_of(task.context);
    const int banks = config_.pixels.sram_banks;
    int bank = first_of_row_[task.row] + bank_of_column_[task.column];
    bank -= bank >= banks ? banks : 0;
    std::uint32_t taken = 0;
    for (int column = 0; column < kMaskBits && mask >> column != 0;) {
        const int length = std::min(banks - bank, kMaskBits - column);
        const std::uint32_t wanted = mask >> column & bits_between(0, length);
        const std::uint32_t refused = wanted & full_from(ports, bank);
        std::uint32_t part = refused == 0 ? wanted : wanted & ((refused & (0U - refused)) - 1);
        part = lowest_of(part, most);
        use(ports, bank, part);
        taken |= part << column;
        if (part != wanted) {
            break;
        }
        most -= __builtin_popcount(part);
        column += length;
        bank = 0;
    }
    return taken;
}

// A bit for each of up to 32 SRAM banks from `bank` on: set if all ports of the bank are taken,
// which the last port shows. There are no bits beyond the last bank.
std::uint32_t PacketPorts::full_from(const std::uint64_t* ports, int bank) const {
    const std::uint64_t* const last = ports + (config_.pixels.ports - 1) * words_;
    const std::size_t word = bank / kWordBits;
    const int shift = bank % kWordBits;
    std::uint64_t bits = last[word] >> shift;
    if (shift > kWordBits - kMaskBits && word + 1 < words_) {
        bits |= last[word + 1] << (kWordBits - shift);
    }
    return static_cast<std::uint32_t>(bits);
}

// Takes the first free port in the SRAM bank of each of the pixels.
void PacketPorts::use(std::uint64_t* ports, int bank, std::uint32_t pixels) const {
    const std::size_t word = bank / kWordBits;
    const int shift = bank % kWordBits;
    std::uint64_t low = std::uint64_t{pixels} << shift;
    std::uint64_t high =
        shift > kWordBits - kMaskBits ? std::uint64_t{pixels} >> (kWordBits - shift) : 0;
    for (std::uint64_t* port = ports; (low | high) != 0; port += words_) {
        const std::uint64_t busy = port[word] & low;
        port[word] |= low;
        low = busy;
        if (high != 0) {
            const std::uint64_t busy_high = port[word + 1] & high;
            port[word + 1] |= high;
            high = busy_high;
        }
    }
}

} // namespace degs
