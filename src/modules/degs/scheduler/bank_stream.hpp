// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "modules/kit/job/message_rings.hpp"

namespace degs {

class SpanReplay;

/// How far an Issue Bank is with the tiles of one tile stream. These come one after another and are
/// numbered by their turn.
struct BankStream {
    /// The spans that one Span Unit sends to the bank.
    struct Input {
        DatedFifo<SpanItem>* ring = nullptr;
        SpanReplay* spans = nullptr; ///< read in place of the ring, unless it is null
        std::size_t turn = 0;        ///< ends of tiles that it has delivered
    };

    std::size_t index = 0;
    BankStream* next = nullptr; ///< whose spans are taken after those of this one
    std::vector<Input> inputs;
    DatedFifo<TileNumber>* contexts_freed = nullptr;
    std::size_t oldest = 0;    ///< first turn that is not over for the bank
    std::size_t startable = 0; ///< turns below this one have a context of the Pixel Buffer
    std::size_t entering = 0;  ///< turn whose spans are accepted: one at a time, in order
    bool enterable = true;     ///< it may have spans in the queue
    bool entered = false;      ///< something of it has been taken
    std::size_t ends_seen = 0; ///< inputs that have delivered everything of it
    // The stream's tiles that may issue: places in the bank's list, which is stream by stream.
    std::size_t first_started = 0, end_started = 0;
    std::size_t issuing = 0; ///< place that is looked at in this cycle
    int ready = -1;          ///< a domain of that tile that may issue in this cycle; -1: none

    /// The first turn that is not over for the bank of those that have this one of the stream's
    /// `contexts`.
    std::size_t turn_of(int context, int contexts) const {
        return oldest + (context + contexts - oldest % contexts) % contexts;
    }
    /// The first turn that may not issue, or has nothing to issue yet.
    std::size_t first_unstarted() const {
        return std::min(startable, entering + (entered ? 1U : 0U));
    }
};

} // namespace degs
