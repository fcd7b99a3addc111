// SPDX-License-Identifier: Apache-2.0
// A sequence of files that are all the same, against the still scene.
#include <filesystem>

#include "scene/ply/ply.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "sim/cache/cached_view.hpp"
#include "sim/design/run_config.hpp"
#include "sim/simulation/frame_changes.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/view/view.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs::sim {
namespace {

struct Outcome {
    AcceleratorResult run;
    std::optional<FrameChanges> changes;
};

/// Runs frames of a scene whose camera stands still.
Outcome run_still(const std::string& scene, const std::string& cameras) {
    ViewRequest request;
    request.scene = scene;
    request.camera_file = cameras;
    request.width = 96;
    RunRequest run;
    run.config = load_run_config(std::string(DEGS_CONFIGS) + "/degs-64.yaml", {}, "");
    run.reference = false;
    run.recording.images = true;
    CachedView view(request, PathRequest{3, 0}, FrameCache()); // no step from frame to frame
    const AcceleratorConfig& design = run.config.accelerator();
    const std::vector<FramePointer> first = view.first_frame(design);
    RunResult result = run_frames(run, view.frames(design, first));
    return {std::move(result.accelerator), result.changes};
}

/// A process has one simulation: the other one runs in a child, and says what it found in a file.
std::string words_of(const Outcome& outcome) {
    std::string words = std::to_string(outcome.run.cycles);
    for (const SlotClass& slot : kSlotClasses) {
        words += " " + std::to_string(outcome.run.slots[slot.slot]);
    }
    for (const Image& image : outcome.run.images) {
        words.append(reinterpret_cast<const char*>(image.rgb.data()),
                     image.rgb.size() * sizeof image.rgb[0]);
    }
    return words;
}

class SmallRunStaticSequence : public testing::Test {
protected:
    SmallRunStaticSequence() {
        folder_.write("f/1.ply", "");
        write_ply(make_synthetic({"object", 400, 1}).cloud, folder_.path("f/1.ply"));
        for (const char* copy : {"f/2.ply", "f/10.ply"}) {
            std::filesystem::copy_file(folder_.path("f/1.ply"), folder_.path(copy));
        }
    }
    test::Folder folder_;
};

TEST_F(SmallRunStaticSequence, EqualsTheStaticSceneBitByBit) {
    const std::string cameras = folder_.write("cameras.json", R"([{"width":96,"height":64,
        "fx":80,"fy":80,"position":[0,0,-3],"rotation":[[1,0,0],[0,1,0],[0,0,1]]}])");
    const std::string found = folder_.path("child");
    EXPECT_EXIT(
        {
            std::ofstream(found, std::ios::binary)
                << words_of(run_still(folder_.path("f/1.ply"), cameras));
            std::_Exit(0);
        },
        testing::ExitedWithCode(0), "");
    const Outcome sequence = run_still(folder_.path("f/*.ply"), cameras);
    EXPECT_EQ(words_of(sequence), test::bytes_of(found));
    ASSERT_EQ(sequence.run.images.size(), 3U);
    EXPECT_EQ(sequence.run.images[0].rgb, sequence.run.images[2].rgb);
    EXPECT_EQ(sequence.changes.value().active_overlap, 1);
    EXPECT_EQ(sequence.changes.value().tile_churn, 0);
}

} // namespace
} // namespace degs::sim
