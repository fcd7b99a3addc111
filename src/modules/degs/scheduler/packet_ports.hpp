// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/kit/job/sram_ports.hpp"
#include "splat/pixels/data_path.hpp"
#include "tlm/ceil_div.hpp"

namespace degs {

/// The SRAM ports that the tasks of one packet use. Every task reads the state of its pixel and
/// writes it `writeback_cycles` later, through as many write ports. All tasks of a splat in the
/// packet share one read of its parameters (paper, Sec. IV-C: the PE fetches them by G_ID).
///
/// Pixels of an Issue Bank's rows are dealt to the SRAM banks by their address, row after row;
/// every tile context has SRAM banks of its own, so that reading out a finished tile meets no task
/// [assumed].
class PacketPorts {
public:
    struct Config {
        BankedSramPorts pixels;   ///< of a tile context's part in an Issue Bank
        BankedSramPorts features; ///< of an Issue Bank's part of the Feature Buffer
        int tile_size = 32;       ///< px
        int banks = 8;            ///< Issue Banks, among which the rows of a tile are dealt
        bool limited() const { return pixels.limited() || features.limited(); }
    };

    explicit PacketPorts(const Config& config);

    /// Frees all ports, for the next packet.
    void clear() {
        ++packet_;
        reads_.clear();
    }
    /// Takes the lowest tasks of `mask` whose ports are free, at most `most`, and returns them; 0
    /// if there is none. `entry` of the Feature Buffer has the splat's parameters. A packet without
    /// tasks takes at least one.
    std::uint32_t take(const BlendTask& task, std::uint32_t mask, int entry, int most);
    /// The most packets of `width` tasks that the tasks `mask` of a row take beside one that is
    /// open. Neighbours in a row lie in different SRAM banks, unless there are too few of those.
    int most_packets(std::uint32_t mask, int width) const {
        const int tasks = __builtin_popcount(mask);
        return !spreads(mask) ? tasks : tasks <= width ? 1 : ceil_div(tasks, width);
    }
    /// Becomes a packet that takes the same tasks of `context` as `other` does.
    void imitate(const PacketPorts& other, int context);

private:
    struct Read {
        int entry, sram_bank;
    };
    // No two tasks of a row want the same SRAM bank.
    bool spreads(std::uint32_t mask) const {
        constexpr int kBits = 32;
        return !config_.pixels.limited() ||
               kBits - __builtin_clz(mask) - __builtin_ctz(mask) <= config_.pixels.sram_banks;
    }
    bool reads_parameters(int entry);
    std::uint32_t take_pixels(const BlendTask& task, std::uint32_t mask, int most);
    /// Ports of a context, all of them free if the packet has no task there.
    std::uint64_t* ports_of(std::size_t context) {
        if (context >= last_use_.size()) {
            last_use_.resize(context + 1, 0);
            taken_.resize((context + 1) * context_words_, 0);
        }
        std::uint64_t* const ports = &taken_[context * context_words_];
        if (last_use_[context] != packet_) {
            last_use_[context] = packet_;
            for (std::size_t word = 0; word < context_words_; ++word) {
                ports[word] = 0;
            }
        }
        return ports;
    }
    std::uint32_t full_from(const std::uint64_t* ports, int bank) const;
    void use(std::uint64_t* ports, int bank, std::uint32_t pixels) const;

    Config config_;
    std::vector<int> first_of_row_, bank_of_column_; // SRAM banks; their sum is a pixel's, modulo
    // Pixel Buffer: for every context and port, a bit per SRAM bank whose port of that number is
    // taken. Ports of a bank are taken in ascending order.
    std::size_t words_, context_words_;
    std::vector<std::uint64_t> taken_;
    std::vector<std::uint64_t> last_use_; // of a context: a value of packet_
    std::uint64_t packet_ = 1;
    std::vector<Read> reads_; // Feature Buffer
};

} // namespace degs
