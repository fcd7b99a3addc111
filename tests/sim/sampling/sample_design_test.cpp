// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/sample_design.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/ratio.hpp"
#include "sim/sampling/group_totals.hpp"
#include "sim/sampling/regression.hpp"
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
    EXPECT_EQ(judge_sample(request, 0.39, 0.06, true), Verdict::More);
    EXPECT_EQ(judge_sample(request, 0.4, 0.0101, true), Verdict::Spent);
    EXPECT_EQ(judge_sample(request, 0.1, 0.0101, false), Verdict::Spent);
}

TEST(StoppingRule, LooksAfterAQuarterMoreGroupsEachTime) {
    const std::vector<std::size_t> groups{12, 15, 19, 24, 30, 37, 46};
    for (std::size_t look = 0; look < groups.size(); ++look) {
        EXPECT_EQ(groups_at_look(look), groups[look]);
    }
}

/// Runs whose cycles differ from what was expected by errors that are skew as those of frames are:
/// many small ones below, few large ones above.
struct SkewFrame {
    std::vector<TileWork> work; ///< of tiles
    std::vector<double> cycles; ///< of blocks
    double total = 0;
    SampleSizes sizes = sizes_for(2, 8000);

    explicit SkewFrame(std::uint64_t seed) : work(8000) {
        std::mt19937_64 random(seed);
        std::lognormal_distribution<double> size(0, 1), error(0, 0.7);
        for (TileWork& tile : work) {
            tile.cycles = tile.fragments = tile.rows = 100 * size(random);
        }
        const SampleDesign design = design_sample(work, sizes, 1);
        for (const TileBlock& block : design.blocks) {
            double expected = 0;
            for (std::size_t t = block.first; t < block.first + block.count; ++t) {
                expected += work[t].cycles;
            }
            cycles.push_back(expected + 40 * (error(random) - std::exp(0.245)));
            total += cycles.back();
        }
    }
};

// Intervals hold in 95 of 100 runs that stop because theirs is narrow, although each could have
// stopped at several looks.
TEST(StoppingRule, IntervalsHoldWhereRunsStop) {
    SamplingRequest request;
    request.within = 0.006;
    int held = 0, stopped = 0, looks_in_all = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        const SkewFrame frame(seed / 50);
        const SampleDesign design = design_sample(frame.work, frame.sizes, seed);
        std::vector<TileWork> blocks;
        for (const TileBlock& block : design.blocks) {
            blocks.push_back(kNoWork);
            for (std::size_t t = block.first; t < block.first + block.count; ++t) {
                blocks.back() += frame.work[t];
            }
        }
        RegressionEstimator estimator(blocks);
        std::size_t group = 0, looks = 0;
        for (Verdict verdict = Verdict::More; verdict == Verdict::More; ++looks) {
            for (; group < std::min(groups_at_look(looks), design.groups.size()); ++group) {
                for (const std::size_t b : design.groups[group]) {
                    estimator.add(b, group, {frame.cycles[b]});
                }
            }
            const Estimate found = estimator.total(0, kLookConfidence);
            const double share = ratio_of(estimator.blocks(), blocks.size());
            verdict = judge_sample(request, share, found.half_width / found.value,
                                   group < design.groups.size());
            if (verdict == Verdict::Enough) {
                ++stopped;
                held += std::abs(found.value - frame.total) <= found.half_width ? 1 : 0;
            }
        }
        looks_in_all += static_cast<int>(looks);
    }
    EXPECT_GT(stopped, 500);
    EXPECT_GT(looks_in_all, 2 * stopped);
    // Three standard deviations of 600 draws below 95 %.
    EXPECT_GE(held, 0.923 * stopped);
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
