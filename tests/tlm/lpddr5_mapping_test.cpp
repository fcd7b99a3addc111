// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <set>
#include <tuple>

#include "tests/tlm/lpddr5_fixture.hpp"

namespace degs {
namespace {

struct Choice {
    const char* file;
    int interleave_bytes;
    const char* order;
    bool fold;
};

class Lpddr5Mappings : public ::testing::TestWithParam<Choice> {
protected:
    Lpddr5Mappings() : config(test::lpddr5_config(GetParam().file)) {
        config.mapping = {GetParam().interleave_bytes, GetParam().order, GetParam().fold,
                          GetParam().fold};
    }
    Lpddr5Config config;
};

TEST_P(Lpddr5Mappings, IsOneToOne) {
    const Lpddr5Mapping mapping(config.mapping, config.timing,
                                static_cast<unsigned>(config.channels));
    std::mt19937_64 random(3);
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t address = random() % (mapping.capacity() / 64) * 64;
        const Lpddr5Place place = mapping.place(address + random() % 64);
        ASSERT_LT(place.channel, static_cast<unsigned>(config.channels));
        ASSERT_LT(place.bank, kLpddr5Banks);
        ASSERT_LT(place.row, static_cast<unsigned>(config.timing.rows));
        ASSERT_LT(place.block, kLpddr5PageBytes / kLpddr5AccessBytes);
        ASSERT_EQ(mapping.address(place), address);
    }
}

TEST_P(Lpddr5Mappings, KeepsAGrainInOneChannelAndSpreadsNeighbours) {
    const Lpddr5Mapping mapping(config.mapping, config.timing,
                                static_cast<unsigned>(config.channels));
    const auto grain = static_cast<std::uint64_t>(GetParam().interleave_bytes);
    std::set<unsigned> channels;
    for (std::uint64_t c = 0; c < static_cast<std::uint64_t>(config.channels); ++c) {
        const unsigned channel = mapping.place(c * grain).channel;
        channels.insert(channel);
        for (std::uint64_t at = 0; at < grain; at += 64) {
            EXPECT_EQ(mapping.place(c * grain + at).channel, channel);
        }
    }
    EXPECT_EQ(channels.size(), static_cast<std::size_t>(config.channels));
}

INSTANTIATE_TEST_SUITE_P(
    Some, Lpddr5Mappings,
    ::testing::Values(Choice{"lpddr5-6400x256", 256, "column:2 group column bank row", true},
                      Choice{"lpddr5-6400x256", 64, "group column bank row", false},
                      Choice{"lpddr5-6400x128", 64, "column bank group row", true},
                      Choice{"lpddr5-6400x128", 256, "group row bank column", true},
                      Choice{"lpddr5-3200x128", 2048, "column bank:1 row:3 bank row", true}));

Lpddr5Mapping default_mapping(const Lpddr5Config& config) {
    return {config.mapping, config.timing, static_cast<unsigned>(config.channels)};
}

// Without folding a power of two would leave channels out.
TEST(Lpddr5Mapping, StridesReachAllChannels) {
    const Lpddr5Config config = test::lpddr5_config("lpddr5-6400x256");
    const Lpddr5Mapping mapping = default_mapping(config);
    for (std::uint64_t stride = 64; stride <= std::uint64_t{1} << 20U; stride *= 2) {
        std::vector<int> hits(16, 0);
        for (std::uint64_t i = 0; i < 4096; ++i) {
            ++hits[mapping.place(i * stride % mapping.capacity()).channel];
        }
        EXPECT_GE(*std::min_element(hits.begin(), hits.end()), 128) << stride;
    }
}

// Streams at equal offsets keep out of each other's banks, and each alternates its groups.
TEST(Lpddr5Mapping, StreamsApartByPowersOfTwoShareNoBank) {
    const Lpddr5Config config = test::lpddr5_config("lpddr5-6400x256");
    const Lpddr5Mapping mapping = default_mapping(config);
    std::map<std::tuple<unsigned, unsigned>, std::set<unsigned>> rows; // by channel and bank
    for (std::uint64_t stream = 0; stream < 4; ++stream) {
        for (std::uint64_t at = 0; at < 16384; at += 64) {
            const Lpddr5Place place = mapping.place((stream << 28U) + at);
            rows[{place.channel, place.bank}].insert(place.row);
        }
    }
    EXPECT_EQ(rows.size(), 16U * 16U);
    for (const auto& [bank, different] : rows) {
        EXPECT_EQ(different.size(), 1U);
    }
}

TEST(Lpddr5Mapping, RefusesAnOrderThatIsNone) {
    Lpddr5Config config;
    for (const char* order :
         {"", "column group bank", "column group bank row column:1", "column:9 group bank row",
          "column:x group bank row", "column group bank rows", "column: group bank row"}) {
        config.mapping.order = order;
        EXPECT_THROW(default_mapping(config), ConfigError) << order;
    }
}

} // namespace
} // namespace degs
