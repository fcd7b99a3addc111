// SPDX-License-Identifier: Apache-2.0
// Broken and malicious SPZ files: one sentence each, under the sanitizers too.
#include "scene/spz/spz.hpp"

#include <random>

#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/spz/spz_builder.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::SpzBuilder;

std::string complaint_about_spz(const std::string& bytes) {
    std::string sentence = test::complaint([&] { decode_spz("bad.spz", bytes); });
    EXPECT_EQ(sentence.rfind("bad.spz: ", 0), 0U) << sentence;
    return sentence;
}

TEST(HostileSpz, TruncatedAnywhereIsOneSentence) {
    for (const std::uint32_t version : {1U, 2U, 3U, 4U}) {
        const std::string file = SpzBuilder::scene(version, 5, 1).file();
        for (std::size_t size = 0; size < file.size(); ++size) {
            ASSERT_THAT(complaint_about_spz(file.substr(0, size)), IsSentenceWith("bad.spz: "))
                << version << " " << size;
        }
    }
}

// ZSTD writes 128 KiB of one byte as 4.
TEST(HostileSpz, RunsAreRead) {
    SpzBuilder spz = SpzBuilder::scene(4, 400000, 0);
    for (std::string& attribute : spz.attributes) {
        attribute.assign(attribute.size(), '\x40');
    }
    const std::string file = spz.file();
    EXPECT_LT(file.size() * 1024, 400000U * 20U);
    EXPECT_EQ(decode_spz("made.spz", file).cloud.size(), 400000U);
}

TEST(HostileSpz, SmallFilesThatWouldFillTheMemory) {
    for (const std::uint32_t version : {3U, 4U}) {
        SpzBuilder spz = SpzBuilder::scene(version, 1, 0);
        spz.count = 4000000; // 80 MB
        std::mt19937 draw(1);
        for (int k = 0; k < 100000; ++k) { // as many as deflate could make of these
            spz.attributes[0] += static_cast<char>(draw());
        }
        const std::string words = "its data would grow from ";
        EXPECT_THAT(complaint_about_spz(spz.file()), IsSentenceWith(words)) << version;
    }
}

TEST(HostileSpz, WithoutASignatureIsNotRead) {
    const test::Folder folder;
    const std::string file = folder.write("s.spz", "no");
    std::filesystem::resize_file(file, std::uintmax_t{1} << 40U); // more than any memory
    EXPECT_THAT(test::complaint([&] { read_spz(file); }),
                IsSentenceWith("its first bytes are 'no"));
}

TEST(HostileSpz, HeadersThatLie) {
    const SpzBuilder good = SpzBuilder::scene(3, 5, 1);
    SpzBuilder bad = good;
    bad.magic = 0x12345678;
    EXPECT_THAT(complaint_about_spz(bad.file()), IsSentenceWith("'NGSP'"));
    for (const std::uint32_t version : {0U, 5U, 0xffffffffU}) {
        bad = good;
        bad.version = version;
        EXPECT_THAT(complaint_about_spz(bad.file()),
                    IsSentenceWith("SPZ version " + std::to_string(version)));
    }
    for (const std::uint32_t version : {1U, 3U, 4U}) {
        for (const std::uint32_t count : {0U, 2147483648U, 4294967295U}) {
            bad = SpzBuilder::scene(version, 5, 1);
            bad.count = count;
            EXPECT_THAT(complaint_about_spz(bad.file()),
                        IsSentenceWith(std::to_string(count) + " Gaussians"));
        }
        bad.count = 2147483647;
        EXPECT_THAT(complaint_about_spz(bad.file()), IsSentenceWith("more than a file of"));
        for (const std::uint32_t count : {1U, 4U, 6U}) {
            bad.count = count;
            EXPECT_THAT(complaint_about_spz(bad.file()), IsSentenceWith("its header"));
        }
        bad = SpzBuilder::scene(version, 5, 1);
        bad.degree = 5;
        EXPECT_THAT(complaint_about_spz(bad.file()), IsSentenceWith("degree 5"));
        bad.degree = 1;
        bad.fractional_bits = 32;
        EXPECT_THAT(complaint_about_spz(bad.file()), IsSentenceWith("32 fractional bits"));
    }
}

/// A position has 6 bytes in version 1 and 9 in version 2.
TEST(HostileSpz, VersionsThatLieAreOfAnotherLength) {
    SpzBuilder bad = SpzBuilder::scene(2, 5, 1);
    bad.version = 1;
    EXPECT_THAT(complaint_about_spz(bad.file()), IsSentenceWith("holds more bytes"));
    bad = SpzBuilder::scene(1, 5, 1);
    bad.version = 2;
    EXPECT_THAT(complaint_about_spz(bad.file()), IsSentenceWith("holds fewer bytes"));
    bad.version = 1;
    EXPECT_THAT(complaint_about_spz(bad.inflated()), IsSentenceWith("SPZ version 1 must be"));
}

