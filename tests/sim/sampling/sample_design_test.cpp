// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/sample_design.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "sim/sampling/group_totals.hpp"
#include "sim/sampling/stopping_rule.hpp"

namespace degs::sim {
namespace {

/// Tiles whose work rises with their number.
std::vector<TileWork> rising(std::size_t tiles) {
    std::vector<TileWork> work;
    for (std::size_t t = 0; t < tiles; ++t) {
        const auto size = static_cast<double>(t + 1);
        work.push_back({1, 1024, size, size, size, size, size});
    }
    return work;
}

TEST(SampleDesign, DealsEveryTileBetweenTheEndsOnce) {
    const SampleDesign design = design_sample(rising(503), {16, 2, 24}, 5);
    std::vector<int> seen(503, 0);
    for (const std::vector<std::size_t>& group : design.groups) {
        const auto work = [&design](std::size_t b) { // of its last tile, times its tiles
            const TileBlock& block = design.blocks[b];
            return block.count * (block.first + block.count);
        };
        EXPECT_TRUE(std::is_sorted(group.begin(), group.end(), [&](std::size_t a, std::size_t b) {
            return work(a) < work(b);
        }));
        for (const std::size_t b : group) {
            for (std::size_t i = 0; i < design.blocks[b].count; ++i) {
                ++seen[design.blocks[b].first + i];
            }
        }
    }
    for (std::size_t t = 0; t < seen.size(); ++t) {
        EXPECT_EQ(seen[t], t < 16 || t >= 503 - 16 ? 0 : 1) << t;
    }
}

TEST(SampleDesign, GivesEachGroupOneBlockOfEachStratum) {
    const SampleDesign design = design_sample(rising(10 * 20 + 8), {4, 1, 20}, 9);
    ASSERT_EQ(design.groups.size(), 10U);
    for (const std::vector<std::size_t>& group : design.groups) {
        ASSERT_EQ(group.size(), 20U);
        for (std::size_t stratum = 0; stratum < group.size(); ++stratum) {
            EXPECT_EQ(group[stratum] / 10, stratum); // work rises with the number
        }
        std::set<std::size_t> places; // in the strata, drawn anew for each
        for (const std::size_t block : group) {
            places.insert(block % 10);
        }
        EXPECT_GT(places.size(), 4U);
    }
}

TEST(SampleDesign, FollowsItsSeed) {
    const auto groups = [](std::uint64_t seed) {
        return design_sample(rising(400), {16, 2, 24}, seed).groups;
    };
    EXPECT_EQ(groups(1), groups(1));
    EXPECT_NE(groups(1), groups(2));
}

TEST(SampleDesign, HasNoGroupsWithoutTilesBetweenTheEnds) {
    EXPECT_TRUE(design_sample(rising(32), {16, 2, 24}, 1).groups.empty());
    EXPECT_TRUE(design_sample({}, {16, 2, 24}, 1).groups.empty());
}

TEST(StoppingRule, NamesTheLeastNumberOfTilesThatCanBeSampled) {
    SamplingRequest within, share;
    within.within = 0.01;
    share.share = 0.1;
    for (const int contexts : {1, 2, 8}) {
        for (const SamplingRequest& request : {within, share}) {
            const std::size_t least = least_tiles(request, contexts);
            EXPECT_TRUE(can_sample(request, contexts, least)) << contexts;
            EXPECT_TRUE(can_sample(request, contexts, 3 * least)) << contexts;
            EXPECT_FALSE(can_sample(request, contexts, least - 1)) << contexts;
            const SampleDesign design = design_sample(rising(least), sizes_for(contexts, least), 1);
            EXPECT_GE(design.groups.size(), 2 * kLeastGroups) << contexts;
        }
        EXPECT_LE(least_tiles(share, contexts), least_tiles(within, contexts));
    }
}

TEST(StoppingRule, StopsWhereTheIntervalIsNarrowEnough) {
    SamplingRequest request;
    request.within = 0.01;
    EXPECT_EQ(judge_sample(request, 0.1, 0.0099, true), Verdict::Enough);
    EXPECT_EQ(judge_sample(request, 0.1, 0.012, true), Verdict::More);
    // A tenth of the tiles gives 6 %: 1 % would take odds of 36 / 9, which is 80 % of the tiles.
    EXPECT_EQ(judge_sample(request, 0.1, 0.06, true), Verdict::Hopeless);
    EXPECT_EQ(judge_sample(request, 0.51, 0.0101, true), Verdict::Hopeless);
    EXPECT_EQ(judge_sample(request, 0.1, 0.0101, false), Verdict::Hopeless);
}

TEST(StoppingRule, StopsAtTheShare) {
    SamplingRequest request;
    request.share = 0.2;
    EXPECT_EQ(judge_sample(request, 0.19, 0.5, true), Verdict::More);
    EXPECT_EQ(judge_sample(request, 0.2, 0.5, true), Verdict::Enough);
    EXPECT_EQ(judge_sample(request, 0.1, 0.5, false), Verdict::Enough);
}

TEST(GroupTotals, ScaleEachAmountWithTheSizeThatExplainsIt) {
    GroupTotals totals({1000, 5, 7});
    // The first amount is 3 per list entry, the second 2 per tile, the third is never counted.
    totals.add({3 * 50, 2 * 4, 0}, {4, 100, 50, 40, 10, 20, 20});
    totals.add({3 * 20, 2 * 5, 0}, {5, 130, 20, 19, 30, 25, 10});
    totals.add({3 * 90, 2 * 4, 0}, {4, 90, 90, 21, 22, 60, 55});
    const TileWork rest{100, 2500, 1700, 900, 500, 800, 700};
    const std::vector<double> all = totals.totals(rest, totals.groups());
    EXPECT_DOUBLE_EQ(all[0], 1000 + 3 * 1700);
    EXPECT_DOUBLE_EQ(all[1], 5 + 2 * 100);
    EXPECT_DOUBLE_EQ(all[2], 7);
    EXPECT_EQ(totals.totals(rest, 1), all) << "exact proportions do without any group";
    totals.add_known({10, 20, 30});
    EXPECT_DOUBLE_EQ(totals.totals(rest, 1)[1], 5 + 20 + 2 * 100);
}

} // namespace
} // namespace degs::sim
