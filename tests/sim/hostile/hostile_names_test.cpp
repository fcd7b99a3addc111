// SPDX-License-Identifier: Apache-2.0
// Names of files, scenes, cameras and designs may contain anything; a terminal must not obey them.
#include <algorithm>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// Clears the screen, begins a line of its own, turns red.
const char* const kEvil = "a\x1b[2J\nslots\r\x9b"
                          "31m";
const char* const kShown = "a\\x1b[2J\\nslots\\r\\x9b31m";

/// No control character but the ends of lines, and the name in its harmless form.
void expect_harmless(const std::string& text) {
    EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](unsigned char c) {
        return (c < 0x20 && c != '\n') || c == 0x7f || c == 0x9b;
    })) << text;
    EXPECT_NE(text.find(kShown), std::string::npos) << text;
}

/// A scene, its camera and a design that are called kEvil.
void write_evil_files(const Folder& folder) {
    write_ply(folder / (std::string(kEvil) + ".ply"), {Splat{}});
    write_camera(folder / "cameras.json", {0, 0, -5});
    nlohmann::json cameras = nlohmann::json::parse(read_file(folder / "cameras.json"));
    cameras[0]["img_name"] = "a\x1b[2J\nslots\r\xc2\x9b"
                             "31m"; // as UTF-8, which JSON must be
    std::ofstream(folder / "cameras.json") << cameras;
    std::ofstream(folder / "c.yaml") << "include: " << config("degs-64") << "\n"
                                     << R"(name: "a\e[2J\nslots\r\x9b31m")"
                                     << "\n";
}

TEST(HostileNames, ReachNoTerminal) {
    const Folder folder;
    write_evil_files(folder);
    const std::string scene = folder / (std::string(kEvil) + ".ply");
    const std::string out = folder / kEvil;
    const std::vector<std::vector<std::string>> commands{
        {"scene", "info", scene, "--camera", "0"},
        {"scene", "convert", scene, "--out", folder / (std::string(kEvil) + "/s.ply")},
        {"render", "--scene", scene, "--out", out},
        {"run", folder / "c.yaml", "--scene", scene, "--out", out},
        {"compare", std::string(kEvil) + "=" + (folder / "c.yaml"), "--scene", scene, "--out", out},
        {"soc", folder / "c.yaml", "--scene", scene, "--load", "0", "--out", out},
        {"accuracy", "--scene", scene, "--numbers", "fp16", "--out", out}};
    for (const std::vector<std::string>& command : commands) {
        const Outcome outcome = degs(command);
        EXPECT_EQ(outcome.code, 0) << command.front() << outcome.err;
        expect_harmless(outcome.out);
    }
}

TEST(HostileNames, ReachNoTerminalInMessages) {
    const Folder folder;
    write_evil_files(folder);
    for (const auto& command : std::vector<std::vector<std::string>>{
             {"run", folder / "c.yaml", "--scene", folder / kEvil},
             {"run", folder / kEvil, "--scene", "synthetic:single"},
             {"run", folder / "c.yaml", "--scene", "synthetic:" + std::string(kEvil)},
             {"run", folder / "c.yaml", "--scene", "synthetic:single", "--out",
              "/proc/" + std::string(kEvil)},
             {"run", folder / "c.yaml", "--scene", "synthetic:single", "--camera-file",
              folder / kEvil},
             {kEvil},
             {"run", kEvil, "--scene"}}) {
        const Outcome outcome = degs(command);
        expect_mistake(outcome, "");
        EXPECT_EQ(outcome.err.find_first_of("\x1b\r\x9b"), std::string::npos) << outcome.err;
    }
}

} // namespace
} // namespace degs::sim_test
