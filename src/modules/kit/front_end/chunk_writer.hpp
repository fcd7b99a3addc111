// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include <systemc>

#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/sram_ports.hpp"
#include "tlm/ceil_div.hpp"

namespace degs {

/// Writes chunks of splats to the Gaussian Buffer of every reader: when each has a place, and as
/// fast as the ports of the buffer allow. Part of the process that calls it.
class ChunkWriter {
public:
    using Out = sc_core::sc_vector<FifoPort<SplatChunk>>;
    using Released = sc_core::sc_vector<FifoPort<ChunkReleased>>;

    /// `places` for chunks, which `released` frees; 0: those of the rings. `instant`: no time of
    /// its own but that of limited ports.
    ChunkWriter(Out& out, Released& released, const BankedSramPorts& ports, std::size_t places,
                bool instant)
        : out_(out), released_(released), ports_(ports), places_(places), instant_(instant) {}

    void connect(Process& self) {
        for (auto& port : out_) {
            port->connect_writer(self);
        }
        for (auto& port : released_) {
            port->connect_reader(self);
        }
    }
    /// Moves the process to the date from which every reader has a place.
    void wait_for_place(Process& self) {
        for (auto& port : out_) {
            port->reserve(self);
        }
        if (taken_ < places_) {
            ++taken_;
            return;
        }
        for (auto& port : released_) {
            port->get(self);
        }
    }
    void put(Process& self, const SplatChunk& chunk, const Completion& ready) {
        for (auto& port : out_) {
            port->put_at(self, chunk, ready);
        }
    }
    /// The cycles that writing a chunk takes: one, none where records are there at once, or as many
    /// as limited ports need.
    Cycle cycles(const SplatChunk& chunk) const {
        const int least = instant_ ? 0 : 1;
        const int count = static_cast<int>(chunk.count);
        return ports_.limited() && count != 0
                   ? std::max(least, ceil_div(count, ports_.neighbours(count)))
                   : least;
    }

private:
    Out& out_;
    Released& released_;
    BankedSramPorts ports_;
    std::size_t places_, taken_ = 0;
    bool instant_;
};

} // namespace degs
