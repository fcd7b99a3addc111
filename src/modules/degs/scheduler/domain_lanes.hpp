// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "tlm/clock_domain.hpp"

namespace degs {

/// The conflict domains of a tile in flight, as the choice among them sees them: who has segments,
/// and a date for each, which the host compares several at a time. A date says from when the array
/// may touch the domain again; low bits are enough, because it lies near the date that is asked
/// about. A bank either has domains wait in turn, or gives each one that waits a key.
class DomainLanes {
public:
    /// The key of a domain without segments. All other keys are smaller.
    static constexpr std::uint32_t kTop = std::uint32_t{1} << 31U;
    static constexpr int kMostInTurn = 64;

    explicit DomainLanes(int domains)
        : size_(up_to(domains, kStep)), dated_(up_to(domains, kBlock)),
          numbers_(2 * std::size_t{size_} + dated_, ~0U), keys_(numbers_.data()),
          dates_(keys_ + size_), lengths_(dates_ + dated_) {
        std::fill_n(keys_, size_, kTop);
        while (mask_ + 1 < static_cast<std::uint32_t>(domains)) {
            mask_ = 2 * mask_ + 1;
        }
    }
    /// A view of `count` of these domains, from `first` on: keys, lengths and dates that are set
    /// there are set here. It answers key() alone, and must not outlive this object.
    DomainLanes part(int first, int count) {
        DomainLanes lanes(0);
        lanes.size_ = up_to(count, 1);
        lanes.keys_ = keys_ + first;
        lanes.dates_ = dates_ + first;
        lanes.lengths_ = lengths_ + first;
        return lanes;
    }
    /// At least the bits of the highest domain.
    std::uint32_t mask() const { return mask_; }
    std::uint32_t key(int domain) const { return keys_[domain]; }
    void set_key(int domain, std::uint32_t key) { keys_[domain] = key; }
    /// Sets how many segments wait in a domain. Only longest() needs it.
    void set_length(int domain, std::uint32_t length) { lengths_[domain] = ~length; }
    /// Sets whether a domain has segments. Only next_from() and until_next_in_turn() need it.
    void set_waiting(int domain, bool waits) {
        const std::uint64_t bit = std::uint64_t{1} << domain;
        waiting_ = waits ? waiting_ | bit : waiting_ & ~bit;
    }
    /// Sets the date from which a domain may be touched.
    void set_date(int domain, Cycle date) { dates_[domain] = static_cast<std::uint32_t>(date); }
    /// Sets the date from which every domain may be touched.
    void set_dates(Cycle date) { std::fill_n(dates_, size_, static_cast<std::uint32_t>(date)); }

