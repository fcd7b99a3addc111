// SPDX-License-Identifier: Apache-2.0
// What stands in the folders of results and of the cache, and what ends a run while it writes
// there.
#include <csignal>

#include <sys/resource.h>
#include <sys/stat.h>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const char* const kLittle = "synthetic:single";

std::vector<std::string> little_run(const std::string& out, const std::string& design = "degs-64",
                                    const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"run",     config(design), "--scene", kLittle,
                                       "--width", "48",           "--out",   out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

bool has_partial_files(const std::string& folder) {
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().filename().string().find(".partial-") != std::string::npos) {
            return true;
        }
    }
    return false;
}

/// Waits until a file of the folder is being written, then ends the program with the signal.
int status_after(int signal, const std::vector<std::string>& arguments, const std::string& folder) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        std::vector<char*> argv{const_cast<char*>(DEGS_PROGRAM)};
        for (const std::string& argument : arguments) {
            argv.push_back(const_cast<char*>(argument.c_str()));
        }
        argv.push_back(nullptr);
        ::execv(DEGS_PROGRAM, argv.data());
        ::_exit(127);
    }
    int status = 0;
    while (!has_partial_files(folder) && ::waitpid(child, &status, WNOHANG) == 0) {
    }
    ::kill(child, signal);
    ::waitpid(child, &status, 0);
    return status;
}

// The first partial file may be the probe of the folder, so that a signal comes at any time.
TEST(HostileEnd, AFolderHoldsOneRunOrNoReport) {
    const Folder folder;
    expect_success(degs(little_run(folder / "old")));
    for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGKILL}) {
        const std::string out = folder / "out";
        fs::remove_all(out);
        fs::copy(folder / "old", out);
        const int status = status_after(
            signal,
            {"run", config("gscore-16"), "--scene", kLittle, "--width", "800", "--out", out}, out);
        const bool ended = WIFSIGNALED(status) && WTERMSIG(status) == signal;
        EXPECT_TRUE(ended || status == 0) << signal;
        if (signal != SIGKILL) {
            EXPECT_FALSE(has_partial_files(out)) << signal;
        }
        const bool same_image =
            read_file(out + "/image.exr") == read_file(folder / "old/image.exr");
        if (fs::exists(out + "/report.json")) {
            const bool old = report_in(out)["config"]["name"] == "degs-64";
            EXPECT_EQ(old, same_image) << signal;
        }
        expect_success(degs(little_run(out)));
        EXPECT_FALSE(has_partial_files(out)) << signal;
    }
}

/// Named as a result is, or a link to one: the command ends before it replaces what it reads.
TEST(HostileEnd, InputsAreNoResults) {
    const Folder folder;
    const std::string poses = "time_s,x,y,z,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n0.1,0,0,0,1,0,0,0\n";
    std::ofstream(folder / "motion.csv") << poses;
    std::ofstream(folder / "latency.svg") << "LD 0x40\nST 0x80\n";
    fs::create_hard_link(folder / "motion.csv", folder / "link.csv");
    for (const char* const name : {"motion.csv", "link.csv"}) {
        const Outcome motion =
            degs({"motion", config("degs-16"), "--scene", "synthetic:single", "--width", "32",
                  "--fidelity", "analytic", "--poses", folder / name, "--out", folder / ""});
        EXPECT_EQ(motion.code, 2) << motion.err;
        EXPECT_NE(motion.err.find("which this command reads"), std::string::npos) << motion.err;
        EXPECT_EQ(read_file(folder / "motion.csv"), poses);
    }
    const Outcome memory = degs({"memory", config("memory/lpddr5-6400x128"), "--trace",
                                 folder / "latency.svg", "--out", folder / ""});
    EXPECT_EQ(memory.code, 2) << memory.err;
    EXPECT_NE(memory.err.find("which this command reads"), std::string::npos) << memory.err;
    EXPECT_EQ(read_file(folder / "latency.svg").substr(0, 7), "LD 0x40");
}

TEST(HostileEnd, ResultsOfAnotherCommandGo) {
    const Folder folder;
    const std::string out = folder / "out";
    expect_success(degs(little_run(out, "degs-64", {"--maps", out})));
    expect_success(degs({"render", "--scene", kLittle, "--width", "32", "--out", out}));
    EXPECT_FALSE(fs::exists(out + "/report.json"));
    EXPECT_FALSE(fs::exists(out + "/tiles.exr"));
    expect_success(degs(little_run(out)));
    EXPECT_FALSE(fs::exists(out + "/render.json"));
}

