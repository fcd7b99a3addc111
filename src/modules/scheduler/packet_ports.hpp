// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "modules/sram_ports.hpp"
#include "splat/data_path.hpp"

namespace degs {

/// The SRAM ports that the tasks of one packet use. Every task reads the state of its pixel and
/// writes it `writeback_cycles` later, through as many write ports. All tasks of a splat in the
/// packet share one read of its parameters (paper, Sec. IV-C: the PE fetches them by G_ID).
///
/// Pixels of an Issue Bank's rows are dealt to the SRAM banks by their address, row after row; every
/// tile context has SRAM banks of its own, so that reading out a finished tile meets no task
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

    explicit PacketPorts(const Config& config) : config_(config) {}

    /// For the next packet.
    void clear();
    /// Takes the lowest tasks of `mask` whose ports are free, at most `most`, and returns them; 0 if
    /// there is none. `entry` of the Feature Buffer has the splat's parameters. A packet without
    /// tasks takes at least one.
    std::uint32_t take(const BlendTask& task, std::uint32_t mask, int entry, int most);

private:
    struct PixelReads {
        int context, sram_bank, count;
    };
    bool reads_parameters(int entry);
    bool reads_pixel(int context, int address);

    Config config_;
    std::vector<PixelReads> pixels_; // of this packet, as few as it has tasks
    std::vector<int> entries_;
};

} // namespace degs