    /// The smallest key of the domains that may be touched at `date`; not below kTop if there is
    /// none.
    __attribute__((always_inline)) std::uint32_t least(Cycle date) const {
        return least_of(date, [&](std::uint32_t i) { return load(keys_ + i); });
    }
    /// The next of up to kMostInTurn domains with segments that may be touched at `date`, from
    /// `first` on, in a circle; not below kTop if there is none.
    __attribute__((always_inline)) std::uint32_t next_from(std::uint32_t first, Cycle date) const {
        const Lanes next = all(static_cast<std::uint32_t>(date) + 1);
        std::uint64_t ready = before(dates_, next);
        for (std::uint32_t i = kBlock; i < dated_; i += kBlock) {
            ready |= std::uint64_t{before(dates_ + i, next)} << i;
        }
        ready &= waiting_;
        const std::uint64_t later = ready & ~std::uint64_t{0} << first;
        return ready == 0 ? kTop
                          : static_cast<std::uint32_t>(__builtin_ctzll(later != 0 ? later : ready));
    }
    /// The next domain with a key that may be touched at `date`, like next_from().
    std::uint32_t next_keyed_from(std::uint32_t first, Cycle date) const {
        for (std::uint32_t i = 0; i < size_; ++i) {
            const std::uint32_t domain = first + i < size_ ? first + i : first + i - size_;
            const auto left =
                static_cast<std::int32_t>(dates_[domain] - static_cast<std::uint32_t>(date));
            if (keys_[domain] < kTop && left <= 0) {
                return domain;
            }
        }
        return kTop;
    }
    /// The inverse of the greatest length in its upper half, below it the smallest key of those
    /// domains that have it; all bits if there is none.
    std::uint64_t longest(Cycle date) const {
        const std::uint32_t length =
            least_of(date, [&](std::uint32_t i) { return load(lengths_ + i); });
        if (length == ~0U) {
            return ~std::uint64_t{0};
        }
        const std::uint32_t key = least_of(date, [&](std::uint32_t i) {
            return load(keys_ + i) | Lanes(load(lengths_ + i) != all(length));
        });
        return std::uint64_t{length} << 32U | key;
    }
    /// The domain that has this key, of those of one tile.
    int domain_of(std::uint32_t key) const {
        const auto* const place = std::find(keys_, keys_ + size_, key);
        return static_cast<int>(place - keys_);
    }
    /// Cycles after `date` until one of the domains with segments may be touched, if none may at
    /// that date; kNever if none has segments.
    __attribute__((always_inline)) Cycle until_next(Cycle date) const {
        const Lanes now = all(static_cast<std::uint32_t>(date));
        const auto cycles = [&](std::uint32_t i) {
            return (load(dates_ + i) - now) | Lanes(Differences(load(keys_ + i)) < 0);
        };
        const std::uint32_t least = least_lane(smallest(cycles));
        return least >= kTop ? kNever : least;
    }
    /// What until_next() returns, of domains that wait in turn.
    Cycle until_next_in_turn(Cycle date) const {
        std::uint32_t least = kTop;
        for (std::uint64_t left = waiting_; left != 0; left &= left - 1) {
            const std::uint32_t cycles =
                dates_[__builtin_ctzll(left)] - static_cast<std::uint32_t>(date);
            least = std::min(least, cycles);
        }
        return least == kTop ? kNever : least;
    }

private:
    static constexpr std::uint32_t kLanes = 4;
    static constexpr std::uint32_t kStep = 2 * kLanes;  // domains that a turn of a loop looks at
    static constexpr std::uint32_t kBlock = 4 * kLanes; // dates that are compared at once
    using Lanes = std::uint32_t __attribute__((vector_size(kLanes * sizeof(std::uint32_t))));
    using Differences = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));

    static Lanes load(const std::uint32_t* from) {
        Lanes lanes;
        std::memcpy(&lanes, from, sizeof lanes);
        return lanes;
    }
    static Lanes all(std::uint32_t value) { return Lanes{value, value, value, value}; }
    static std::uint32_t up_to(int domains, std::uint32_t multiple) {
        return (static_cast<std::uint32_t>(domains) + multiple - 1) / multiple * multiple;
    }
    /// A bit for each of a block of dates that lies before `date`.
    __attribute__((always_inline)) static std::uint32_t before(const std::uint32_t* dates,
                                                               Lanes date) {
        const Lanes a = load(dates) - date, b = load(dates + kLanes) - date,
                    c = load(dates + 2 * kLanes) - date, d = load(dates + 3 * kLanes) - date;
#ifdef __SSE2__
        // Saturation keeps the sign.
        const auto packed = [](Lanes x, Lanes y) {
            return _mm_packs_epi32(reinterpret_cast<__m128i>(x), reinterpret_cast<__m128i>(y));
        };
        return static_cast<std::uint32_t>(
            _mm_movemask_epi8(_mm_packs_epi16(packed(a, b), packed(c, d))));
#else
        const auto signs = [](Lanes lanes) {
            lanes >>= 31;
            return lanes[0] | lanes[1] << 1U | lanes[2] << 2U | lanes[3] << 3U;
        };
        return signs(a) | signs(b) << 4U | signs(c) << 8U | signs(d) << 12U;
#endif
    }
    static Lanes smaller(Lanes a, Lanes b) {
        return a < b ? a : b;
    }
    static std::uint32_t least_lane(Lanes lanes) {
#if defined(__clang__) || __GNUC__ >= 12
        lanes = smaller(lanes, __builtin_shufflevector(lanes, lanes, 2, 3, 0, 1));
        lanes = smaller(lanes, __builtin_shufflevector(lanes, lanes, 1, 0, 3, 2));
        return lanes[0];
#else
        return std::min(std::min(lanes[0], lanes[1]), std::min(lanes[2], lanes[3]));
#endif
    }
    /// The least of the numbers that `numbers` gives for the lanes from a domain on.
    template <class Numbers>
    __attribute__((always_inline)) Lanes smallest(const Numbers& numbers) const {
        Lanes best = smaller(numbers(0), numbers(kLanes));
        for (std::uint32_t i = kStep; i < size_; i += kStep) {
            best = smaller(best, smaller(numbers(i), numbers(i + kLanes)));
        }
        return best;
    }
    /// The least of the numbers of the domains that may be touched at `date`; all bits if there is
    /// none.
    template <class Numbers>
    __attribute__((always_inline)) std::uint32_t least_of(Cycle date,
                                                          const Numbers& numbers) const {
        const Lanes now = all(static_cast<std::uint32_t>(date));
        return least_lane(smallest([&](std::uint32_t i) {
            return numbers(i) | Lanes(Differences(now - load(dates_ + i)) < 0);
        }));
    }

    // Domains, up to a multiple of kStep and kBlock; those in excess stay empty.
    std::uint32_t size_, dated_;
    std::uint64_t waiting_ = 0; // a bit for each of up to kMostInTurn domains
    std::vector<std::uint32_t> numbers_;
    std::uint32_t *keys_, *dates_, *lengths_; // in numbers_
    std::uint32_t mask_ = 0;
};

} // namespace degs
