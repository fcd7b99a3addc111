// SPDX-License-Identifier: Apache-2.0
// degs run with a cache: the same results as without, whatever has become of its entries.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "scene/ply/ply.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/cache/cached_view.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/simulation/all_frames.hpp"

namespace degs::sim_test {
namespace {

/// A cache in the environment of children, while it lives.
class UsersCache {
public:
    explicit UsersCache(const std::string& folder) { ::setenv("DEGS_CACHE", folder.c_str(), 1); }
    ~UsersCache() { ::setenv("DEGS_CACHE", "", 1); }
    UsersCache(const UsersCache&) = delete;
    UsersCache& operator=(const UsersCache&) = delete;
};

std::vector<fs::path> entries_of(const std::string& folder) {
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& file : fs::directory_iterator(folder, none)) {
        files.push_back(file.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Long enough to be kept.
const char* const kLarge = "synthetic:outdoor,gaussians=40000";

std::string run_to(const std::string& out, const std::string& scene,
                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"run", config("degs-16"), "--scene", scene, "--out",
                                       out,   "--width",         "300"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(degs(arguments));
    auto report = report_in(out);
    report.erase("host");
    return report.dump() + read_file(fs::path(out) / "image.exr");
}

TEST(CachedRun, GivesWhatAFreshRunGives) {
    const Folder folder;
    const std::string fresh = run_to(folder / "fresh", kLarge);
    const UsersCache cache(folder / "cache");
    EXPECT_EQ(run_to(folder / "first", kLarge), fresh);
    const auto entries = entries_of(folder / "cache");
    ASSERT_EQ(entries.size(), 3U); // the scene, the frame and the reference
    EXPECT_EQ(run_to(folder / "second", kLarge), fresh);
    EXPECT_EQ(entries_of(folder / "cache"), entries);
    // Another camera, another size of tiles, other rules, a path: none of them finds this frame.
    for (const std::vector<std::string>& other : {std::vector<std::string>{"--camera", "1"},
                                                  {"--set", "tile_size=16"},
                                                  {"--set", "pipeline.rules.order=distance"},
                                                  {"--set", "pipeline.rules.antialiasing=on"},
                                                  {"--set", "pipeline.rules.cut=9"},
                                                  {"--frames", "2"}}) {
        const std::string cached = run_to(folder / "a", kLarge, other);
        ::setenv("DEGS_CACHE", "", 1);
        EXPECT_EQ(run_to(folder / "b", kLarge, other), cached) << other[0];
        ::setenv("DEGS_CACHE", (folder / "cache").c_str(), 1);
        EXPECT_EQ(run_to(folder / "a", kLarge, other), cached) << other[0];
    }
}

// Every frame of a scene that changes is kept by itself, and found only as that frame.
TEST(CachedRun, KeepsTheFramesOfASceneThatChanges) {
    const Folder folder;
    const std::string scene = "synthetic:dynamic,gaussians=30000";
    const std::vector<std::string> frames{"--frames", "3"};
    const std::string fresh = run_to(folder / "fresh", scene, frames);
    const UsersCache cache(folder / "cache");
    EXPECT_EQ(run_to(folder / "first", scene, frames), fresh);
    const auto entries = entries_of(folder / "cache");
    ASSERT_EQ(entries.size(), 5U); // the scene, three frames and the reference
    EXPECT_EQ(run_to(folder / "second", scene, frames), fresh);
    EXPECT_EQ(entries_of(folder / "cache"), entries);
}

TEST(CachedRun, NoticesAChangedFileOfASequence) {
    const Folder folder;
    fs::create_directories(folder / "scene");
    const auto write = [&folder](const char* name, std::uint64_t seed) {
        write_ply(make_synthetic({"outdoor", 40000, seed}).cloud, folder / name);
    };
    write("scene/1.ply", 1);
    write("scene/2.ply", 2);
    const std::string scene = folder / "scene/*.ply";
    const UsersCache cache(folder / "cache");
    const std::vector<std::string> frames{"--frames", "2", "--no-reference"};
    const std::string before = run_to(folder / "a", scene, frames);
    EXPECT_EQ(run_to(folder / "a", scene, frames), before);
    EXPECT_EQ(entries_of(folder / "cache").size(), 3U); // the scene and two frames
    write("scene/2.ply", 3);
    const std::string after = run_to(folder / "a", scene, frames);
    EXPECT_NE(after, before);
    ::setenv("DEGS_CACHE", "", 1);
    EXPECT_EQ(run_to(folder / "b", scene, frames), after);
}

TEST(CachedRun, RepeatsWhatTheReaderOfTheSceneSaid) {
    const Folder folder;
    const std::string plain = folder / "plain.ply", file = folder / "said.ply";
    write_ply(make_synthetic({"outdoor", 40000, 1}).cloud, plain);
    std::string bytes = read_file(plain);
    bytes.insert(bytes.find("element"), "comment Vertical axis: z\n");
    std::ofstream(file, std::ios::binary) << bytes;
    const UsersCache cache(folder / "cache");
    for (const char* const out : {"first", "second"}) {
        const Outcome run = degs({"run", config("degs-16"), "--scene", file, "--out", folder / out,
                                  "--width", "300", "--no-reference"});
        ASSERT_EQ(run.code, 0) << run.err;
        const auto warnings = report_in(folder / out).at("warnings");
        ASSERT_GE(warnings.size(), 1U) << out;
        EXPECT_NE(warnings[0].get<std::string>().find("'Vertical axis: z'"), std::string::npos);
    }
    EXPECT_GE(entries_of(folder / "cache").size(), 2U); // the scene was kept
}

TEST(CachedRun, SurvivesDamage) {
    const Folder folder;
    const UsersCache cache(folder / "cache");
    const std::string first = run_to(folder / "o", kLarge);
    for (const fs::path& entry : entries_of(folder / "cache")) {
        fs::resize_file(entry, fs::file_size(entry) / 2);
    }
    EXPECT_EQ(run_to(folder / "o", kLarge), first);
    EXPECT_EQ(entries_of(folder / "cache").size(), 3U);
}

TEST(CachedRun, NoticesAChangedScene) {
    const Folder folder;
    const UsersCache cache(folder / "cache");
    const std::string scene = folder / "scene.ply";
    const auto write = [&scene](const char* seed) {
        expect_success(degs({"scene", "generate", "outdoor", "--gaussians", "40000", "--seed", seed,
                             "--out", scene}));
    };
    write("1");
    const std::string first = run_to(folder / "o", scene);
    write("2");
    EXPECT_NE(run_to(folder / "o", scene), first);
}

TEST(CachedRun, CanDoWithout) {
    const Folder folder;
    {
        const UsersCache cache(folder / "cache");
        run_to(folder / "o", kLarge, {"--no-cache"});
        EXPECT_FALSE(fs::exists(folder / "cache"));
        ::setenv("DEGS_CACHE_BYTES", "many", 1);
        expect_mistake(
            degs({"run", config("degs-16"), "--scene", "synthetic:single", "--out", folder / "o"}),
            "DEGS_CACHE_BYTES is 'many'");
        ::setenv("DEGS_CACHE_BYTES", "0", 1);
        run_to(folder / "o", kLarge);
        ::unsetenv("DEGS_CACHE_BYTES");
        EXPECT_FALSE(fs::exists(folder / "cache"));
    }
    const UsersCache nowhere("/proc/no/such/folder");
    run_to(folder / "o", kLarge);
}

TEST(FrameCache, FindsFramesByEverythingTheyDependOn) {
    const Folder folder;
    const sim::FrameCache cache(sim::DiskCache(folder / "c", 100000000));
    const Scene scene = load_scene("synthetic:object,gaussians=500");
    Camera camera = scene.cameras[0].scaled_to_width(160);
    const ProjectionOptions options;
    const FrameWorkload frame =
        make_frame_workload(scene.cloud, camera, 16, TileMode::Exact, options);
    cache.keep("scene", frame);
    const auto found = [&](const std::string& key, int tile, TileMode mode,
                           const ProjectionOptions& with) {
        return cache.frame(key, camera, tile, mode, with);
    };
    const auto same = found("scene", 16, TileMode::Exact, options);
    ASSERT_TRUE(same);
    EXPECT_EQ(same->tile_splats, frame.tile_splats);
    EXPECT_EQ(same->tile_begin, frame.tile_begin);
    EXPECT_EQ(same->visible_of, frame.visible_of);
    EXPECT_EQ(same->visible_means, frame.visible_means);
    EXPECT_EQ(same->tiles_touched, frame.tiles_touched);
    EXPECT_EQ(same->culled.total(), frame.culled.total());
    EXPECT_EQ(same->gaussians, frame.gaussians);
    EXPECT_EQ(same->sh_degree, frame.sh_degree);
    ReferenceCounts counts, counts_of_same;
    EXPECT_EQ(render_reference(*same, counts_of_same).rgb, render_reference(frame, counts).rgb);
    EXPECT_FALSE(found("scenf", 16, TileMode::Exact, options));
    EXPECT_FALSE(found("scene", 8, TileMode::Exact, options));
    EXPECT_FALSE(found("scene", 16, TileMode::Square, options));
    const std::vector<std::function<void(ProjectionOptions&)>> changes{
        [](auto& other) { other.near_plane *= 2; },
        [](auto& other) { other.dilation = 0.31; },
        [](auto& other) { other.jacobian_clamp *= 2; },
        [](auto& other) { other.alpha_min *= 2; },
        [](auto& other) { other.cut = 20; }, // beyond the support of all splats
        [](auto& other) { other.order = SplatOrder::Distance; },
        [](auto& other) { other.compensated = true; },
        [](auto& other) { other.rule = ProjectionRule::Unscented; },
        [](auto& other) { other.lens = LensRule::Pinhole; },
        [](auto& other) { other.sigma.kappa += 1; },
        [](auto& other) { other.numbers.format = parse_format("fp16"); },
        [](auto& other) { other.numbers.sh_rest = parse_format("q1.7"); },
        [](auto& other) { other.numbers.depth_key = parse_format("fp16"); }};
    for (std::size_t c = 0; c < changes.size(); ++c) {
        ProjectionOptions other = options;
        changes[c](other);
        EXPECT_FALSE(found("scene", 16, TileMode::Exact, other)) << c;
    }
    // A card of a scene says how the scene wants to be drawn.
    sim::SceneCard card;
    card.facts.gaussians = scene.cloud.size();
    card.cameras = scene.cameras;
    card.facts.traits.antialiased = true;
    cache.keep("scene", card);
    ASSERT_TRUE(cache.scene("scene"));
    EXPECT_TRUE(cache.scene("scene")->facts.traits.antialiased);
    camera.position.x += 1e-12;
    EXPECT_FALSE(found("scene", 16, TileMode::Exact, options));
}

// Tiles of another size hide other pixels of an image with a hole, and of no other.
TEST(FrameCache, FindsReferencesOfOtherTilesIfNoneIsHidden) {
    const Folder folder;
    const sim::FrameCache cache(sim::DiskCache(folder / "c", 1000000));
    FrameWorkload frame;
    frame.camera.width = frame.camera.height = 32;
    frame.tile_mode = TileMode::Exact;
    sim::Reference reference;
    reference.image = Image(32, 32);
    for (const bool hole : {false, true}) {
        frame.camera.hole = hole ? PixelBox{0, 0, 15, 15} : PixelBox();
        frame.tile_size = 16;
        cache.keep("scene", frame, reference);
        EXPECT_TRUE(cache.reference("scene", frame));
        frame.tile_size = 8;
        EXPECT_EQ(cache.reference("scene", frame).has_value(), !hole);
    }
}

// Two views at one place of a scene that changes have the frames of one view, and no others.
TEST(FrameCache, KeepsTheViewsOfAChangingSceneByFrame) {
    const Folder folder;
    const sim::FrameCache cache(sim::DiskCache(folder / "c", 100000000));
    const sim::RunConfig design = sim::load_run_config(config("degs-16"), {}, "");
    sim::ViewRequest request;
    request.scene = "synthetic:dynamic,gaussians=20000";
    request.width = 160;
    sim::PathRequest one, two;
    one.frames = two.frames = 2;
    two.group.cameras = {0, 0};
    const auto frames_of = [&](const sim::PathRequest& path, const sim::FrameCache& of) {
        sim::CachedView view(request, path, of);
        const auto frames = all_frames(view, design.accelerator());
        std::vector<FramePointer> first;
        std::transform(frames.begin(), frames.begin() + view.views(), std::back_inserter(first),
                       borrowed);
        view.keep(first, {});
        return frames;
    };
    frames_of(two, cache);
    const auto kept = frames_of(one, cache);
    const auto fresh = frames_of(one, {});
    ASSERT_EQ(kept.size(), 2U);
    ASSERT_NE(fresh[0].tile_splats, fresh[1].tile_splats);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(kept[k].tile_splats, fresh[k].tile_splats) << k;
    }
}

} // namespace
} // namespace degs::sim_test
