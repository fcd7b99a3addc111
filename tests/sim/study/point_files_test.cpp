// SPDX-License-Identifier: Apache-2.0
// The files of finished points: damaged, lost, not written, and used by other studies.
#include <algorithm>
#include <csignal>
#include <map>

#include <sys/resource.h>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

std::string study_with(const Folder& folder, const std::string& lines,
                       const std::string& name = "study") {
    const std::string file = folder / (name + ".yaml");
    std::ofstream(file) << "designs:\n  - include: " << config("degs-64") << "\n    name: d\n"
                        << "scenes: synthetic:object,gaussians=300\n"
                        << lines;
    return file;
}

const char* const kSix = "axes:\n  clock_ghz: [0.5, 1, 2]\ncameras: [0, 1]\nwidth: 48\n";

/// How many points were simulated.
std::size_t runs_of(const std::string& file, const std::string& out,
                    const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"sweep", file, "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = degs(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::size_t runs = 0;
    for (std::size_t at = 0; (at = outcome.err.find(" done · ", at)) != std::string::npos; ++at) {
        ++runs;
    }
    return runs;
}

std::vector<std::string> files_in(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& file : fs::directory_iterator(folder)) {
        files.push_back(file.path().string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void flip(const std::string& file, std::size_t at, int bit) {
    std::string bytes = read_file(file);
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << bit));
    std::ofstream(file, std::ios::binary) << bytes;
}

// Wherever the bit is, the point is run again and the results do not change.
TEST(PointFiles, ADamagedPointIsRunAgain) {
    const Folder folder;
    const std::string file = study_with(folder, kSix);
    EXPECT_EQ(runs_of(file, folder / "o"), 6U);
    EXPECT_EQ(runs_of(file, folder / "o"), 0U);
    const std::string csv = read_file(folder / "o/results.csv");
    const std::vector<std::string> points = files_in(folder / "o/points");
    ASSERT_EQ(points.size(), 6U);
    for (std::size_t k = 0; k < points.size(); ++k) { // from the first byte to the last
        const std::size_t bytes = read_file(points[k]).size();
        flip(points[k], k * (bytes - 1) / (points.size() - 1), static_cast<int>(k % 7));
    }
    const Outcome collected = degs({"sweep", file, "--out", folder / "o", "--collect"});
    EXPECT_EQ(collected.code, 2);
    EXPECT_NE(collected.err.find("6 points are missing, 6 of them because their files are damaged"),
              std::string::npos)
        << collected.err;
    EXPECT_EQ(runs_of(file, folder / "o"), 6U);
    EXPECT_EQ(read_file(folder / "o/results.csv"), csv);
    std::ofstream(points[1]) << "";
    fs::remove(points[2]);
    fs::resize_file(points[3], fs::file_size(points[3]) - 1);
    std::ofstream(points[4], std::ios::app) << "\n";
    EXPECT_EQ(runs_of(file, folder / "o"), 4U);
    EXPECT_EQ(read_file(folder / "o/results.csv"), csv);
}

// A point holds its reports, so that they cost no run.
TEST(PointFiles, LostReportsComeBack) {
    const Folder folder;
    const std::string file = study_with(folder, std::string(kSix) + "frames: 3\n");
    EXPECT_GT(runs_of(file, folder / "o"), 0U);
    std::map<std::string, std::string> before;
    for (const std::string& report : files_in(folder / "o/reports")) {
        before[report] = read_file(report);
    }
    ASSERT_EQ(before.size(), 12U);
    const auto damage = [&] {
        fs::remove(folder / "o/reports/000001.json");
        std::ofstream(folder / "o/reports/000002.json") << "broken";
        flip(folder / "o/reports/000003-path.json", 70, 2);
    };
    for (const char* how : {"--collect", ""}) {
        damage();
        EXPECT_EQ(runs_of(file, folder / "o",
                          *how == 0 ? std::vector<std::string>() : std::vector<std::string>{how}),
                  0U);
        for (const auto& [report, text] : before) {
            EXPECT_EQ(read_file(report), text) << report;
        }
    }
}