TEST(HostileSpz, RecordsThatLie) {
    for (const std::uint32_t version : {3U, 4U}) {
        SpzBuilder spz = SpzBuilder::scene(version, 5, 1);
        spz.flags = 2;
        for (const std::string& records :
             {std::string("abc"), SpzBuilder::u32(1) + SpzBuilder::u32(0xffffffff),
              SpzBuilder::record(7, "four") + "x"}) {
            spz.records = records;
            EXPECT_THAT(complaint_about_spz(spz.file()), IsSentenceWith("extension record"));
        }
        for (const std::uint32_t system : {0U, 9U, 16U, 17U}) {
            spz.records = SpzBuilder::record(0xADBE0003, SpzBuilder::u32(system));
            EXPECT_THAT(complaint_about_spz(spz.file()), IsSentenceWith("coordinate-system"));
        }
        spz.records = SpzBuilder::record(0xADBE0003, "");
        EXPECT_THAT(complaint_about_spz(spz.file()), IsSentenceWith("coordinate-system"));
    }
    SpzBuilder spz = SpzBuilder::scene(3, 5, 1); // data without the flag
    spz.records = "x";
    EXPECT_THAT(complaint_about_spz(spz.file()), IsSentenceWith("more bytes"));
    spz.flags = 2;
    spz.records = std::string(100000, '\0');
    EXPECT_THAT(complaint_about_spz(spz.file()), IsSentenceWith("65536 bytes"));
}

TEST(HostileSpz, ContainersThatLie) {
    const SpzBuilder good = SpzBuilder::scene(3, 5, 1);
    EXPECT_EQ(decode_spz("padded.spz", good.file() + std::string(3, '\0')).cloud.size(), 5U);
    EXPECT_THAT(complaint_about_spz(good.file() + "x"), IsSentenceWith("1 bytes follow"));
    EXPECT_THAT(complaint_about_spz(good.inflated()), IsSentenceWith("compressed by gzip"));
    const SpzBuilder four = SpzBuilder::scene(4, 5, 1);
    EXPECT_THAT(complaint_about_spz(SpzBuilder::gzip(four.inflated())), IsSentenceWith("ZSTD"));
    EXPECT_THAT(complaint_about_spz(four.file() + "x"), IsSentenceWith("1 bytes follow"));
    EXPECT_THAT(complaint_about_spz("plain text"), IsSentenceWith("gzip"));
    for (const int place : {15, 16, 19, 32, 39, 40, 47}) { // streams, offset, sizes
        std::string bytes = four.file();
        bytes[place] = static_cast<char>(bytes[place] ^ 0x55);
        EXPECT_THAT(complaint_about_spz(bytes),
                    IsSentenceWith(place < 32 ? "table of contents" : "its"))
            << place;
    }
}

/// Every bit of small files, and bytes of the inflated data: loads or complains, nothing else.
TEST(HostileSpz, MembersOfGzipAreOneText) {
    for (const std::uint32_t version : {1U, 2U, 3U}) {
        const SpzBuilder spz = SpzBuilder::scene(version, 5, 1);
        const GaussianCloud whole = decode_spz("one.spz", spz.file()).cloud;
        const std::string plain = spz.inflated();
        std::string members;
        for (std::size_t at = 0; at < plain.size(); at += 11) {
            members += SpzBuilder::gzip(plain.substr(at, 11)) + SpzBuilder::gzip("");
        }
        const GaussianCloud cloud = decode_spz("many.spz", members + std::string(3, '\0')).cloud;
        EXPECT_EQ(cloud.means, whole.means);
        EXPECT_EQ(cloud.sh, whole.sh);
        EXPECT_THAT(complaint_about_spz(members + "x"), IsSentenceWith("1 bytes follow"));
        EXPECT_THAT(complaint_about_spz(members + SpzBuilder::gzip("x")),
                    IsSentenceWith("holds more bytes"));
        EXPECT_THAT(complaint_about_spz(members.substr(0, members.size() - 1)),
                    IsSentenceWith("ends too early"));
    }
}

TEST(HostileSpz, RecordsThatNoFlagAnnounces) {
    for (const std::uint32_t version : {3U, 4U}) {
        SpzBuilder spz = SpzBuilder::scene(version, 5, 1);
        spz.records = SpzBuilder::record(0xADBE0003, SpzBuilder::u32(4));
        spz.flags = 2;
        EXPECT_EQ(decode_spz("good.spz", spz.file()).cloud.size(), 5U);
        spz.flags = 0;
        EXPECT_THAT(complaint_about_spz(spz.file()),
                    IsSentenceWith(version == 4 ? "12 bytes lie between" : "holds more bytes"));
    }
}

TEST(HostileSpz, FlippedBitsLoadOrComplain) {
    int loaded = 0, refused = 0;
    const auto attempt = [&](const std::string& bytes) {
        const std::string sentence = test::complaint([&] { decode_spz("flip.spz", bytes); });
        sentence.empty() ? ++loaded : ++refused;
        ASSERT_TRUE(sentence.empty() || testing::Value(sentence, IsSentenceWith("flip.spz: ")));
    };
    for (const std::uint32_t version : {1U, 2U, 3U, 4U}) {
        const SpzBuilder spz = SpzBuilder::scene(version, 5, 2);
        const std::string file = spz.file();
        for (std::size_t bit = 0; bit < file.size() * 8; ++bit) {
            std::string bytes = file;
            bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
            attempt(bytes);
        }
        for (std::size_t bit = 0; version != 4 && bit < 16 * 8; ++bit) {
            std::string bytes = spz.inflated();
            bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
            attempt(SpzBuilder::gzip(bytes));
        }
    }
    EXPECT_GT(loaded, 20);
    EXPECT_GT(refused, 1000);
}

} // namespace
} // namespace degs
