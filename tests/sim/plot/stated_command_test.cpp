// SPDX-License-Identifier: Apache-2.0
// Every picture of the program says which command made it.
#include <map>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using Words = std::vector<std::string>;

/// The pictures in a folder, by name.
std::map<std::string, std::string> pictures_in(const std::string& folder) {
    std::map<std::string, std::string> pictures;
    for (const auto& file : fs::directory_iterator(folder)) {
        if (file.path().extension() == ".svg") {
            pictures[file.path().filename().string()] = read_file(file.path());
        }
    }
    return pictures;
}

/// What is written between the tags of `<desc>`; XML has kept the quotes of a shell.
std::string stated_in(const std::string& picture) {
    const std::string begin = "</title>\n<desc>";
    const std::size_t from = picture.find(begin);
    const std::size_t to = picture.find("</desc>\n", from);
    return from == std::string::npos || to == std::string::npos
               ? ""
               : picture.substr(from + begin.size(), to - from - begin.size());
}

/// The command's pictures have this sentence, and the sentence makes the same pictures.
void expect_pictures(const Words& words, const std::string& stated, const Words& names) {
    const Folder folder;
    Words arguments = words;
    arguments.insert(arguments.end(), {"--out", folder / "a"});
    const Outcome outcome = degs(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto pictures = pictures_in(folder / "a");
    for (const std::string& name : names) {
        EXPECT_EQ(pictures.count(name), 1U) << name;
    }
    EXPECT_EQ(pictures.size(), names.size());
    for (const auto& [name, picture] : pictures) {
        EXPECT_EQ(stated_in(picture), stated) << name;
    }
    const std::string again = "degs() { '" DEGS_PROGRAM "' \"$@\"; }; " + stated + " --out '" +
                              (folder / "b") + "' >/dev/null 2>&1";
    EXPECT_EQ(std::system(again.c_str()), 0) << again;
    EXPECT_EQ(pictures_in(folder / "b"), pictures);
}

std::string bandwidth_study(const Folder& folder) {
    const std::string file = folder / "a study.yaml";
    std::ofstream(file) << "study: bandwidth\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n"
                           "  memory.bandwidth_gb_per_s: 51.2GB/s..204.8GB/s x2\n"
                           "scenes: synthetic:object,gaussians=300\n";
    return file;
}

TEST(StatedCommands, MakeThePicturesAgain) {
    const Folder folder;
    const std::string file = bandwidth_study(folder);
    expect_pictures({"sweep", "--width", "64", file, "--jobs", "2", "--sort", "cycles"},
                    "degs sweep '" + file + "' --width 64", {"bandwidth.svg"});
    expect_pictures({"explore", file, "--width", "64", "--budget", "9", "--jobs", "2"},
                    "degs explore '" + file + "' --width 64 --budget 9",
                    {"bandwidth.svg", "front.svg"});
    expect_pictures({"compare", config("degs-64"), config("degs-16"), "--jobs", "2", "--scene",
                     "synthetic:object,gaussians=300", "--width", "64", "--no-reference"},
                    "degs compare " + config("degs-64") + " " + config("degs-16") +
                        " --scene synthetic:object,gaussians=300 --width 64 --no-reference",
                    {"ratios.svg", "slots.svg", "utilization.svg"});
    const std::string memory = std::string(DEGS_CONFIGS) + "/memory/lpddr5x-8533x64.yaml";
    expect_pictures({"memory", memory, "--set", "channels=2", "--requests", "2000", "--seed", "3"},
                    "degs memory " + memory + " --seed 3 --requests 2000 --set channels=2",
                    {"latency.svg"});
}

} // namespace
} // namespace degs::sim_test
