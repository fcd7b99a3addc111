// SPDX-License-Identifier: Apache-2.0
// Frames of several views: what views share is read once, and their images are those of the views
// by themselves, in every accelerator.
#include <algorithm>
#include <memory>
#include <string>
#include <tuple>

#include "degs/design.hpp"
#include "splat/frame/shared_colours.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::EngineRun;

constexpr int kGaussians = 900;     // several chunks for every unit, the last one not full
constexpr double kViewsApart = 0.7; // scene units; some Gaussians are in one view alone

Camera head() {
    Camera camera;
    camera.width = 150;
    camera.height = 90;
    camera.fx = 140;
    camera.fy = 135;
    return camera;
}

/// `count` cameras side by side.
std::vector<Camera> row_of(int count, double apart) {
    std::vector<Camera> cameras(static_cast<std::size_t>(count), head());
    for (int v = 0; v < count; ++v) {
        cameras[v].position.x += apart * v;
    }
    return cameras;
}

Design design_of(const std::string& file, const std::vector<std::string>& keys) {
    return load_design(std::string(DEGS_CONFIGS) + "/" + file + ".yaml", keys);
}

std::string sharing_key(const std::string& file) {
    return file.rfind("gcc", 0) == 0 ? "grouping.shared_by_views" : "projection.shared_by_views";
}

std::vector<FrameWorkload> frames_of(const std::vector<Camera>& cameras,
                                     const AcceleratorConfig& design) {
    const GaussianCloud cloud = test::random_cloud(kGaussians, 11, 2);
    std::vector<FrameWorkload> frames;
    for (const Camera& camera : cameras) {
        frames.push_back(make_frame_workload(cloud, camera, design.tile_size_px(),
                                             design.tile_mode(),
                                             projection_of(design.data_path(), false)));
    }
    return frames;
}

std::vector<const FrameWorkload*> pointers(const std::vector<FrameWorkload>& frames) {
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    return list;
}

std::uint64_t bytes_of(const AcceleratorResult& result, const std::string& name) {
    for (const StreamUse& stream : result.streams) {
        if (stream.name == name) {
            return stream.bytes_read + stream.bytes_written;
        }
    }
    return 0;
}

std::uint64_t geometry_of(const AcceleratorResult& result) {
    return bytes_of(result, "geometry") + bytes_of(result, "means");
}

void expect_same_image(const Image& one, const Image& other) {
    EXPECT_TRUE(one.rgb == other.rgb);
    EXPECT_TRUE(one.transmittance == other.transmittance);
    EXPECT_TRUE(one.fragments == other.fragments);
}

/// A run of all views together, and one of each by itself.
struct Views {
    Design design;
    std::vector<FrameWorkload> frames;
    std::unique_ptr<EngineRun> together, strict;
    std::vector<std::unique_ptr<EngineRun>> alone;

    Views(const std::string& file, const std::vector<std::string>& keys,
          const std::vector<Camera>& cameras)
        : design(design_of(file, keys)), frames(frames_of(cameras, design.accelerator())) {
        const int views = static_cast<int>(cameras.size());
        together = std::make_unique<EngineRun>("together", design.accelerator(), pointers(frames),
                                               Fidelity::Exact, BuildOptions(), views);
        strict = std::make_unique<EngineRun>("strict", design.accelerator(), pointers(frames),
                                             Fidelity::Strict, BuildOptions(), views);
        for (std::size_t v = 0; v < frames.size(); ++v) {
            alone.push_back(
                std::make_unique<EngineRun>("alone_" + std::to_string(v), design.accelerator(),
                                            std::vector<const FrameWorkload*>{&frames[v]}));
        }
        sc_core::sc_start();
    }
    /// A number of the runs of single views, summed.
    template <class Number>
    std::uint64_t sum(const Number& number) const {
        std::uint64_t total = 0;
        for (const auto& run : alone) {
            total += number(run->result());
        }
        return total;
    }
    void expect_laws() const {
        together->expect_sound();
        EXPECT_EQ(together->words(), strict->words());
        const AcceleratorResult all = together->result();
        for (std::size_t v = 0; v < alone.size(); ++v) {
            SCOPED_TRACE("view " + std::to_string(v));
            expect_same_image(together->image(v), alone[v]->image());
        }
        EXPECT_EQ(all.tiles, sum([](const AcceleratorResult& r) { return r.tiles; }));
        EXPECT_EQ(all.fragments(), sum([](const AcceleratorResult& r) { return r.fragments(); }));
        for (const char* stream :
             {"splats_written", "tile_lists_written", "group_lists_written", "frame_buffer"}) {
            EXPECT_EQ(bytes_of(all, stream),
                      sum([stream](const AcceleratorResult& r) { return bytes_of(r, stream); }))
                << stream;
        }
    }
};

