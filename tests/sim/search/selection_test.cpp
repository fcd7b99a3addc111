// SPDX-License-Identifier: Apache-2.0
#include "sim/search/selection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tests/sim/search/random_goals.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;
using Positions = std::vector<std::size_t>;

TEST(ParetoFront, GoesOnWithTheFrontOfTheRest) {
    const std::vector<Goals> goals{{1, 9}, {2, 5}, {3, 5.5}, {4, 1}, {2.5, 5.2}, {1, 10}};
    EXPECT_EQ(best_of(goals, 3), (Positions{0, 1, 3}));
    EXPECT_EQ(best_of(goals, 5), (Positions{0, 1, 3, 4, 5}));
    EXPECT_EQ(best_of(goals, 99).size(), goals.size());
}

// Among 1, 2, 2.1, 8 the two in the middle are neighbours; the ends stay.
TEST(ParetoFront, LosesItsClosestNeighboursFirst) {
    const std::vector<Goals> goals{{1, 8}, {2, 4}, {2.1, 3.9}, {8, 1}};
    const Positions three = best_of(goals, 3);
    EXPECT_EQ(three.front(), 0U);
    EXPECT_EQ(three.back(), 3U);
    EXPECT_EQ(best_of(goals, 2), (Positions{0, 3}));
}

/// The best of two goals as searches of two goals have always found them.
Positions best_of_two(const std::vector<Goals>& goals, std::size_t count) {
    Positions rest(goals.size());
    for (std::size_t i = 0; i < rest.size(); ++i) {
        rest[i] = i;
    }
    Positions best;
    while (best.size() < count && !rest.empty()) {
        std::sort(rest.begin(), rest.end(), [&](std::size_t a, std::size_t b) {
            return std::make_pair(goals[a], a) < std::make_pair(goals[b], b);
        });
        Positions front;
        Positions others;
        for (const std::size_t position : rest) {
            const bool better = front.empty() || goals[position][1] < goals[front.back()][1];
            (better ? front : others).push_back(position);
        }
        rest = others;
        while (front.size() > count - best.size()) {
            const auto gap = [&](std::size_t place) {
                const Goals& a = goals[front[place - 1]];
                const Goals& b = goals[front[place + 1]];
                return std::abs(std::log(b[0] / a[0])) + std::abs(std::log(a[1] / b[1]));
            };
            std::size_t closest = 0;
            for (std::size_t place = 1; place + 1 < front.size(); ++place) {
                closest = closest == 0 || gap(place) < gap(closest) ? place : closest;
            }
            front.erase(front.begin() + static_cast<std::ptrdiff_t>(closest));
        }
        best.insert(best.end(), front.begin(), front.end());
    }
    std::sort(best.begin(), best.end());
    return best;
}

TEST(ParetoFront, PromotesInTwoGoalsAsEver) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> number(0.1, 10);
    for (std::size_t round = 0; round < 300; ++round) {
        auto goals = random_goals(random, 60, 2);
        for (Goals& each : goals) {
            if (round % 2 == 0) {
                each = {number(random), number(random)};
            }
            each[1] = round % 3 == 0 ? -each[1] : each[1]; // a goal that shall be large
        }
        for (const std::size_t count : {1, 2, 3, 5, 8, 20, 59, 60}) {
            EXPECT_EQ(best_of(goals, count), best_of_two(goals, count)) << round << " " << count;
        }
    }
}

// There is no ratio over 0 or between signs: such neighbours are far apart.
TEST(ParetoFront, KeepsAnOrderWhereThereIsNoRatio) {
    EXPECT_EQ(best_of({{-1, 9}, {1, 4}, {2, 3.9}, {2.1, 3.8}, {9, -2}}, 4),
              (Positions{0, 1, 3, 4}));
}

// The best in each goal stay while there are places for them; then the closest drop out.
TEST(ParetoFront, KeepsTheBestInEachGoal) {
    const std::vector<Goals> goals{{1, 8, 8}, {8, 1, 8},     {8, 8, 1},
                                   {4, 4, 4}, {4.1, 3.9, 4}, {3, 5, 4}};
    EXPECT_EQ(best_of(goals, 3), (Positions{0, 1, 2}));
    const Positions five = best_of(goals, 5);
    EXPECT_EQ(five.size(), 5U);
    EXPECT_EQ((Positions{five[0], five[1], five[2]}), (Positions{0, 1, 2}));
    EXPECT_EQ(best_of({Goals{3}, Goals{1}, Goals{2}, Goals{1}}, 2), (Positions{1, 3}));
}

TEST(Standings, AreFrontAndRoom) {
    const std::vector<Standing> found = standings_of({{1, 8}, {2, 4}, {4, 2}, {8, 1}, {8, 8}});
    EXPECT_EQ(found[0].front, 0U);
    EXPECT_EQ(found[4].front, 1U);
    EXPECT_TRUE(std::isinf(found[0].room));
    EXPECT_NEAR(found[1].room, 2 * std::log(4), 1e-12); // from 1 to 4 and from 8 to 2
}

TEST(BestWithin, TakesWhatBreaksLimitsLast) {
    const std::vector<Goals> goals{{1, 1}, {5, 5}, {2, 2}, {9, 9}};
    EXPECT_EQ(best_within(goals, {0.2, 0, 0.1, 0}, 3), (Positions{1, 3, 2}));
    EXPECT_EQ(best_within(goals, {0.2, 0, 0.1, 0}, 1), Positions{1});
}

} // namespace
} // namespace degs::sim_test
