// SPDX-License-Identifier: Apache-2.0
// A run whose frames are made one after the other and let go when they have ended is the run of
// which all frames are there from the start, in every accelerator.
#include <array>
#include <random>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "base/shared_bytes.hpp"
#include "degs/design.hpp"
#include "modules/kit/accelerator/accelerator_energy.hpp"
#include "splat/frame/shared_colours.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::EngineRun;
using test::Joining;

/// What is drawn at random.
struct Trial {
    std::string file;
    std::vector<std::string> keys;
    int frames = 0, views = 1;
    int width = 70;          ///< px
    bool kept_tiles = false; ///< drawings are shared, see BuildOptions::kept
    BuildOptions options;
    Fidelity fidelity = Fidelity::Exact;
    std::string words;
};

/// Every accelerator in turn, so that ten draws have each of them twice.
Trial draw(unsigned seed) {
    std::mt19937 random(seed);
    const auto chance = [&random](unsigned one_in) { return random() % one_in == 0; };
    constexpr std::array<const char*, 10> kFiles{
        "degs-64",   "gscore-64", "gbu-64", "gcc-64", "orange-o1",
        "degs-x-64", "gscore-16", "gbu-16", "gcc-16", "degs-1024-streams"};
    Trial trial;
    trial.file = kFiles[seed % kFiles.size()];
    const bool gcc = trial.file.rfind("gcc", 0) == 0;
    trial.frames = 4 + static_cast<int>(random() % 5);
    trial.keys.push_back("frames_in_flight=" + std::to_string(1 + random() % 3));
    if (chance(3)) {
        trial.keys.emplace_back("tile_order=longest_list");
    }
    if (!gcc && chance(2)) {
        trial.keys.emplace_back("binning.keep_lists=true");
    }
    if (chance(3)) {
        trial.views = 2 + static_cast<int>(random() % 2);
        trial.keys.emplace_back(gcc ? "grouping.shared_by_views=geometry"
                                    : "projection.shared_by_views=sh");
    }
    trial.options.array_only = chance(4);
    trial.kept_tiles = chance(4);
    trial.fidelity = chance(4) ? Fidelity::Strict : Fidelity::Exact;
    limit_host_threads(chance(2) ? 2 : 1);
    trial.words = trial.file + " frames " + std::to_string(trial.frames) + " views " +
                  std::to_string(trial.views) + (trial.options.array_only ? " alone" : "");
    for (const std::string& key : trial.keys) {
        trial.words += " " + key;
    }
    return trial;
}

/// Frames of a scene at cameras that pass it, so that some show little of it, or nothing. From the
/// third frame on some Gaussians may be gone.
std::vector<FrameWorkload> frames_of(const Trial& trial, const AcceleratorConfig& design,
                                     unsigned seed) {
    std::mt19937 random(seed + 1);
    const GaussianCloud all = test::random_cloud(60 + static_cast<int>(random() % 500), seed, 1);
    const GaussianCloud fewer = test::random_cloud(40, seed, 1);
    const bool shrinks = random() % 3 == 0;
    std::vector<FrameWorkload> frames;
    for (int f = 0; f < trial.frames; ++f) {
        const double aside = 1.5 * static_cast<double>(random() % 4);
        for (int v = 0; v < trial.views; ++v) {
            Camera camera;
            camera.width = trial.width;
            camera.height = trial.width * 5 / 7;
            camera.fx = camera.fy = 0.85 * trial.width;
            camera.position.x += aside + 0.3 * v + 0.05 * f;
            frames.push_back(make_frame_workload(shrinks && f > 2 ? fewer : all, camera,
                                                 design.tile_size_px(), design.tile_mode(),
                                                 projection_of(design.data_path(), false)));
        }
    }
    return frames;
}

double energy_nj(const AcceleratorConfig& design, const EngineRun& run, bool array_only) {
    AcceleratorResult result = run.result();
    result.array_only = array_only;
    return energy_of(design, result, 1).total_nj();
}

std::vector<const FrameWorkload*> pointers_to(const std::vector<FrameWorkload>& frames) {
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    return list;
}

class SmallRunFramesInTurn : public testing::TestWithParam<unsigned> {};

TEST_P(SmallRunFramesInTurn, AreTheRunOfFramesThatAreThere) {
    Trial trial = draw(GetParam());
    SCOPED_TRACE(trial.words);
    const Design loaded =
        load_design(std::string(DEGS_CONFIGS) + "/" + trial.file + ".yaml", trial.keys);
    const AcceleratorConfig& design = loaded.accelerator();
    const std::vector<FrameWorkload> frames = frames_of(trial, design, GetParam());
    const std::vector<const FrameWorkload*> pointers = pointers_to(frames);
    SharedBytes kept(1 << 22);
    trial.options.kept = trial.kept_tiles ? &kept : nullptr;
    const EngineRun there("there", design, pointers, trial.fidelity, trial.options, trial.views);
    const EngineRun in_turn("in_turn", design, pointers, trial.fidelity, trial.options, trial.views,
                            Joining::InTurn);
    sc_core::sc_start();
    there.expect_sound();
    in_turn.expect_sound();
    EXPECT_EQ(there.words(), in_turn.words());
    const bool alone = trial.options.array_only;
    EXPECT_EQ(energy_nj(design, there, alone), energy_nj(design, in_turn, alone));
    ASSERT_EQ(in_turn.job().images.size(), frames.size());
    for (std::size_t f = 0; f < frames.size(); ++f) {
        EXPECT_TRUE(test::same_bytes(there.image(f), in_turn.image(f))) << "frame " << f;
    }
    EXPECT_EQ(in_turn.job().tiles.size(), there.job().tiles.size());
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunFramesInTurn, testing::Range(0U, 120U));

class SmallRunFramesKept : public testing::TestWithParam<const char*> {};

// Two in flight, the last one that has ended, and two that blocks look ahead to.
TEST_P(SmallRunFramesKept, AreThoseInWork) {
    const Design loaded =
        load_design(std::string(DEGS_CONFIGS) + "/" + GetParam() + ".yaml", {"frames_in_flight=2"});
    const AcceleratorConfig& design = loaded.accelerator();
    Trial one;
    one.frames = 1;
    one.width = 140; // more tiles than sorters
    const FrameWorkload frame = frames_of(one, design, 0).front();
    const std::vector<const FrameWorkload*> frames(20, &frame);
    const EngineRun whole("whole", design, frames, Fidelity::Exact, {}, 1, Joining::InTurn);
    one.options.array_only = true;
    const EngineRun alone("alone", design, frames, Fidelity::Exact, one.options, 1,
                          Joining::InTurn);
    sc_core::sc_start();
    for (const EngineRun* run : {&whole, &alone}) {
        run->expect_sound();
        EXPECT_EQ(run->job().frames.size(), frames.size());
        EXPECT_LE(run->most_kept(), 5U);
    }
}

INSTANTIATE_TEST_SUITE_P(Designs, SmallRunFramesKept,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1"));

} // namespace
} // namespace degs
