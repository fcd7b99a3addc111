// SPDX-License-Identifier: Apache-2.0
// Places that take no results: full devices, limits of the size of files, folders without rights.
#include <csignal>

#include <sys/resource.h>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const char* const kScene = "synthetic:single";

std::vector<std::vector<std::string>> commands_with_results(const Folder& folder) {
    const std::string memory = std::string(DEGS_CONFIGS) + "/memory/lpddr5-3200x128.yaml";
    const std::string out = folder / "out";
    return {
        {"--help"},
        {"--version"},
        {"run", "--help"},
        {"config", "--format", "yaml"},
        {"config", "--format", "text"},
        {"scene", "info", kScene},
        {"scene", "generate", "single", "--out", folder / "scene.ply"},
        {"scene", "convert", kScene, "--out", folder / "other.ply"},
        {"render", "--scene", kScene, "--width", "16", "--out", out},
        {"run", config("degs-64"), "--scene", kScene, "--width", "16", "--out", out},
        {"compare", config("degs-64"), "--scene", kScene, "--width", "16", "--out", out},
        {"memory", memory, "--requests", "1000", "--no-curve", "--out", out},
        {"soc", config("degs-64"), "--scene", kScene, "--width", "16", "--load", "0", "--out", out},
        {"accuracy", "--single-gaussian", "--splats", "2", "--numbers", "fp16", "--out", out}};
}

TEST(FullDevice, IsNoticedByEveryCommand) {
    for (std::size_t i = 0; i < commands_with_results(Folder()).size(); ++i) {
        const Folder folder;
        const std::vector<std::string> command = commands_with_results(folder)[i];
        const Outcome outcome =
            degs(command, [] { ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO); });
        EXPECT_EQ(outcome.code, 2) << command.front();
        EXPECT_NE(outcome.err.find("degs: The standard output cannot be written: No space left on "
                                   "device.\n"),
                  std::string::npos)
            << command.front() << ": " << outcome.err;
    }
}

TEST(FullDevice, AClosedOutputIsNoticed) {
    const Outcome outcome = degs({"--version"}, [] { ::close(STDOUT_FILENO); });
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("The standard output cannot be written"), std::string::npos);
}

/// Files of at most `bytes`, which is what a full disk looks like to a program.
std::function<void()> limit(rlim_t bytes) {
    return [bytes] {
        const rlimit most{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &most);
        std::signal(SIGXFSZ, SIG_IGN);
    };
}

/// The command fails with one sentence about `file`, which is not there, nor is a part of it.
void expect_nothing_written(const Folder& folder, const std::vector<std::string>& command,
                            rlim_t bytes, const std::string& file) {
    const Outcome outcome = degs(command, limit(bytes));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    for (const auto& entry : fs::directory_iterator(folder / ".")) {
        EXPECT_EQ(entry.path().filename().string().rfind(file, 0), std::string::npos)
            << entry.path();
    }
}

TEST(FullDisk, LeavesNoPartOfAFile) {
    // An image this small is in the buffer of its file until that is closed.
    const auto render = [](const Folder& folder, const char* width) {
        return std::vector<std::string>{"render", "--scene", kScene,      "--width",
                                        width,    "--out",   folder / "."};
    };
    for (const char* width : {"8", "400"}) {
        const Folder folder;
        expect_nothing_written(folder, render(folder, width), 500, "image.exr");
    }
    const Folder folder;
    expect_nothing_written(
        folder, {"scene", "generate", "object", "--gaussians", "500", "--out", folder / "s.ply"},
        4000, "s.ply");
    expect_nothing_written(folder,
                           {"accuracy", "--single-gaussian", "--splats", "2", "--numbers", "fp16",
                            "--out", folder / "."},
                           200, "accuracy.json");
}

} // namespace
} // namespace degs::sim_test