TEST(HostileEnd, PartialFilesOfKilledRunsGoAndOthersStay) {
    const Folder folder;
    fs::create_directories(folder / "out");
    const std::string left = folder / "out/image.exr.partial-123-0";
    const std::vector<std::string> of_the_user{folder / "out/a.partial-b",
                                               folder / "out/a.partial-1-2-3"};
    std::ofstream{left} << "x";
    for (const std::string& name : of_the_user) {
        std::ofstream{name} << "x";
    }
    expect_success(degs(little_run(folder / "out")));
    EXPECT_FALSE(fs::exists(left));
    for (const std::string& name : of_the_user) {
        EXPECT_TRUE(fs::exists(name)) << name;
    }
}

// A full disk keeps what was there before.
// Not among the tests under the address sanitizer, which takes an exception behind a simulation for
// a mistake because it does not know the stacks of SystemC's processes.
TEST(FullDisk, ALimitOfFileSizesIsOne) {
    const Folder folder;
    const std::string out = folder / "out";
    expect_success(degs(little_run(out)));
    const std::string before = read_file(out + "/report.json");
    const Outcome outcome = degs(little_run(out, "gscore-16"), [] {
        const rlimit most{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &most);
    });
    expect_mistake(outcome, "out/");
    EXPECT_EQ(read_file(out + "/report.json"), before);
    EXPECT_FALSE(has_partial_files(out));
}

TEST(HostileOutput, ALinkInPlaceOfTheProbeKeepsItsTarget) {
    const Folder folder;
    fs::create_directories(folder / "out");
    std::ofstream(folder / "precious") << "precious";
    fs::create_symlink(folder / "precious", folder / "out/.degs-probe");
    fs::create_symlink(folder / "precious", folder / "out/image.png");
    expect_success(degs(little_run(folder / "out")));
    EXPECT_EQ(read_file(folder / "precious"), "precious");
}

TEST(HostileOutput, OutputsReplaceNeitherInputsNorEachOther) {
    const Folder folder;
    const std::string out = folder / "o", design = folder / "my.yaml";
    fs::create_directories(out);
    fs::copy(config("degs-64"), design);
    write_ply(folder / "s.ply", {Splat{}});
    write_camera(folder / "c.json", {0, 0, -3});
    fs::create_symlink(design, folder / "link.yaml");
    fs::create_hard_link(design, folder / "hard.yaml");
    const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
        std::vector<std::string> arguments{"run",     design, "--scene", folder / "s.ply",
                                           "--width", "48",   "--out",   out};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = degs(arguments);
        EXPECT_EQ(outcome.code, 2) << words;
        EXPECT_NE(outcome.err.find("would replace"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(out + "/report.json"));
    };
    const std::string before = read_file(design);
    refused({"--trace", out + "/report.json"}, "report.json");
    refused({"--trace", out + "/../o/./image.png"}, "image.png");
    for (const char* name : {"my.yaml", "link.yaml", "hard.yaml", "s.ply"}) {
        refused({"--trace", folder / name}, name);
    }
    refused({"--camera-file", folder / "c.json", "--trace", folder / "c.json"}, "c.json");
    refused({"--maps", folder / "maps", "--trace", folder / "maps/tiles.exr"}, "tiles.exr");
    EXPECT_EQ(read_file(design), before);
    const std::string both = folder / "both.stl";
    refused({"--trace", both, "--memory-trace", both}, "both.stl");
    refused({"--trace", both, "--block-log", "bank:0", folder / "./both.stl"}, "both.stl");
    refused({"--block-log", "bank:0", both, "--memory-trace", both}, "both.stl");
    const Outcome in_place =
        degs({"scene", "convert", folder / "s.ply", "--out", folder / "./s.ply"});
    EXPECT_EQ(in_place.code, 2);
    EXPECT_NE(in_place.err.find("would replace"), std::string::npos) << in_place.err;
}

