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

INSTANTIATE_TEST_SUITE_P(Methods, HostileZipArchive, ::testing::Bool());

} // namespace
} // namespace degs
