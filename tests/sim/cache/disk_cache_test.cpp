// SPDX-License-Identifier: Apache-2.0
// Entries on disk: whole or not at all, whatever happens to them.
#include "sim/cache/disk_cache.hpp"

#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "sim/cache/binary.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using sim::DiskCache;

std::optional<std::string> found(const DiskCache& cache, const std::string& key) {
    std::string text;
    const bool is_there = cache.find(key, [&text](const char* content, std::size_t bytes) {
        text.assign(content, bytes);
        return true;
    });
    return is_there ? std::optional(text) : std::nullopt;
}

std::vector<fs::path> files_in(const std::string& folder) {
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& file : fs::directory_iterator(folder, none)) {
        files.push_back(file.path());
    }
    return files;
}

TEST(DiskCache, KeepsEntriesUnderTheirKeys) {
    const Folder folder;
    const DiskCache cache(folder / "new/cache", 1000000);
    EXPECT_FALSE(found(cache, "a"));
    cache.put("a", "first");
    cache.put("b", std::string(100000, 'x') + '\0' + "y");
    EXPECT_EQ(found(cache, "a"), "first");
    EXPECT_EQ(found(cache, "b")->size(), 100002U);
    EXPECT_FALSE(found(cache, "ab"));
    cache.put("a", "");
    EXPECT_EQ(found(cache, "a"), "");
    EXPECT_EQ(files_in(folder / "new/cache").size(), 2U);
}

TEST(DiskCache, TakesDamagedEntriesForMissing) {
    const Folder folder;
    const DiskCache cache(folder / "c", 1000000);
    const std::string content(1000, 'x');
    cache.put("key", content);
    const fs::path file = files_in(folder / "c").at(0);
    const std::string good = read_file(file);
    // Every byte changed, every length cut; an entry of another key under this one's name.
    for (std::size_t i = 0; i < good.size(); i += 7) {
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ 0x10);
        std::ofstream(file, std::ios::binary) << bad;
        EXPECT_FALSE(found(cache, "key")) << "byte " << i;
        EXPECT_FALSE(fs::exists(file));
        std::ofstream(file, std::ios::binary) << good.substr(0, i);
        EXPECT_FALSE(found(cache, "key")) << i << " bytes";
    }
    std::ofstream(file, std::ios::binary) << good;
    EXPECT_EQ(found(cache, "key"), content);
    cache.put("kez", content);
    for (const fs::path& other : files_in(folder / "c")) {
        if (other != file) {
            fs::rename(other, file);
        }
    }
    EXPECT_FALSE(found(cache, "key"));
}

TEST(DiskCache, RemovesWhatTheReaderRefuses) {
    const Folder folder;
    const DiskCache cache(folder / "c", 1000000);
    cache.put("key", "content");
    EXPECT_FALSE(cache.find("key", [](const char*, std::size_t) { return false; }));
    EXPECT_TRUE(files_in(folder / "c").empty());
}

TEST(DiskCache, RemovesWhatWasNotUsedForTheLongestTime) {
    const Folder folder;
    const DiskCache cache(folder / "c", 10000);
    const std::string content(2300, 'x');
    for (const char* key : {"a", "b", "c", "d"}) {
        cache.put(key, content);
        for (const fs::path& file : files_in(folder / "c")) { // a clock may be coarse
            fs::last_write_time(file, fs::last_write_time(file) - std::chrono::seconds(10));
        }
    }
    EXPECT_TRUE(found(cache, "a")); // used now
    cache.put("e", content);
    EXPECT_FALSE(found(cache, "b"));
    for (const char* key : {"a", "c", "d", "e"}) {
        EXPECT_TRUE(found(cache, key)) << key;
    }
    cache.put("large", std::string(2501, 'x'));
    EXPECT_FALSE(found(cache, "large")); // more than a quarter
}

TEST(DiskCache, LeavesOtherFilesAndYoungDraftsAlone) {
    const Folder folder;
    fs::create_directories(folder / "c");
    std::ofstream(folder / "c/notes.txt") << std::string(5000, 'x');
    const std::vector<const char*> of_the_user{"c/notes.entry", "c/old.draft", "c/0123.entry"};
    for (const char* name : of_the_user) {
        std::ofstream(folder / name) << std::string(5000, 'x');
    }
    std::ofstream(folder / "c/young1.draft") << "x";
    std::ofstream(folder / "c/oldOne.draft") << "x";
    for (const fs::path& file : files_in(folder / "c")) {
        if (file.filename() != "young1.draft") {
            fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(2));
        }
    }
    DiskCache(folder / "c", 4000).put("a", "content");
    EXPECT_TRUE(fs::exists(folder / "c/notes.txt"));
    EXPECT_TRUE(fs::exists(folder / "c/young1.draft"));
    EXPECT_FALSE(fs::exists(folder / "c/oldOne.draft"));
    for (const char* name : of_the_user) {
        EXPECT_TRUE(fs::exists(folder / name)) << name;
    }
}

TEST(DiskCache, DoesNothingWhereNothingCanBeWritten) {
    const Folder folder;
    std::ofstream(folder / "file") << "x";
    const DiskCache cache(folder / "file/c", 1000);
    cache.put("a", "content");
    EXPECT_FALSE(found(cache, "a"));
}

TEST(DiskCache, ServesManyWriters) {
    const Folder folder;
    const std::string place = folder / "c";
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 4; ++writer) {
        writers.emplace_back([&place, writer] {
            const DiskCache cache(place, 60000); // so that they remove entries of each other
            for (int i = 0; i < 200; ++i) {
                const std::string key = "key " + std::to_string(i % 10);
                const std::string content(1000 + 900 * (i % 10), static_cast<char>('0' + i % 10));
                if (const auto now = found(cache, key)) {
                    EXPECT_EQ(*now, content) << writer;
                }
                cache.put(key, content);
            }
        });
    }
    for (std::thread& writer : writers) {
        writer.join();
    }
    for (const fs::path& file : files_in(place)) {
        EXPECT_EQ(file.extension(), ".entry");
    }
}

TEST(BinaryReader, GivesBackWhatWasWrittenAndNothingMore) {
    sim::BinaryWriter out;
    out.put(std::string("ab"));
    out.put(std::vector<double>{1, 2, 3});
    out.put(7);
    const std::string padded = " " + out.bytes; // numbers are at odd places
    for (const char* const at : {std::as_const(out.bytes).data(), padded.data() + 1}) {
        sim::BinaryReader in(at, out.bytes.size());
        std::string text;
        std::vector<double> values;
        int number = 0;
        in.get(text);
        in.get(values);
        EXPECT_FALSE(in.complete());
        in.get(number);
        EXPECT_TRUE(in.complete());
        EXPECT_EQ(text, "ab");
        EXPECT_EQ(values, (std::vector<double>{1, 2, 3}));
        EXPECT_EQ(number, 7);
    }
    for (std::size_t bytes = 0; bytes < out.bytes.size(); ++bytes) {
        sim::BinaryReader in(out.bytes.data(), bytes);
        std::string text;
        std::vector<double> values;
        int number = 0;
        in.get(text);
        in.get(values);
        in.get(number);
        EXPECT_FALSE(in.complete()) << bytes;
    }
}

} // namespace
} // namespace degs::sim_test