// Also of those whose names a command makes itself, and which it would remove before it begins.
TEST(HostileOutput, NoResultReplacesAnInput) {
    const Folder folder;
    write_ply(folder / "s.ply", {Splat{}});
    write_camera(folder / "c.json", {0, 0, -3});
    std::ofstream(folder / "study.yaml")
        << "study: s\ndesigns:\n  - include: " << config("degs-16")
        << "\n    name: a\naxes: { packing.bytes: [x1, x2] }\nscenes: s.ply\nwidth: 48\n";
    const std::string out = folder / "o";
    const std::vector<std::string> view{"--scene", folder / "s.ply", "--width", "48"};
    const std::vector<std::string> pixels{"--scene", folder / "s.ply"};
    const std::vector<std::string> design{"n=" + config("degs-16")};
    const std::vector<std::string> study{folder / "study.yaml"};
    struct Case {
        const char *command, *input, *copied;
        std::vector<std::string> words;
    };
    const std::string explored = out + "/explore.json";
    const std::vector<Case> cases{{"accuracy", "accuracy.json", "c.json", pixels},
                                  {"accuracy", "error-1-s-64x48-paper.exr", "c.json", pixels},
                                  {"explore", "explore.json", "study.yaml", {explored}},
                                  {"explore", "explore.json", "c.json", study},
                                  {"sweep", "reports/000002.json", "c.json", study},
                                  {"sweep", "study.json", "c.json", study},
                                  {"compare",
                                   "reports/1-s-camera0-48x36/1-n.json",
                                   "c.json",
                                   {design[0], view[0], view[1], view[2], view[3]}}};
    for (const Case& each : cases) {
        SCOPED_TRACE(std::string(each.command) + " " + each.input);
        fs::remove_all(out);
        std::vector<std::string> words{each.command};
        words.insert(words.end(), each.words.begin(), each.words.end());
        words.insert(words.end(), {"--out", out});
        const bool explores_itself = each.words[0] == explored;
        if (!explores_itself) {
            EXPECT_EQ(degs(words).code, 0);
        }
        const std::string input = out + "/" + each.input;
        fs::create_directories(fs::path(input).parent_path());
        fs::copy_file(folder / each.copied, input, fs::copy_options::overwrite_existing);
        fs::copy_file(folder / "s.ply", out + "/s.ply", fs::copy_options::overwrite_existing);
        const std::string before = read_file(input);
        if (!explores_itself) {
            words.insert(words.end(), {"--camera-file", input});
        }
        const Outcome outcome = degs(words);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_NE(outcome.err.find(each.input), std::string::npos) << outcome.err;
        EXPECT_EQ(read_file(input), before);
    }
}

TEST(HostileInput, PipesAndDevicesAreRefused) {
    const Folder folder;
    const std::string pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    ::setenv("DEGS_CACHE", (folder / "cache").c_str(), 1);
    const std::vector<std::string> files{pipe, "/dev/zero"};
    for (const std::string& file : files) {
        expect_mistake(degs(little_run(folder / "o", "degs-64", {"--camera-file", file})), file);
        expect_mistake(degs({"run", config("degs-64"), "--scene", file, "--out", folder / "o"}),
                       file);
        expect_mistake(degs({"run", file, "--scene", kLittle, "--out", folder / "o"}), file);
        expect_mistake(degs(little_run(folder / "o", "degs-64", {"--memory", file})), file);
    }
    ::setenv("DEGS_CACHE", "", 1);
}

TEST(HostileInput, LinksThatLeadNowhereAreCalledSo) {
    const Folder folder;
    write_ply(folder / "s.ply", {Splat{}});
    for (const char* name : {"link.ply", "cameras.json", "transforms.json"}) {
        fs::create_symlink("nowhere", folder / name);
        const bool scene = std::string(name) == "link.ply";
        expect_mistake(degs({"render", "--scene", folder / (scene ? name : "s.ply"), "--width",
                             "48", "--out", folder / "o"}),
                       std::string(name) + ": this is a link to 'nowhere', which does not exist");
        fs::remove(folder / name);
    }
}

TEST(HostileInput, NoFrameOfASequenceIsLeftOut) {
    const Folder folder;
    fs::create_directories(folder / "f");
    write_ply(folder / "f/0.ply", {Splat{}});
    const auto drawn = [&](const std::string& scene) {
        return degs({"render", "--scene", scene, "--width", "48", "--out", folder / "o"});
    };
    const std::string broken = folder / "f/1.ply";
    for (const std::string& scene : {folder / "f", folder / "f/*.ply"}) {
        ASSERT_EQ(::mkfifo(broken.c_str(), 0600), 0);
        expect_mistake(drawn(scene), "1.ply: this is a pipe, socket or device");
        fs::remove(broken);
        fs::create_symlink("nowhere", broken);
        expect_mistake(drawn(scene), "1.ply: this is a link to 'nowhere'");
        fs::remove(broken);
        fs::create_directory(broken);
        expect_mistake(drawn(scene), "1.ply: this is a folder");
        fs::remove(broken);
    }
}

TEST(HostileInput, APatternOfManyStarsIsQuick) {
    const Folder folder;
    std::ofstream(folder / (std::string(100, 'a') + ".ply")) << "x";
    expect_mistake(degs({"scene", "info", folder / "*a*a*a*a*a*a*a*a*a*a*b.ply"}), "no file");
}

} // namespace
} // namespace degs::sim_test
