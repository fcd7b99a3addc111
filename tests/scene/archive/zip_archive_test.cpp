// SPDX-License-Identifier: Apache-2.0
#include "scene/archive/zip_archive.hpp"

#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/zip_builder.hpp"

namespace degs {
namespace {

class HostileZipArchive : public ::testing::TestWithParam<bool> {};

// A byte of the content is another one than that of which the archive has the checksum.
TEST_P(HostileZipArchive, AChangedByteIsRefused) {
    const std::string content(5000, 'a');
    test::ZipBuilder zip;
    zip.deflated = GetParam();
    zip.files.emplace_back("file", content);
    std::string bytes = zip.file();
    const test::Folder folder;
    EXPECT_EQ(ZipArchive(folder.write("good.zip", bytes)).read("file", 5000), content);
    const std::size_t checksum = 14; // of the first local header, then that of the directory
    const std::string right = bytes.substr(checksum, 4);
    for (std::size_t at = 0; (at = bytes.find(right, at)) != std::string::npos; at += 4) {
        bytes[at] = static_cast<char>(bytes[at] ^ 1);
    }
    const ZipArchive archive(folder.write("bad.zip", bytes));
    EXPECT_THROW(archive.read("file", 5000), InputError);
}

TEST(HostileZip, TwoFilesOfOneNameAreRefused) {
    const test::Folder folder;
    test::ZipBuilder zip;
    zip.files = {{"meta.json", "{}"}, {"a", ""}, {"meta.json", "{\"version\": 2}"}};
    const std::string file = folder.write("a.zip", zip.file());
    EXPECT_THAT(test::complaint([&] { const ZipArchive archive(file); }),
                test::IsSentenceWith("the archive holds 'meta.json' twice"));
}

TEST(HostileZip, AFileThatWouldFillTheMemoryIsRefused) {
    const test::Folder folder;
    // In one file or in several, of which each would do by itself.
    const std::size_t most = std::size_t{64} << 20U;
    for (const std::vector<std::size_t>& sizes :
         {std::vector<std::size_t>{1U << 20U}, {most}, {most + 1}, {most / 2, most / 2, 1}}) {
        test::ZipBuilder zip;
        zip.deflated = true;
        std::size_t all = 0;
        for (const std::size_t size : sizes) {
            zip.files.emplace_back("file" + std::to_string(all), std::string(size, 'a'));
            all += size;
        }
        const std::string file = folder.write("a.zip", zip.file());
        if (all <= most) {
            EXPECT_EQ(ZipArchive(file).read("file0", 1U << 30U).size(), all);
        } else {
            EXPECT_THAT(test::complaint([&] { ZipArchive archive(file); }),
                        test::IsSentenceWith("what it holds would grow from "));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, HostileZipArchive, ::testing::Bool());

} // namespace
} // namespace degs
