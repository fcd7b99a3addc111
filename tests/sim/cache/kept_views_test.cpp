// SPDX-License-Identifier: Apache-2.0
// Views in the memory of a server: found while their files stay what they were.
#include "sim/cache/kept_views.hpp"

#include <fstream>

#include "scene/ply/ply.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/design/run_config.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using sim::KeptViews;
using sim::PathRequest;
using sim::ViewRequest;

constexpr std::uint64_t kMuch = std::uint64_t{1} << 30U;

const AcceleratorConfig& design_of(const std::string& override) {
    static std::vector<sim::RunConfig> designs;
    designs.reserve(10);
    designs.push_back(sim::load_run_config(config("degs-64"), {override}, ""));
    return designs.back().accelerator();
}

ViewRequest view_of(const std::string& scene, int camera = 0) {
    ViewRequest view;
    view.scene = scene;
    view.camera = camera;
    view.width = 48;
    return view;
}

void write_object(const std::string& file, int gaussians) {
    write_ply(
        make_synthetic(parse_synthetic("object,gaussians=" + std::to_string(gaussians))).cloud,
        file);
}

TEST(KeptViews, HaveTheirFramesOnce) {
    const AcceleratorConfig& design = design_of("tile_size=32");
    const AcceleratorConfig& other = design_of("tile_size=16");
    const ViewRequest request = view_of("synthetic:object,gaussians=300");
    KeptViews views(kMuch);
    EXPECT_EQ(views.find(request, {}), nullptr);
    views.keep(request, {}, design);
    const auto view = views.find(request, {});
    ASSERT_NE(view, nullptr);
    EXPECT_EQ(view->first_frame(design).front(), view->first_frame(design).front());
    EXPECT_NE(view->first_frame(other).front(), view->first_frame(other).front());
    view->pause();
    views.keep(request, {}, other);
    EXPECT_EQ(views.size(), 1U);
    EXPECT_EQ(views.find(request, {}), view);
    EXPECT_EQ(view->first_frame(other).front(), view->first_frame(other).front());
    EXPECT_EQ(view->first_frame(other).front()->tile_size, 16);
}

TEST(KeptViews, AreOfOneViewEach) {
    const AcceleratorConfig& design = design_of("tile_size=32");
    const ViewRequest request = view_of("synthetic:object,gaussians=300");
    KeptViews views(kMuch);
    views.keep(request, {}, design);
    std::vector<ViewRequest> others(6, request);
    others[0].camera = 1;
    others[1].width = 47;
    others[2].height = 20;
    others[3].crop = "0,0,8x8";
    others[4].scene += ",seed=2";
    others[5].width.reset();
    others[5].resolution = "720p";
    for (const ViewRequest& other : others) {
        EXPECT_EQ(views.find(other, {}), nullptr);
    }
    PathRequest path, eyes, fovea;
    path.frames = 2;
    eyes.group.eyes_m = 0.1;
    fovea.group.foveation = sim::foveation_of("0.5,0.5:5:10");
    for (const PathRequest& several : {path, eyes, fovea}) {
        views.keep(view_of("synthetic:single"), several, design);
        EXPECT_EQ(views.find(request, several), nullptr);
    }
    EXPECT_EQ(views.size(), 1U);
}

TEST(KeptViews, GoWithTheirFiles) {
    const Folder folder;
    const std::string file = folder / "s.ply", cameras = folder / "s.cameras.json";
    const AcceleratorConfig& design = design_of("tile_size=32");
    write_object(file, 30);
    const ViewRequest request = view_of(file);
    KeptViews views(kMuch);
    views.keep(request, {}, design);
    ASSERT_NE(views.find(request, {}), nullptr);
    views.find(request, {})->pause();
    write_object(file, 40);
    EXPECT_EQ(views.find(request, {}), nullptr);
    views.keep(request, {}, design);
    const auto view = views.find(request, {});
    ASSERT_NE(view, nullptr);
    EXPECT_EQ(view->facts().gaussians, 40U);
    write_object(file, 50); // while it is in use, with its Gaussians on the disk
    EXPECT_THROW(view->first_frame(design_of("tile_size=8")), InputError);
}

TEST(KeptViews, GoWhenThereAreTooMany) {
    const AcceleratorConfig& design = design_of("tile_size=32");
    const std::string scene = "synthetic:object,gaussians=300";
    KeptViews all(kMuch);
    for (const int camera : {0, 1, 2}) {
        all.keep(view_of(scene, camera), {}, design);
    }
    EXPECT_GT(all.bytes(), 3 * 300 * sizeof(ProjectedSplat) / 2);
    KeptViews views(all.bytes() - 1);
    for (const int camera : {0, 1, 0, 2}) {
        views.keep(view_of(scene, camera), {}, design);
    }
    EXPECT_EQ(views.size(), 2U);
    EXPECT_EQ(views.find(view_of(scene, 1), {}), nullptr);
    EXPECT_NE(views.find(view_of(scene, 0), {}), nullptr);
    EXPECT_NE(views.find(view_of(scene, 2), {}), nullptr);
}

TEST(KeptViews, AreNoneForMistakes) {
    KeptViews views(kMuch);
    EXPECT_THROW(views.keep(view_of("nothing.ply"), {}, design_of("tile_size=32")), InputError);
    EXPECT_EQ(views.size(), 0U);
}

} // namespace
} // namespace degs::sim_test
