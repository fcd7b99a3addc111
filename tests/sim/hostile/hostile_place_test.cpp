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
    for (const std::size_t letters : {200U, 238U, 243U, 247U, 250U, 251U, 300U}) {
        const std::string file = folder / (std::string(letters, 'e') + ".spz");
        for (const std::string& from : {folder / "s.ply", scene}) {
            const Outcome outcome = degs({"scene", "convert", from, "--out", file});
            EXPECT_EQ(outcome.err.find("Internal error"), std::string::npos) << outcome.err;
            EXPECT_TRUE(outcome.code == 0 || outcome.code == 2) << letters << outcome.err;
            EXPECT_EQ(fs::exists(folder / "x") || outcome.code == 0, outcome.code == 0);
        }
    }
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
