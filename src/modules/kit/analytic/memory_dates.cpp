// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/memory_dates.hpp"

#include <algorithm>

namespace degs {

void MemoryDates::post(double date, double bytes) {
    auto place = posted_.end();
    while (place != posted_.begin() && std::prev(place)->date > date) {
        --place;
    }
    posted_.insert(place, {date, bytes});
}

double MemoryDates::serve(double date, double bytes) {
    const double cycles = bytes / bytes_per_cycle_;
    if (date < began_) {
        return date + cycles;
    }
    began_ = date > free_ ? date : began_;
    free_ = std::max(free_, date) + cycles;
    return free_;
}

double MemoryDates::answer(double date, double bytes) {
    for (; !posted_.empty() && posted_.front().date <= date; posted_.pop_front()) {
        serve(posted_.front().date, posted_.front().bytes);
    }
    return serve(date, bytes) + latency_;
}

double FetcherDates::next(MemoryDates& memory, double bytes) {
    // It asks whether the tile is over, and hands the chunk over: a cycle each.
    constexpr double kCyclesPerChunk = 2;
    asked_ = std::max({asked_ + kCyclesPerChunk, places_.oldest(), in_flight_.oldest()});
    const double answer = memory.answer(asked_, bytes);
    in_flight_.replace_oldest(answer);
    return answer;
}

} // namespace degs
