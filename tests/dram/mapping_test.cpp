// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <set>
#include <tuple>

#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

struct Choice {
    const char* file;
    int interleave_bytes;
    const char* order;
    bool fold;
};

/// Becomes part of the test's name.
void PrintTo(const Choice& choice, std::ostream* out) {
    *out << choice.file << ' ' << choice.interleave_bytes << " B, " << choice.order
         << (choice.fold ? ", folded" : "");
}

class Lpddr5Mappings : public ::testing::TestWithParam<Choice> {
protected:
    Lpddr5Mappings() : config(test::lpddr5_config(GetParam().file)) {
        config.mapping = {GetParam().interleave_bytes, GetParam().order, GetParam().fold,
                          GetParam().fold};
    }
    dram::Config config;
};

TEST_P(Lpddr5Mappings, IsOneToOne) {
    const dram::Mapping mapping(config.mapping, config.timing,
                                static_cast<unsigned>(config.channels));
    std::mt19937_64 random(3);
    for (int i = 0; i < 20000; ++i) {
        const std::uint64_t address = random() % (mapping.capacity() / 64) * 64;
        const dram::Place place = mapping.place(address + random() % 64);
        ASSERT_LT(place.channel, static_cast<unsigned>(config.channels));
        ASSERT_LT(place.bank, static_cast<unsigned>(config.timing.banks));
        ASSERT_LT(place.row, static_cast<unsigned>(config.timing.rows));
        ASSERT_LT(place.block, config.timing.page_bytes / dram::kAccessBytes);
        ASSERT_EQ(mapping.address(place), address);
    }
}

TEST_P(Lpddr5Mappings, KeepsAGrainInOneChannelAndSpreadsNeighbours) {
    const dram::Mapping mapping(config.mapping, config.timing,
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

dram::Mapping default_mapping(const dram::Config& config) {
    return {config.mapping, config.timing, static_cast<unsigned>(config.channels)};
}

// Without folding a power of two would leave channels out.
TEST(Lpddr5Mapping, StridesReachAllChannels) {
    const dram::Config config = test::lpddr5_config("lpddr5-6400x256");
    const dram::Mapping mapping = default_mapping(config);
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
    const dram::Config config = test::lpddr5_config("lpddr5-6400x256");
    const dram::Mapping mapping = default_mapping(config);
    std::map<std::tuple<unsigned, unsigned>, std::set<unsigned>> rows; // by channel and bank
    for (std::uint64_t stream = 0; stream < 4; ++stream) {
        for (std::uint64_t at = 0; at < 16384; at += 64) {
            const dram::Place place = mapping.place((stream << 28U) + at);
            rows[{place.channel, place.bank}].insert(place.row);
        }
    }
    EXPECT_EQ(rows.size(), 16U * 16U);
    for (const auto& [bank, different] : rows) {
        EXPECT_EQ(different.size(), 1U);
    }
}

/// Which address bits the default mapping XORs into each bit of a field, lowest bit first: the
/// bit's own place and, as docs/lpddr5.md says, bits above it.
struct Parities {
    std::vector<std::vector<unsigned>> channel, bank, row, block;
};

unsigned parity_of(const std::vector<std::vector<unsigned>>& field, std::uint64_t address) {
    unsigned value = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
        for (const unsigned bit : field[i]) {
            value ^= static_cast<unsigned>(address >> bit & 1U) << i;
        }
    }
    return value;
}

/// Bits `first`, `first` + 1, ... of the address, unfolded.
std::vector<std::vector<unsigned>> plain(unsigned first, unsigned count) {
    std::vector<std::vector<unsigned>> bits;
    for (unsigned i = 0; i < count; ++i) {
        bits.push_back({first + i});
    }
    return bits;
}

// 16 channels, 4 groups of 4: 6 bits in an access, column 2, channel 4, group 2, column 3, bank 2,
// row 15 from bit 19 on. Channel: every fourth bit above. Bank: every second bit of the row; group:
// every fourth, from the third on.
Parities with_groups() {
    return {{{8, 12, 16, 20, 24, 28, 32},
             {9, 13, 17, 21, 25, 29, 33},
             {10, 14, 18, 22, 26, 30},
             {11, 15, 19, 23, 27, 31}},
            {{17, 19, 21, 23, 25, 27, 29, 31, 33},
             {18, 20, 22, 24, 26, 28, 30, 32},
             {12, 21, 25, 29, 33},
             {13, 22, 26, 30}},
            plain(19, 15),
            {{6}, {7}, {14}, {15}, {16}}};
}

// 8 channels, 16 banks: column 2, channel 3, column 3, bank 4, row 15 from bit 18 on. Channel:
// every third bit above. Bank: every fourth bit of the row.
Parities without_groups() {
    return {{{8, 11, 14, 17, 20, 23, 26, 29, 32},
             {9, 12, 15, 18, 21, 24, 27, 30},
             {10, 13, 16, 19, 22, 25, 28, 31}},
            {{14, 18, 22, 26, 30}, {15, 19, 23, 27, 31}, {16, 20, 24, 28, 32}, {17, 21, 25, 29}},
            plain(18, 15),
            {{6}, {7}, {11}, {12}, {13}}};
}

void expect_parities(const char* file, const Parities& expected) {
    const dram::Config config = test::lpddr5_config(file);
    const dram::Mapping mapping = default_mapping(config);
    std::vector<std::uint64_t> addresses;
    for (std::uint64_t bit = 1; bit < mapping.capacity(); bit *= 2) {
        addresses.push_back(bit);
    }
    std::mt19937_64 random(5);
    for (int i = 0; i < 2000; ++i) {
        addresses.push_back(random() % mapping.capacity());
    }
    for (const std::uint64_t address : addresses) {
        const dram::Place place = mapping.place(address);
        ASSERT_EQ(place.channel, parity_of(expected.channel, address)) << std::hex << address;
        ASSERT_EQ(place.bank, parity_of(expected.bank, address)) << std::hex << address;
        ASSERT_EQ(place.row, parity_of(expected.row, address)) << std::hex << address;
        ASSERT_EQ(place.block, parity_of(expected.block, address)) << std::hex << address;
    }
}

TEST(Lpddr5Mapping, FoldsTheBitsThatItsPageNamesWithGroups) {
    expect_parities("lpddr5-6400x256", with_groups());
}

TEST(Lpddr5Mapping, FoldsTheBitsThatItsPageNamesWithoutGroups) {
    expect_parities("lpddr5-3200x128", without_groups());
}

TEST(Lpddr5Mapping, RefusesAnOrderThatIsNone) {
    dram::Config config;
    for (const char* order :
         {"", "column group bank", "column group bank row column:1", "column:9 group bank row",
          "column:x group bank row", "column group bank rows", "column: group bank row"}) {
        config.mapping.order = order;
        EXPECT_THROW(default_mapping(config), InputError) << order;
    }
}

} // namespace
} // namespace degs