// Another value, camera, size or design in front of the others, and another study in the folder.
TEST(PointFiles, AreReusedByOtherStudies) {
    const Folder folder;
    const std::string out = folder / "o";
    const std::string file = study_with(folder, kSix);
    EXPECT_EQ(runs_of(file, out), 6U);
    const auto extended = [&](const std::string& lines) {
        return runs_of(study_with(folder, lines, "more"), out);
    };
    EXPECT_EQ(extended("axes:\n  clock_ghz: [0.25, 0.5, 1, 2]\ncameras: [0, 1]\nwidth: 48\n"), 2U);
    EXPECT_EQ(extended("axes:\n  clock_ghz: [2, 1]\ncameras: [2, 1]\nwidth: 48\n"), 2U);
    EXPECT_EQ(extended("axes:\n  clock_ghz: [1, 2]\ncameras: [0]\nwidth: 32\n"), 2U);
    EXPECT_EQ(extended("axes:\n  clock_ghz: [1, 2]\ncameras: 0\nwidth: 48\nreference: false\n"),
              2U);
    EXPECT_EQ(runs_of(file, out), 0U); // the first study is still there
    EXPECT_EQ(runs_of(file, folder / "fresh"), 6U);
    for (const char* name : {"results.csv", "results.json", "index.html"}) {
        EXPECT_EQ(read_file(out + "/" + name), read_file(folder / ("fresh/" + std::string(name))))
            << name;
    }
    EXPECT_EQ(files_in(out + "/reports").size(), 6U);
}

TEST(PointFiles, DependOnTheContentOfTheScene) {
    const Folder folder;
    write_camera(folder / "cameras.json", {0, 0, -3});
    write_ply(folder / "s.ply", {Splat()});
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "designs: [{include: " << config("degs-16")
                        << ", name: d}]\nscenes: s.ply\n";
    EXPECT_EQ(runs_of(file, folder / "o"), 1U);
    EXPECT_EQ(runs_of(file, folder / "o"), 0U);
    write_ply(folder / "s.ply", {Splat(), Splat()});
    EXPECT_EQ(runs_of(file, folder / "o"), 1U);
    write_camera(folder / "cameras.json", {0, 0, -4});
    EXPECT_EQ(runs_of(file, folder / "o"), 1U);
}

/// No file of the program may exceed these bytes, as on a disk that is full.
std::function<void()> disk_of(rlim_t bytes) {
    return [bytes] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    };
}

// The files of points are larger than the others that are written before them.
TEST(HostilePointFiles, StopWhenTheyCannotBeWritten) {
    const Folder folder;
    const std::string file = study_with(folder, kSix);
    for (const char* jobs : {"1", "3"}) {
        const Outcome outcome =
            degs({"sweep", file, "--out", folder / "o", "--jobs", jobs}, disk_of(4000));
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(outcome.err.find(" points done · "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find(" was not kept: "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("stopped with 0 of 6 points done"), std::string::npos)
            << outcome.err;
        EXPECT_TRUE(files_in(folder / "o/points").empty());
    }
    EXPECT_EQ(degs({"explore", file, "--out", folder / "e"}, disk_of(4000)).code, 2);
    EXPECT_EQ(runs_of(file, folder / "o"), 6U);
}

TEST(HostilePointFiles, AComparisonStopsToo) {
    const Folder folder;
    const Outcome outcome = degs({"compare", config("degs-16"), config("degs-64"), "--scene",
                                  "synthetic:single", "--width", "48", "--out", folder / "o"},
                                 disk_of(4000));
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.err.find(" done · "), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("were not kept: "), std::string::npos) << outcome.err;
}

} // namespace
} // namespace degs::sim_test