using ViewsRow = std::tuple<const char*, const char*, int>; // design, sharing, views

class SmallRunViews : public ::testing::TestWithParam<ViewsRow> {
protected:
    std::string file = std::get<0>(GetParam()), shared = std::get<1>(GetParam());
    int count = std::get<2>(GetParam());
    std::vector<std::string> keys{sharing_key(file) + "=" + shared};
};

// Nothing is culled in one view and not in another, so that all that is shared is there once.
TEST_P(SmallRunViews, AtOnePlaceReadWhatTheyShareOnce) {
    const Views views(file, keys, row_of(count, 0));
    views.expect_laws();
    const AcceleratorResult all = views.together->result(), one = views.alone[0]->result();
    const std::uint64_t times = count;
    EXPECT_EQ(geometry_of(all), (shared == "nothing" ? times : 1) * geometry_of(one));
    if (geometry_of(one) == bytes_of(one, "geometry")) { // GCC reads SH view by view, as it needs
        EXPECT_EQ(bytes_of(all, "sh"), (shared == "sh" ? 1 : times) * bytes_of(one, "sh"));
    }
}

TEST_P(SmallRunViews, ApartHaveTheirOwnImagesAndShareTheScene) {
    const Views views(file, keys, row_of(count, kViewsApart));
    views.expect_laws();
    const AcceleratorResult all = views.together->result(), one = views.alone[0]->result();
    const std::uint64_t times = count;
    EXPECT_EQ(geometry_of(all), (shared == "nothing" ? times : 1) * geometry_of(one));
    const auto sh = [](const AcceleratorResult& r) { return bytes_of(r, "sh"); };
    std::uint64_t most = 0;
    for (const auto& run : views.alone) {
        most = std::max(most, sh(run->result()));
    }
    if (shared == "sh") {
        EXPECT_GE(sh(all), most);
        EXPECT_LT(sh(all), views.sum(sh));
    } else if (bytes_of(one, "geometry") != 0) {
        EXPECT_EQ(sh(all), views.sum(sh));
    }
}

std::string views_row_name(const ::testing::TestParamInfo<ViewsRow>& row) {
    std::string name = std::string(std::get<0>(row.param)) + "_" + std::get<1>(row.param) + "_" +
                       std::to_string(std::get<2>(row.param));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(
    Tiled, SmallRunViews,
    ::testing::Combine(::testing::Values("degs-64", "gscore-64", "gbu-64", "orange-o1"),
                       ::testing::Values("nothing", "geometry", "sh"), ::testing::Values(2)),
    views_row_name);
INSTANTIATE_TEST_SUITE_P(OfThree, SmallRunViews,
                         ::testing::Combine(::testing::Values("degs-64", "gscore-64", "gbu-64",
                                                              "orange-o1"),
                                            ::testing::Values("sh"), ::testing::Values(3)),
                         views_row_name);
INSTANTIATE_TEST_SUITE_P(Gcc, SmallRunViews,
                         ::testing::Combine(::testing::Values("gcc-64"),
                                            ::testing::Values("nothing", "geometry"),
                                            ::testing::Values(2, 3)),
                         views_row_name);

class SmallRunViewsUnshared : public ::testing::TestWithParam<const char*> {};

// Without sharing a frame of two views is two frames, to the cycle.
TEST_P(SmallRunViewsUnshared, AreFrames) {
    const Design design = design_of(GetParam(), {sharing_key(GetParam()) + "=nothing"});
    const std::vector<FrameWorkload> frames =
        frames_of(row_of(4, kViewsApart), design.accelerator());
    const EngineRun views("views", design.accelerator(), pointers(frames), Fidelity::Exact,
                          BuildOptions(), 2);
    const EngineRun path("frames", design.accelerator(), pointers(frames));
    sc_core::sc_start();
    EXPECT_EQ(views.words(), path.words());
}
INSTANTIATE_TEST_SUITE_P(All, SmallRunViewsUnshared,
                         ::testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64",
                                           "orange-o1"));

