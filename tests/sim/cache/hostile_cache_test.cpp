// SPDX-License-Identifier: Apache-2.0
// Entries that somebody has made: with a right checksum, but of another content, kind or owner.
#define XXH_INLINE_ALL
#include <cstring>
#include <random>

#include <sys/stat.h>
#include <xxhash.h>

#include "sim/cache/entry_checks.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// The only entry of a folder.
std::string only_entry(const std::string& folder) {
    return fs::directory_iterator(folder)->path().string();
}

struct CraftedEntry {
    std::string bytes;
    std::size_t content = 0; ///< where it begins

    explicit CraftedEntry(const std::string& file) : bytes(read_file(file)) {
        std::array<std::uint64_t, 4> head{};
        std::memcpy(head.data(), bytes.data(), sizeof head);
        content = bytes.size() - head[2];
    }
    void put(std::size_t at, std::uint32_t word) {
        std::memcpy(&bytes[content + at], &word,
                    std::min(sizeof word, bytes.size() - content - at));
    }
    void write(const std::string& file) {
        constexpr std::size_t kHead = 32;
        const std::uint64_t checksum = XXH3_64bits(bytes.data() + kHead, bytes.size() - kHead);
        std::memcpy(&bytes[kHead - sizeof checksum], &checksum, sizeof checksum);
        std::ofstream(file, std::ios::binary) << bytes;
        fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    }
};

struct KeptFrame {
    Folder folder;
    sim::FrameCache cache{sim::DiskCache(folder / "c", 100000000)};
    FrameWorkload frame;
    KeptFrame() {
        const Scene scene = load_scene("synthetic:object,gaussians=300");
        frame = make_frame_workload(scene.cloud, scene.cameras[0].scaled_to_width(96), 16,
                                    TileMode::Exact);
    }
    std::optional<FrameWorkload> found() const {
        return cache.frame("scene", frame.camera, 16, TileMode::Exact, frame.projection);
    }
};

TEST(HostileCache, GoodEntriesAreSound) {
    const KeptFrame kept;
    EXPECT_TRUE(sim::is_sound(kept.frame));
    EXPECT_TRUE(sim::is_sound(sim::make_reference(kept.frame), kept.frame));
}

TEST(HostileCache, AlteredFramesAreRefusedOrSound) {
    const KeptFrame kept;
    kept.cache.keep("scene", kept.frame);
    const std::string file = only_entry(kept.folder / "c");
    const CraftedEntry good(file);
    const std::size_t size = good.bytes.size() - good.content;
    std::mt19937 random(1);
    int refused = 0;
    for (int round = 0; round < 300; ++round) {
        CraftedEntry bad = good;
        const std::size_t most = round % 3 == 0 ? 128 : size; // counts stand at the beginning
        bad.put(random() % most, round % 2 == 0 ? 0x7fffffffU : 0xffffffffU);
        bad.write(file);
        const auto found = kept.found();
        refused += found ? 0 : 1;
        if (found) {
            ReferenceCounts counts;
            EXPECT_TRUE(sim::is_sound(*found));
            render_reference(*found, counts);
        }
    }
    EXPECT_GT(refused, 200);
}

TEST(HostileCache, ListsThatLeaveTheirBoundsAreUnsound) {
    const KeptFrame kept;
    const auto with = [&kept](const std::function<void(FrameWorkload&)>& change) {
        FrameWorkload frame = kept.frame;
        change(frame);
        return sim::is_sound(frame);
    };
    EXPECT_TRUE(with([](FrameWorkload&) {}));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.tile_splats[0] = 1000000; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.tile_begin[1] = f.tile_splats.size() + 1; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.tile_begin.pop_back(); }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.tiles_x = -f.tiles_x; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.visible_of.back() += 1000; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.visible_means.clear(); }));
    EXPECT_FALSE(with([](FrameWorkload& f) { ++f.tiles_touched[0]; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.splats[0].mu_x = std::nan(""); }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.splats[0].det = 0; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.splats[0].depth = 1e30; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.culled.near = ~std::uint64_t{0}; }));
    EXPECT_FALSE(with([](FrameWorkload& f) { f.sh_degree = 9; }));
}

TEST(HostileCache, ImagesAndCardsThatDoNotFitAreUnsound) {
    const KeptFrame kept;
    const sim::Reference good = sim::make_reference(kept.frame);
    const auto with = [&](const std::function<void(sim::Reference&)>& change) {
        sim::Reference reference = good;
        change(reference);
        return sim::is_sound(reference, kept.frame);
    };
    EXPECT_FALSE(with([](sim::Reference& r) { r.image.width = 1 << 30; }));
    EXPECT_FALSE(with([](sim::Reference& r) { r.image.rgb.pop_back(); }));
    EXPECT_FALSE(with([](sim::Reference& r) { r.image.rgb[0] = std::nanf(""); }));
    EXPECT_FALSE(with([](sim::Reference& r) { r.image.transmittance[0] = 2; }));
    EXPECT_FALSE(with([](sim::Reference& r) { ++r.image.fragments[0]; }));
    EXPECT_FALSE(with([](sim::Reference& r) { r.render_s = -1; }));
    sim::SceneCard card;
    EXPECT_FALSE(sim::is_sound(card));
    card.facts.gaussians = 1;
    card.cameras = {kept.frame.camera};
    EXPECT_TRUE(sim::is_sound(card));
    card.cameras[0].fx = std::nan("");
    EXPECT_FALSE(sim::is_sound(card));
    card.cameras[0] = kept.frame.camera;
    card.cameras[0].camera_to_world[0] *= 2.0;
    EXPECT_FALSE(sim::is_sound(card));
}

TEST(HostileCache, OnlyRegularFilesOfTheUserAreRead) {
    const KeptFrame kept;
    kept.cache.keep("scene", kept.frame);
    const std::string file = only_entry(kept.folder / "c");
    ASSERT_TRUE(kept.found());
    fs::rename(file, kept.folder / "elsewhere");
    fs::create_symlink(kept.folder / "elsewhere", file);
    EXPECT_FALSE(kept.found());
    fs::remove(file);
    ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    EXPECT_FALSE(kept.found()); // at once
    fs::remove(file);
    fs::rename(kept.folder / "elsewhere", file);
    EXPECT_TRUE(kept.found());
    ::chmod(file.c_str(), 0666);
    EXPECT_FALSE(kept.found());
    ::chmod(file.c_str(), 0600);
    if (::geteuid() == 0) {
        ASSERT_EQ(::chown(file.c_str(), 12345, 12345), 0);
        EXPECT_FALSE(kept.found());
    }
}

TEST(HostileCache, AFolderThatOthersMayWriteIsPassedOverInOneLine) {
    const Folder folder;
    const std::string cache = folder / "c";
    fs::create_directories(cache);
    ::chmod(cache.c_str(), 01777);
    ::setenv("DEGS_CACHE", cache.c_str(), 1);
    const Outcome run = degs({"run", config("degs-16"), "--scene", "synthetic:single", "--width",
                              "48", "--out", folder / "o"});
    ::setenv("DEGS_CACHE", "", 1);
    EXPECT_EQ(run.code, 0) << run.err;
    const std::size_t said = run.err.find("is not used: others may write to it");
    EXPECT_NE(said, std::string::npos) << run.err;
    EXPECT_EQ(run.err.find("is not used", said + 1), std::string::npos);
    EXPECT_TRUE(fs::is_empty(cache));
}

} // namespace
} // namespace degs::sim_test
