// SPDX-License-Identifier: Apache-2.0
// Inputs that change between two readings: refused, and nothing is kept of them.
#include <fstream>

#include "config/input_files.hpp"
#include "scene/dynamic_scene.hpp"
#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/cache/cached_view.hpp"
#include "sim/cache/digest.hpp"
#include "sim/memory/trace_reader.hpp"
#include "sim/sweep/point_store.hpp"
#include "sim/sweep/sweep_session.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using sim::CachedView;
using sim::Digest;

void write_scene(const std::string& file, int gaussians) {
    write_ply(
        make_synthetic(parse_synthetic("object,gaussians=" + std::to_string(gaussians))).cloud,
        file);
}

/// As an exporter does it: a complete file takes the name of another.
void replace(const std::string& file, int gaussians) {
    write_scene(file + ".new", gaussians);
    fs::rename(file + ".new", file);
}

void expect_refused(const std::function<void()>& read, const std::string& file) {
    try {
        read();
        ADD_FAILURE() << "nobody noticed that " << file << " changed";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).rfind(file + ": the file changed while", 0), 0U)
            << error.what();
    }
}

const char* const kPose = "[{\"id\":0,\"img_name\":\"a\",\"width\":32,\"height\":32,\"position\":"
                          "[0,0,-4],\"rotation\":[[1,0,0],[0,1,0],[0,0,1]],\"fx\":30,\"fy\":";

TEST(ChangedInput, ASceneThatIsReplacedBehindItsDigest) {
    const Folder folder;
    const std::string file = folder / "s.ply";
    write_scene(file, 30);
    const InputWatch watch;
    Digest digest;
    digest.add_scene(file);
    EXPECT_EQ(load_scene(file).cloud.size(), 30U);
    replace(file, 40);
    expect_refused([&] { load_scene(file); }, file);
    replace(file, 30); // the watch has seen another file, whatever the name stands for now
    expect_refused([&] { load_scene(file); }, file);
}

TEST(ChangedInput, ASceneThatIsOverwrittenInPlace) {
    const Folder folder;
    const std::string file = folder / "s.ply";
    write_scene(file, 30);
    const InputWatch watch;
    EXPECT_EQ(load_scene(file).cloud.size(), 30U);
    const auto date = fs::last_write_time(file);
    const std::string bytes = read_file(file);
    std::ofstream(file, std::ios::binary) << bytes; // of the same size
    fs::last_write_time(file, date + std::chrono::nanoseconds(1));
    expect_refused([&] { load_scene(file); }, file);
}

TEST(ChangedInput, OfEarlierWatchesIsNobodysConcern) {
    const Folder folder;
    const std::string file = folder / "s.ply";
    write_scene(file, 30);
    EXPECT_EQ(load_scene(file).cloud.size(), 30U);
    replace(file, 40);
    EXPECT_EQ(load_scene(file).cloud.size(), 40U);
    const InputWatch watch;
    EXPECT_EQ(load_scene(file).cloud.size(), 40U);
    fs::remove(file); // what was read is complete
    watch.require_unchanged();
}

TEST(ChangedInput, CamerasAndPartsOfASequence) {
    const Folder folder;
    const std::string cameras = folder / "c.json";
    std::ofstream(cameras) << kPose << "30}]";
    fs::create_directory(folder / "frames");
    const std::string part = folder / "frames/2.ply";
    write_scene(folder / "frames/1.ply", 30);
    write_scene(part, 30);
    const InputWatch watch;
    Digest digest;
    digest.add_scene(folder / "frames");
    digest.add_cameras(cameras);
    const auto sequence = open_dynamic_scene(folder / "frames");
    EXPECT_EQ(sequence->frame(0).size(), 30U);
    replace(part, 40);
    expect_refused([&] { sequence->frame(1); }, part);
    std::ofstream(cameras) << kPose << "300}]";
    expect_refused([&] { load_scene(folder / "frames/1.ply", cameras); }, cameras);
}

TEST(ChangedInput, IsNotInTheCache) {
    const Folder folder;
    const std::string file = folder / "s.ply";
    write_scene(file, 4000);
    sim::ViewRequest request;
    request.scene = file;
    request.width = 200;
    const sim::FrameCache cache(sim::DiskCache(folder / "cache", 1U << 30U));
    const std::string first = cache.scene_key(file, "");
    CachedView view(request, sim::PathRequest(), cache);
    fs::remove_all(folder / "cache"); // what was loaded of the first file is right
    view.forget_cloud();
    replace(file, 4100);
    const auto design = sim::load_run_config(config("degs-16"), {}, "");
    expect_refused([&] { view.first_frame(design.accelerator()); }, file);
    EXPECT_FALSE(cache.scene(first));
    EXPECT_FALSE(fs::exists(folder / "cache"));
}

TEST(ChangedInput, IsNoPointOfASweep) {
    const Folder folder;
    const std::string file = folder / "s.ply";
    write_scene(file, 30);
    std::ofstream(folder / "study.yaml")
        << "designs:\n  - include: " << config("degs-16") << "\n    name: d\nscenes: " << file
        << "\nwidth: 32\nreference: false\n";
    const sim::StudyPlan plan = sim::plan_study(sim::read_study(folder / "study.yaml"));
    replace(file, 40);
    const sim::PointStore store(folder / "out", plan);
    sim::SweepSession session(plan, store, {0}, {});
    session.run();
    ASSERT_TRUE(session.failure());
    EXPECT_NE(session.failure()->sentence.find("the file changed while"), std::string::npos);
    EXPECT_FALSE(store.read(0));
}

TEST(ChangedInput, AWorkloadAndATrace) {
    const Folder folder;
    const std::string file = folder / "w.degsw";
    const std::string scene = folder / "s.ply";
    write_scene(scene, 30);
    const auto pack = [&] {
        expect_success(degs({"workload", "pack", config("degs-16"), "--scene", scene, "--width",
                             "32", "--out", file}));
    };
    pack();
    sim::ViewRequest request;
    request.workload = file;
    CachedView view(request, sim::PathRequest(), {});
    const auto design = sim::load_run_config(config("degs-16"), {}, "");
    EXPECT_EQ(view.first_frame(design.accelerator()).size(), 1U);
    pack();
    expect_refused([&] { view.first_frame(design.accelerator()); }, file);

    const std::string trace = folder / "t";
    std::ofstream(trace) << "LD 0x0\nLD 0x40\n";
    sim::TraceReader reader(trace, 1U << 20U);
    EXPECT_EQ(sim::total_of(reader).reads, 2U);
    std::ofstream(trace) << "LD 0x0\nLD 0x40\nLD 0x80\n";
    sim::TraceAccess access;
    expect_refused([&] { reader.next(access); }, trace);
}

} // namespace
} // namespace degs::sim_test
