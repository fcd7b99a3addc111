// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/supply/splat_outlet.hpp"

#include "tlm/has_process.hpp"

namespace degs {

SplatOutlet::SplatOutlet(const sc_core::sc_module_name& name, const Timebase& time,
                         std::size_t readers, const BankedSramPorts& ports, std::size_t places,
                         bool instant)
    : sc_core::sc_module(name), in("in"), out("out", readers),
      released("released", places == 0 ? 0 : readers), moved("moved"), self_(time),
      writer_(out, released, ports, places, instant) {
    DEGS_HAS_PROCESS(SplatOutlet);
    SC_THREAD(run);
    self_.show(*this);
}

void SplatOutlet::end_of_elaboration() {
    in->connect_reader(self_);
    moved->connect_writer(self_);
    writer_.connect(self_);
}

void SplatOutlet::run() {
    for (TileNumber tile = 0; tile != kNoTile;) {
        const SplatChunk chunk = in->arrive(self_);
        tile = chunk.tile;
        writer_.wait_for_place(self_);
        in->drop(self_);
        moved->put(self_, {});
        writer_.put(self_, chunk, 0);
        self_.advance(writer_.cycles(chunk));
    }
    self_.finish();
}

} // namespace degs
