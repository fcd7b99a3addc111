// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/cooling_places.hpp"

#include <algorithm>
#include <array>
#include <random>

#include <gtest/gtest.h>

namespace degs {
namespace {

constexpr std::uint64_t bit(int place) {
    return std::uint64_t{1} << place;
}

TEST(CoolingPlaces, CoolUntilTheirDate) {
    CoolingPlaces places;
    EXPECT_EQ(places.at(10), 0U);
    places.cool(3, 15);
    places.cool(63, 12);
    EXPECT_EQ(places.next_end(~std::uint64_t{0}), 12U);
    EXPECT_EQ(places.next_end(bit(3)), 15U);
    EXPECT_EQ(places.next_end(bit(4)), kNever);
    EXPECT_EQ(places.at(11), bit(3) | bit(63));
    EXPECT_EQ(places.at(12), bit(3));
    EXPECT_EQ(places.at(14), bit(3));
    EXPECT_EQ(places.at(15), 0U);
}

TEST(CoolingPlaces, ForgottenPlacesNeitherCoolNorEnd) {
    CoolingPlaces places;
    places.at(100);
    places.cool(5, 110);
    places.forget(bit(5));
    EXPECT_EQ(places.at(101), 0U);
    places.cool(5, 120);
    EXPECT_EQ(places.at(110), bit(5)); // the forgotten end ends nothing
    EXPECT_EQ(places.at(120), 0U);
}

// Against a date per place, with steps that also leap over the whole ring.
TEST(CoolingPlaces, AgreeWithADatePerPlace) {
    std::mt19937 random(7);
    const auto below = [&](std::uint32_t n) { return static_cast<int>(random() % n); };
    CoolingPlaces places;
    std::array<Cycle, 64> end{};
    Cycle date = 0;
    for (int step = 0; step < 20000; ++step) {
        date += below(50) == 0 ? below(500) : below(4);
        std::uint64_t expected = 0;
        Cycle next = kNever;
        for (int place = 0; place < 64; ++place) {
            if (end[place] > date) {
                expected |= bit(place);
                next = std::min(next, end[place]);
            }
        }
        ASSERT_EQ(places.at(date), expected);
        ASSERT_EQ(places.next_end(~std::uint64_t{0}), next);
        const int place = below(64);
        if (below(100) == 0) {
            places.forget(bit(place));
            end[place] = 0;
        } else if ((expected & bit(place)) == 0) {
            end[place] = date + 1 + below(CoolingPlaces::kDates - 1);
            places.cool(place, end[place]);
        }
    }
}

} // namespace
} // namespace degs
