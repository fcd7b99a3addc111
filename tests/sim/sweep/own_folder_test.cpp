// SPDX-License-Identifier: Apache-2.0
// The folder of a sweep is of one study at every moment, and only regular files are read in it.
#include <csignal>
#include <random>
#include <thread>

#include <sys/stat.h>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// One point on one camera; the results name the camera.
std::string study_of(const Folder& folder, int camera, const std::string& more = "") {
    const std::string file = folder / ("study" + std::to_string(camera) + ".yaml");
    std::ofstream(file) << "study: camera" << camera
                        << "\ndesigns:\n  - include: " << config("degs-16") << "\n    name: d\n"
                        << "scenes: synthetic:object,gaussians=300\nwidth: 32\nreference: false\n"
                        << "cameras: [" << camera << "]\n"
                        << more;
    return file;
}

std::string name_in(const std::string& out) {
    return nlohmann::json::parse(read_file(out + "/study.json"))["study"];
}

/// Empty without results.
std::string study_of_results(const std::string& out) {
    const std::string text = read_file(out + "/results.json");
    return text.empty() ? "" : nlohmann::json::parse(text)["study"].get<std::string>();
}

const char* const kMany = "axes:\n  clock_ghz: [0.5, 0.6, 0.7, 0.8]\n";

/// The program, which the caller stops.
pid_t started(const std::vector<std::string>& arguments) {
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
    return child;
}

class KilledSweep : public testing::TestWithParam<unsigned> {};

TEST_P(KilledSweep, LeavesResultsOfTheStudyThatTheFolderNames) {
    std::mt19937 draw(GetParam());
    const Folder folder;
    const std::string out = folder / "out";
    ASSERT_EQ(degs({"sweep", study_of(folder, 0), "--out", out}).code, 0);
    EXPECT_EQ(study_of_results(out), "camera0");
    const pid_t child = started({"sweep", study_of(folder, 1, kMany), "--out", out});
    std::this_thread::sleep_for(std::chrono::microseconds(draw() % 120000));
    ::kill(child, draw() % 2 == 0 ? SIGKILL : SIGHUP);
    ::waitpid(child, nullptr, 0);
    const std::string found = study_of_results(out);
    EXPECT_TRUE(found.empty() || found == name_in(out)) << found << " beside " << name_in(out);
    // A kill may remove some files of the other study, but leaves none beside the new name.
    std::istringstream table(read_file(out + "/results.csv"));
    std::string head, row;
    std::getline(table, head);
    if (std::getline(table, row)) {
        std::size_t column = 0;
        std::istringstream names(head), cells(row);
        std::string name, cell;
        while (std::getline(names, name, ',') && name != "camera") {
            ++column;
        }
        for (std::size_t k = 0; k <= column; ++k) {
            std::getline(cells, cell, ',');
        }
        EXPECT_EQ("camera" + cell, name_in(out));
    }
}

INSTANTIATE_TEST_SUITE_P(Random, KilledSweep, testing::Range(0U, 40U));

TEST(OwnFolder, IsEmptiedWhenAnotherStudyBegins) {
    const Folder folder;
    const std::string out = folder / "out";
    ASSERT_EQ(degs({"sweep", study_of(folder, 0), "--out", out}).code, 0);
    ASSERT_EQ(degs({"sweep", study_of(folder, 1), "--out", out, "--shard", "1/1"}).code, 0);
    EXPECT_EQ(name_in(out), "camera1");
    for (const char* file : {"results.csv", "results.json", "host.csv", "index.html"}) {
        EXPECT_FALSE(fs::exists(out + "/" + file)) << file;
    }
    EXPECT_FALSE(fs::exists(out + "/reports/000001.json"));
    ASSERT_EQ(degs({"sweep", study_of(folder, 0), "--out", out}).code, 0); // its point was kept
    EXPECT_EQ(study_of_results(out), "camera0");
}

TEST(OwnFolder, IsNotTakenFromASweepThatRuns) {
    const Folder folder;
    const std::string out = folder / "out";
    const pid_t child = started(
        {"sweep", study_of(folder, 0, "frames: 3000\n" + std::string(kMany)), "--out", out});
    while (!fs::exists(out + "/study.json")) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const Outcome other = degs({"sweep", study_of(folder, 1), "--out", out});
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    expect_mistake(other, "is in use for another study");
    EXPECT_EQ(name_in(out), "camera0");
}

TEST(OwnFolder, HasOnlyRegularFiles) {
    const Folder folder;
    const std::string out = folder / "out";
    const std::string study = study_of(folder, 0);
    ASSERT_EQ(degs({"sweep", study, "--out", out}).code, 0);
    const std::string point = fs::directory_iterator(out + "/points")->path().string();
    for (const std::string& file : {point, out + "/study.json", out + "/reports/000001.json"}) {
        const std::string bytes = read_file(file);
        for (const bool device : {false, true}) {
            SCOPED_TRACE(file);
            fs::remove(file);
            if (device) {
                fs::create_symlink("/dev/zero", file);
            } else {
                ::mkfifo(file.c_str(), 0600);
            }
            const Outcome outcome = degs({"sweep", study, "--out", out}, [] { ::alarm(5); });
            expect_mistake(outcome, "is not a regular file");
            EXPECT_NE(outcome.err.find(fs::path(file).filename().string()), std::string::npos);
        }
        fs::remove(file);
        std::ofstream(file, std::ios::binary) << bytes;
    }
    EXPECT_EQ(degs({"sweep", study, "--out", out}).code, 0);
}

} // namespace
} // namespace degs::sim_test
