// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "modules/kit/job/messages.hpp"
#include "tlm/event_log.hpp"

namespace degs {

/// The tiles of an Issue Bank in its log (docs/block-log.md).
class BankLog {
public:
    explicit BankLog(EventLog& log)
        : log_(log),
          tile_(log.kind(
              "tile", {{"tile", {}}, {"context", {}}, {"first_column", {}}, {"last_column", {}}})),
          over_(log.kind("over", {{"tile", {}}, {"context", {}}})) {}

    /// Logs that a tile begins, of which the image has these columns.
    void enter(Cycle now, TileNumber number, std::int16_t context, const PixelRange& columns) {
        log_.begin(tile_, now);
        log_.put(number);
        log_.put(context);
        log_.put(columns.first);
        log_.put(columns.last);
    }
    /// Logs that all segments of the tile have been issued or dropped.
    void leave(Cycle now, TileNumber number, std::int16_t context) {
        log_.begin(over_, now);
        log_.put(number);
        log_.put(context);
    }

private:
    EventLog& log_;
    std::size_t tile_, over_;
};

} // namespace degs
