// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "tlm/clock_domain.hpp"

namespace degs {

/// A scoreboard over up to 64 places, which cool for a while after each use. It is a ring of bit
/// sets, one per date, so that a date costs one operation on a word, however many places there are.
class CoolingPlaces {
public:
    /// A place cools for less than so many cycles.
    static constexpr Cycle kDates = 64;

    /// The places that still cool at `date`, which never falls from call to call: one bit each.
    std::uint64_t at(Cycle date) {
        if (date > date_) {
            pass(date);
        }
        return cooling_;
    }
    /// The place cools until `end`, which is 1 to kDates - 1 cycles after the date asked for last.
    /// It must not be cooling.
    void cool(int place, Cycle end) {
        const std::uint64_t bit = std::uint64_t{1} << place;
        cooling_ |= bit;
        ends_[end % kDates] |= bit;
    }
    /// The places are used anew, as if they had never been cooling.
    void forget(std::uint64_t places) {
        cooling_ &= ~places;
        for (std::uint64_t& end : ends_) {
            end &= ~places;
        }
    }
    /// The first date at which one of `places` has cooled, if one is cooling; kNever otherwise.
    Cycle next_end(std::uint64_t places) const {
        if ((places & cooling_) == 0) {
            return kNever;
        }
        Cycle date = date_ + 1;
        while ((ends_[date % kDates] & places) == 0) {
            ++date;
        }
        return date;
    }

private:
    void pass(Cycle date) {
        Cycle passed = date - date_ < kDates ? date_ : date - kDates;
        std::uint64_t cooled = 0;
        do {
            std::uint64_t& ended = ends_[++passed % kDates];
            cooled |= ended;
            ended = 0;
        } while (passed != date);
        cooling_ &= ~cooled;
        date_ = date;
    }

    Cycle date_ = 0;
    std::uint64_t cooling_ = 0;
    std::array<std::uint64_t, kDates>
        ends_{}; // by date modulo kDates: places that have cooled then
};

} // namespace degs