// Two frames of two views: the second waits for both views of the first.
TEST(SmallRunViewsTogether, WaitForTheFrameBefore) {
    const Design design = design_of("degs-64", {"frames_in_flight=1"});
    const std::vector<FrameWorkload> frames =
        frames_of(row_of(4, kViewsApart), design.accelerator());
    const EngineRun exact("exact", design.accelerator(), pointers(frames), Fidelity::Exact,
                          BuildOptions(), 2);
    const EngineRun strict("strict", design.accelerator(), pointers(frames), Fidelity::Strict,
                           BuildOptions(), 2);
    sc_core::sc_start();
    exact.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    AcceleratorResult result = exact.result();
    group_views(result, 2);
    ASSERT_EQ(result.frames.size(), 2U);
    ASSERT_EQ(result.views.size(), 4U);
    EXPECT_EQ(result.frames[0].finished, result.views[1].finished);
    EXPECT_LT(result.views[1].preprocessed, result.views[0].finished);
    EXPECT_GT(result.views[2].preprocessed, result.frames[0].finished);
}

class SmallRunViewsKept : public ::testing::TestWithParam<const char*> {};

// Each view keeps lists of its own from frame to frame, also where they are not a stream.
TEST_P(SmallRunViewsKept, HaveListsOfTheirOwn) {
    const std::string key = std::string("binning.entries=") + GetParam();
    const Design design = design_of("gscore-64", {"binning.keep_lists=true", key});
    std::vector<Camera> cameras = row_of(2, kViewsApart);
    cameras.push_back(cameras[0]); // nobody moves
    cameras.push_back(cameras[1]);
    const std::vector<FrameWorkload> frames = frames_of(cameras, design.accelerator());
    const std::vector<const FrameWorkload*> all = pointers(frames);
    const EngineRun once("once", design.accelerator(), {all[0], all[1]}, Fidelity::Exact,
                         BuildOptions(), 2);
    const EngineRun exact("exact", design.accelerator(), all, Fidelity::Exact, BuildOptions(), 2);
    const EngineRun strict("strict", design.accelerator(), all, Fidelity::Strict, BuildOptions(),
                           2);
    sc_core::sc_start();
    exact.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    EXPECT_EQ(bytes_of(exact.result(), "tile_lists_written"),
              bytes_of(once.result(), "tile_lists_written"));
}
INSTANTIATE_TEST_SUITE_P(All, SmallRunViewsKept,
                         ::testing::Values("stream", "combined", "entries"));

// Colours that views share are evaluated once for each Gaussian that any of them shows.
TEST(SmallRunViewsTogether, MayShareColours) {
    const std::vector<Camera> cameras = row_of(2, kViewsApart);
    std::vector<std::unique_ptr<EngineRun>> runs;
    std::vector<std::vector<FrameWorkload>> frames;
    std::vector<Design> designs;
    for (const char* shared : {"sh", "colour"}) {
        designs.push_back(design_of("degs-64", {std::string("projection.shared_by_views=") + shared,
                                                "projection.cycles_per_colour=50"}));
        frames.push_back(frames_of(cameras, designs.back().accelerator()));
    }
    const GaussianCloud cloud = test::random_cloud(kGaussians, 11, 2);
    for (FrameWorkload& frame : frames[1]) {
        const std::vector<FrameWorkload> before{frame};
        shade_from(cloud, frame.camera.position, frame);
        for (std::size_t s = 0; s < frame.splats.size(); ++s) { // its own place changes nothing
            ASSERT_EQ(frame.splats[s].colour[0], before[0].splats[s].colour[0]);
        }
        shade_from(cloud, 0.5 * (cameras[0].position + cameras[1].position), frame);
    }
    for (std::size_t i = 0; i < 2; ++i) {
        runs.push_back(std::make_unique<EngineRun>("run_" + std::to_string(i),
                                                   designs[i].accelerator(), pointers(frames[i]),
                                                   Fidelity::Exact, BuildOptions(), 2));
    }
    sc_core::sc_start();
    const AcceleratorResult each = runs[0]->result(), once = runs[1]->result();
    EXPECT_EQ(bytes_of(each, "sh"), bytes_of(once, "sh"));
    EXPECT_LT(once.cycles, each.cycles);
    EXPECT_FALSE(runs[0]->image().rgb == runs[1]->image().rgb);
    std::vector<std::uint32_t> any;
    std::set_union(frames[0][0].visible_of.begin(), frames[0][0].visible_of.end(),
                   frames[0][1].visible_of.begin(), frames[0][1].visible_of.end(),
                   std::back_inserter(any));
    for (const StageUse& stage : once.stages) {
        if (stage.name == "projection") {
            EXPECT_EQ(stage.busy_cycles, 50.0 * static_cast<double>(any.size()));
        }
    }
}

} // namespace
} // namespace degs
