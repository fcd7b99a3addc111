// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/domain_lanes.hpp"

#include <random>

#include <gtest/gtest.h>

namespace degs {
namespace {

struct Plain {
    std::uint32_t key = DomainLanes::kTop, length = 0;
    Cycle date = 0;
    bool ready(Cycle at) const { return key < DomainLanes::kTop && date <= at; }
};

std::uint64_t rank_of(const Plain& domain, bool longest) {
    return longest ? std::uint64_t{~domain.length} << 32U | domain.key : domain.key;
}

std::uint64_t best_of(const std::vector<Plain>& domains, Cycle at, bool longest) {
    std::uint64_t best = ~std::uint64_t{0};
    for (const Plain& domain : domains) {
        best = domain.ready(at) ? std::min(best, rank_of(domain, longest)) : best;
    }
    return best;
}

std::uint32_t next_of(const std::vector<Plain>& domains, std::size_t first, Cycle at) {
    for (std::size_t i = 0; i < domains.size(); ++i) {
        const std::size_t domain = (first + i) % domains.size();
        if (domains[domain].ready(at)) {
            return static_cast<std::uint32_t>(domain);
        }
    }
    return DomainLanes::kTop;
}

Cycle wait_of(const std::vector<Plain>& domains, Cycle at) {
    Cycle wait = kNever;
    for (const Plain& domain : domains) {
        wait = domain.key < DomainLanes::kTop ? std::min(wait, domain.date - at) : wait;
    }
    return wait;
}

/// Numbers of domains.
class DomainLanesOf : public ::testing::TestWithParam<int> {};

// Dates pass the end of 32 bits.
TEST_P(DomainLanesOf, ChooseAsALoopDoes) {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    const int count = GetParam();
    const auto upto = [&](int n) { return static_cast<int>(random() % (n + 1U)); };
    std::vector<Plain> plain(count);
    DomainLanes in_turn(count), by_key(count);
    Cycle now = (Cycle{1} << 32U) - 500;
    in_turn.set_dates(now);
    by_key.set_dates(now);
    for (Plain& domain : plain) {
        domain.date = now;
    }
    for (int trial = 0; trial < 2000; ++trial, now += upto(2)) {
        const int number = upto(count - 1);
        Plain& domain = plain[number];
        domain.key = upto(3) == 0 ? DomainLanes::kTop : random() % (DomainLanes::kTop / 4096);
        domain.key = domain.key == DomainLanes::kTop ? domain.key : domain.key * 4096 + number;
        domain.length = domain.key == DomainLanes::kTop ? 0 : 1 + upto(4);
        domain.date = now + upto(9);
        const bool empty = domain.key == DomainLanes::kTop;
        if (count <= DomainLanes::kMostInTurn) {
            in_turn.set_waiting(number, !empty);
        }
        by_key.set_key(number, domain.key);
        by_key.set_length(number, domain.length);
        in_turn.set_date(number, domain.date);
        by_key.set_date(number, domain.date);
        const int first = upto(count - 1);
        if (count <= DomainLanes::kMostInTurn) {
            ASSERT_EQ(in_turn.next_from(first, now), next_of(plain, first, now));
        }
        ASSERT_EQ(by_key.next_keyed_from(first, now), next_of(plain, first, now));
        const std::uint64_t best = best_of(plain, now, false);
        const bool none = best == ~std::uint64_t{0};
        ASSERT_EQ(by_key.least(now) >= DomainLanes::kTop, none);
        ASSERT_EQ(by_key.longest(now), best_of(plain, now, true));
        if (none) {
            ASSERT_EQ(by_key.until_next(now), wait_of(plain, now));
            if (count <= DomainLanes::kMostInTurn) {
                ASSERT_EQ(in_turn.until_next_in_turn(now), wait_of(plain, now));
            }
        } else {
            ASSERT_EQ(by_key.least(now), best);
        }
    }
}

// The lanes of two tiles, of which each says what is of its own domains.
TEST_P(DomainLanesOf, ChooseFromTheirParts) {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    const int count = GetParam();
    const auto upto = [&](int n) { return static_cast<int>(random() % (n + 1U)); };
    DomainLanes all(2 * count);
    DomainLanes parts[] = {all.part(0, count), all.part(count, count)};
    std::vector<Plain> plain(2 * count);
    Cycle now = 1000;
    for (int trial = 0; trial < 2000; ++trial, now += upto(2)) {
        const int tile = upto(1);
        if (upto(50) == 0) { // a tile begins
            parts[tile].set_dates(now);
            for (int i = 0; i < count; ++i) {
                parts[tile].set_key(i, DomainLanes::kTop);
                plain[tile * count + i] = {DomainLanes::kTop, 0, now};
            }
        }
        const int number = upto(count - 1);
        Plain& domain = plain[tile * count + number];
        domain.key = 4096U * upto(1000) + tile * count + number;
        domain.date = now + upto(9);
        parts[tile].set_key(number, domain.key);
        parts[tile].set_date(number, domain.date);
        ASSERT_EQ(parts[tile].key(number), domain.key);
        const std::uint64_t best = best_of(plain, now, false);
        if (best == ~std::uint64_t{0}) {
            ASSERT_GE(all.least(now), DomainLanes::kTop);
            ASSERT_EQ(all.until_next(now), wait_of(plain, now));
        } else {
            ASSERT_EQ(all.least(now), best);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Counts, DomainLanesOf, ::testing::Values(1, 3, 8, 16, 31, 64, 65, 200));

} // namespace
} // namespace degs
