// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>

#include "modules/kit/analytic/ring_dates.hpp"

namespace degs {

/// Memory as a rate and a latency that serves requests in the order of their dates, like `Memory`,
/// for a stream that waits for its data and others that post theirs in bursts.
class MemoryDates {
public:
    /// The bandwidth is in bytes per cycle, the latency in cycles.
    MemoryDates(double bytes_per_cycle, double latency)
        : bytes_per_cycle_(bytes_per_cycle), latency_(latency) {}

    /// Reserves the bus from `date` on for `bytes` that others move.
    void post(double date, double bytes);
    /// The date of the last byte of a read of `bytes` that is asked for at `date`. If the memory
    /// has been busy since a later date, the read was served before that.
    double answer(double date, double bytes);

private:
    struct Burst {
        double date, bytes;
    };
    double serve(double date, double bytes);

    double bytes_per_cycle_, latency_;
    std::deque<Burst> posted_; ///< by date
    double began_ = 0;         ///< since when it is busy
    double free_ = 0;          ///< and until when
};

/// A Splat Fetcher without cycles: chunks of splats are asked for in order, each when there is a
/// place for it and fewer requests are in flight than may be.
class FetcherDates {
public:
    FetcherDates(std::size_t places, std::size_t in_flight)
        : places_(places), in_flight_(in_flight) {}

    /// Returns the date at which the next chunk, of `bytes`, is there.
    double next(MemoryDates& memory, double bytes);
    /// Frees the place of the chunk, which the reader takes at `date`.
    void take(double date) { places_.replace_oldest(date); }

private:
    RingDates places_, in_flight_;
    double asked_ = 0;
};

} // namespace degs
