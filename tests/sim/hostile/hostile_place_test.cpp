// SPDX-License-Identifier: Apache-2.0
// Names, working folders and limits of the system that nobody expects.
#include <sys/resource.h>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

TEST(HostilePlace, NamesThatLeaveNoRoomForASideFile) {
    const Folder folder;
    const std::string scene = "synthetic:object,gaussians=30";
    ASSERT_EQ(degs({"scene", "convert", scene, "--out", folder / "s.ply"}).code, 0);
    fs::remove(folder / "s.cameras.json"); // one without cameras
    fs::remove(folder / "cameras.json");
    const std::size_t most = 255, ending = 4, side_ending = 13; // .spz and .cameras.json
    for (const std::size_t letters : {200U, 238U, 242U, 243U, 251U, 252U, 300U}) {
        const std::string name(letters, 'e');
        for (const std::string& from : {folder / "s.ply", scene}) {
            const bool has_cameras = from == scene;
            const bool fits = letters + (has_cameras ? side_ending : ending) <= most;
            const Outcome outcome =
                degs({"scene", "convert", from, "--out", folder / (name + ".spz")});
            SCOPED_TRACE(from + " " + std::to_string(letters));
            if (fits) {
                EXPECT_EQ(outcome.code, 0) << outcome.err;
            } else {
                EXPECT_EQ(outcome.code, 2);
                EXPECT_NE(outcome.err.find("bytes; at most 255 are allowed"), std::string::npos)
                    << outcome.err;
            }
            std::error_code none;
            EXPECT_EQ(fs::remove(folder / (name + ".spz"), none), fits);
            EXPECT_EQ(fs::remove(folder / (name + ".cameras.json"), none), fits && has_cameras);
        }
    }
}

TEST(HostilePlace, NamesThatAreTooLongAreRefusedBeforeTheRun) {
    const Folder folder;
    const std::string name = folder / std::string(256, 'e');
    for (const std::vector<std::string>& option : {std::vector<std::string>{"--trace", name},
                                                   {"--memory-trace", name + ".stl"},
                                                   {"--block-log", "bank:0", name}}) {
        std::vector<std::string> words{
            "run", config("degs-16"), "--scene",   "synthetic:object", "--width",
            "32",  "--out",           folder / "o"};
        words.insert(words.end(), option.begin(), option.end());
        const Outcome outcome = degs(words);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find("at most 255 are allowed"), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(folder / "o/image.exr"));
    }
    write_ply(folder / (std::string(240, 's') + ".ply"), {Splat()});
    EXPECT_EQ(degs({"accuracy", "--scene", folder / (std::string(240, 's') + ".ply"), "--numbers",
                    "paper", "--out", folder / "a"})
                  .code,
              0);
}

TEST(HostilePlace, AWorkingFolderThatIsGone) {
    const Folder folder;
    ASSERT_EQ(
        degs({"scene", "convert", "synthetic:object,gaussians=30", "--out", folder / "s.ply"}).code,
        0);
    const auto gone = [&folder] {
        const std::string place = folder / "gone";
        fs::create_directory(place);
        fs::current_path(place);
        fs::remove(place);
    };
    std::string single;
    for (const std::string& scene : {std::string("synthetic:single"), folder / "s.ply"}) {
        const std::vector<std::string> run{"run", config("degs-16"), "--scene",   scene, "--width",
                                           "32",  "--out",           folder / "o"};
        EXPECT_EQ(degs(run, gone).code, 0) << degs(run, gone).err;
        const std::vector<std::string> sweep{
            "compare", config("degs-16"), "--scene", scene, "--width", "32", "--out", folder / "c"};
        EXPECT_EQ(degs(sweep, gone).code, 0) << degs(sweep, gone).err;
    }
    expect_mistake(
        degs({"run", config("degs-16"), "--scene", "s.ply", "--out", folder / "o"}, gone),
        "there is no such file");
}

} // namespace
} // namespace degs::sim_test
