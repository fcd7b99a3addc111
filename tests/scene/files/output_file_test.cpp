// SPDX-License-Identifier: Apache-2.0
#include "scene/files/output_file.hpp"

#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

TEST(OutputFile, KeepsTheOldContentUntilTheNewIsComplete) {
    const test::Folder folder;
    const std::string path = folder.write("result.txt", "old");
    write_atomically(path, [&](const std::string& temporary) {
        EXPECT_EQ(std::filesystem::path(temporary).parent_path(),
                  std::filesystem::path(path).parent_path());
        std::ofstream(temporary) << "new";
        EXPECT_EQ(test::bytes_of(path), "old");
        EXPECT_EQ(folder.entries(), 2U);
    });
    EXPECT_EQ(test::bytes_of(path), "new");
    EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, CleansUpWhenWritingFails) {
    const test::Folder folder;
    const std::string path = folder.write("result.txt", "old");
    EXPECT_THROW(write_atomically(path,
                                  [](const std::string& temporary) {
                                      std::ofstream(temporary) << "half";
                                      throw InputError("The disk is full.");
                                  }),
                 InputError);
    EXPECT_EQ(test::bytes_of(path), "old");
    EXPECT_EQ(folder.entries(), 1U);
}

TEST(OutputFile, MayBeNamedWithoutAFolder) {
    const test::Folder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path(""));
    write_atomically("plain.txt",
                     [](const std::string& temporary) { std::ofstream(temporary) << "x"; });
    std::filesystem::current_path(before);
    EXPECT_EQ(test::bytes_of(folder.path("plain.txt")), "x");
}

// Two files of a set and one of an earlier run that the new set has not.
TEST(FileSet, ReplacesTheFilesOfAnEarlierRun) {
    const test::Folder folder;
    const std::string first = folder.write("a.txt", "old"), second = folder.path("b.txt");
    const std::string gone = folder.write("c.txt", "old");
    {
        FileSet set;
        for (const std::string& path : {first, second}) {
            write_atomically(
                path, [](const std::string& temporary) { std::ofstream(temporary) << "new"; });
        }
        EXPECT_EQ(test::bytes_of(first), "old");
        set.publish({first, gone});
    }
    EXPECT_EQ(test::bytes_of(first), "new");
    EXPECT_EQ(test::bytes_of(second), "new");
    EXPECT_EQ(folder.entries(), 2U);
}

} // namespace
} // namespace degs
