// SPDX-License-Identifier: Apache-2.0
// degs explore: fronts by hand, and a search against all points of a small study.
#include <iterator>
#include <map>
#include <set>

#include "sim/search/evolution.hpp"
#include "sim/search/search.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/process/csv_rows.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;
using Positions = std::vector<std::size_t>;

TEST(ParetoFront, HasWhomNobodyBeats) {
    //                              0       1       2       3       4       5
    const std::vector<Goals> goals{{1, 9}, {2, 5}, {3, 5}, {4, 1}, {2, 5}, {1, 10}};
    EXPECT_EQ(pareto_front(goals), (Positions{0, 1, 3}));
    EXPECT_EQ(pareto_front({}), Positions{});
    EXPECT_EQ(pareto_front({Goals{7, 7}}), Positions{0});
}

/// A study of 24 designs on two views.
std::string space(const Folder& folder, const std::string& size = "width: 128\n") {
    const std::string file = folder / "space.yaml";
    std::ofstream(file) << "study: space\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\n    pipeline: {tiles: exact}\naxes:\n"
                           "  span.count: [2, 4, 8, 16]\n"
                           "  array.pes_per_bank: [4, 8, 16]\n  packing.bytes: [x1, x2]\n"
                           "scenes: synthetic:object,gaussians=300\ncameras: [0, 2]\n"
                        << size;
    return file;
}

/// On one of these views.
std::string eight_designs(const Folder& folder) {
    const std::string file = folder / "small.yaml";
    std::ofstream(file) << "study: small\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n  span.count: [2, 8]\n"
                           "  array.pes_per_bank: [4, 16]\n  packing.bytes: [x1, x2]\n"
                           "scenes: synthetic:object,gaussians=300\nwidth: 64\n";
    return file;
}

std::vector<std::string> csv_rows(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::vector<std::string> csv_cells(const std::string& line) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) {
        row.push_back(cell);
    }
    return row;
}

/// The designs of front.csv that are on the front.
std::vector<Goals> front_in(const std::string& folder) {
    std::vector<Goals> front;
    for (const std::string& line : csv_rows(read_file(folder + "/front.csv"))) {
        const std::vector<std::string> row = csv_cells(line);
        if (row.size() == 9 && row[6] == "1") { // design, three keys, two goals, on_front, ...
            front.push_back({std::stod(row[4]), std::stod(row[5])});
        }
    }
    return front;
}

Outcome explore(const std::string& file, const std::string& out,
                const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"explore", file, "--out", out, "--jobs", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return degs(words);
}

// A budget with room for all designs simulates them all, so its front is that of all designs.
TEST(Explore, FindsTheFrontOfAllDesigns) {
    const Folder folder;
    const std::string file = space(folder);
    EXPECT_EQ(explore(file, folder / "all").code, 0);
    const Outcome searched = explore(file, folder / "few", {"--budget", "16"});
    EXPECT_EQ(searched.code, 0) << searched.err;
    const std::vector<Goals> found = front_in(folder / "few");
    const std::vector<Goals> all = front_in(folder / "all");
    EXPECT_GE(all.size(), 4U);
    for (const Goals& best : all) { // one of two that are nearly the same may be lost
        EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                [&best](const Goals& other) {
                                    return other[0] <= 1.01 * best[0] && other[1] <= 1.01 * best[1];
                                }))
            << best[0] << " mm2, " << best[1] << " ms";
    }
    const auto explored = nlohmann::json::parse(read_file(folder / "few/explore.json"));
    EXPECT_EQ(explored["estimates"]["designs"].size(), 24U);
    EXPECT_LE(explored["results"]["designs"].size(), 16U);
    EXPECT_GT(explored["estimates"]["rank_correlation"]["latency_ms"], 0.5);
    for (const char* file_name :
         {"index.html", "results.csv", "front.svg", "estimates/results.csv"}) {
        EXPECT_TRUE(fs::exists(folder / ("few/" + std::string(file_name)))) << file_name;
    }
}

TEST(Explore, GoesOnInItsFolder) {
    const Folder folder;
    const std::string file = eight_designs(folder);
    EXPECT_EQ(explore(file, folder / "out").code, 0);
    const std::string before = read_file(folder / "out/explore.json");
    fs::remove(fs::directory_iterator(folder / "out/points")->path());
    const Outcome again = explore(file, folder / "out");
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(read_file(folder / "out/explore.json"), before);
}

TEST(Explore, RefusesWhatItCannotSearch) {
    const Folder folder;
    expect_mistake(explore(space(folder), folder / "b", {"--goals", "area_mm2,latency"}),
                   "latency");
    const auto refuses = [&folder](const std::string& goals, const std::string& words,
                                   const std::vector<std::string>& more = {}) {
        std::vector<std::string> options{"--goals", goals};
        options.insert(options.end(), more.begin(), more.end());
        expect_mistake(explore(space(folder), folder / "c", options), words);
        EXPECT_FALSE(fs::exists(folder / "c"));
    };
    refuses("throughput_fps,latency_ms", "has no throughput_fps, so it cannot be a goal");
    refuses("area_mm2,image.ssim", "needs reference images", {"--no-reference"});
    refuses("area_mm2,dram.bytes_read", "for the arrays alone", {"--array-only"});
    refuses("area_mm2,dram.utilization", "neither small nor large values are better; allowed are ");
    refuses("host.sim_s,area_mm2", "neither small nor large values are better; allowed are ");
    refuses("fps,fps", "twice");
    refuses("area_mm2,design", "which is no measure; 'degs config --stats --of compare' lists");
    refuses("latency,area_mm2",
            "which is no measure; did you mean 'latency_ms', 'ratio.latency' or "
            "'ratio.latency_per_mm2'? 'degs config");
    refuses("area_mm2,area", "did you mean 'area_mm2'? 'degs");
    refuses("area_mm2,fsp", "did you mean 'fps'? 'degs");
}

/// The cells of a table's column in a text: of the lines below the one that begins with `first`.
std::vector<std::string> column_below(const std::string& text, const std::string& first,
                                      std::size_t from_right) {
    std::vector<std::string> cells;
    std::istringstream stream(text);
    bool inside = false;
    for (std::string line; std::getline(stream, line);) {
        std::istringstream words(line);
        std::vector<std::string> row{std::istream_iterator<std::string>(words), {}};
        if (inside && row.size() > from_right) {
            cells.push_back(row[row.size() - 1 - from_right]);
        }
        inside = line.rfind(first + " ", 0) == 0 || (inside && !row.empty());
    }
    return cells;
}

// Areas of 10 000 and some hundredths are one number of three digits; of designs that differ, the
// tables show in what they do.
TEST(Explore, TablesTellDesignsApart) {
    const Folder folder;
    const std::string file = eight_designs(folder);
    const std::vector<std::string> options{"--goals", "min:area_mm2+10000,cycles"};
    const Outcome searched = explore(file, folder / "out", options);
    EXPECT_EQ(searched.code, 0) << searched.err;
    std::set<std::string> areas; // of the front and the baseline, as front.csv has them
    for (const CsvRow& row : rows_by_heading(read_file(folder / "out/front.csv"))) {
        if (row.at("on_front") == "1" || row.at("baseline") == "1") {
            areas.insert(row.at("area_mm2+10000"));
        }
    }
    ASSERT_GE(areas.size(), 2U);
    const auto shown = column_below(searched.out, "front", 1);
    EXPECT_EQ((std::set<std::string>{shown.begin(), shown.end()}.size()), areas.size())
        << searched.out;
}

// What a limit is about is beside the goals, in the table as in front.csv: the least of the ratios
// of the views is not the ratio of the slowest views.
TEST(Explore, ShowsWhatLimitsAreAbout) {
    const Folder folder;
    const Outcome searched = explore(space(folder, "width: 64\n"), folder / "out",
                                     {"--limits", "worst(ratio.latency)>=0.98,area_mm2<=9"});
    EXPECT_EQ(searched.code, 0) << searched.err;
    EXPECT_NE(searched.out.find("worst(ratio.latency)\n"), std::string::npos) << searched.out;
    const std::string front = read_file(folder / "out/front.csv");
    EXPECT_EQ(csv_rows(front)[0],
              "design,span.count,array.pes_per_bank,packing.bytes,area_mm2,latency_ms,"
              "worst(ratio.latency),on_front,baseline,fidelity,within");
    const auto design = [](const CsvRow& row) {
        return row.at("span.count") + "," + row.at("array.pes_per_bank") + "," +
               row.at("packing.bytes");
    };
    std::map<std::string, double> least; // of the views
    for (const CsvRow& row : rows_by_heading(read_file(folder / "out/results.csv"))) {
        const double ratio = std::stod(row.at("ratio.latency"));
        const auto known = least.emplace(design(row), ratio).first;
        known->second = std::min(known->second, ratio);
    }
    EXPECT_EQ(least.size(), 24U);
    for (const CsvRow& row : rows_by_heading(front)) {
        const double shown = std::stod(row.at("worst(ratio.latency)"));
        EXPECT_DOUBLE_EQ(shown, least.at(design(row)));
        EXPECT_EQ(row.at("within") == "yes", shown >= 0.98) << design(row);
    }
}

// What is good when it is large gives the front of what is good when it is small.
TEST(Explore, MakesGoalsLargeWhereThatIsBetter) {
    const Folder folder;
    const std::string file = eight_designs(folder);
    const auto names_on_front = [&](const std::string& goals, const std::string& out) {
        EXPECT_EQ(explore(file, folder / out, {"--goals", goals}).code, 0);
        std::vector<std::string> designs;
        for (const std::string& line : csv_rows(read_file(folder / (out + "/front.csv")))) {
            const std::vector<std::string> row = csv_cells(line);
            if (row.size() == 9 && row[6] == "1") {
                designs.push_back(row[1] + " " + row[2] + " " + row[3]);
            }
        }
        return designs;
    };
    const auto slow = names_on_front("area_mm2,latency_ms", "latency");
    EXPECT_GE(slow.size(), 2U);
    EXPECT_EQ(names_on_front("area_mm2,fps", "fps"), slow);
    EXPECT_EQ(names_on_front("area_mm2,ratio.latency", "ratio"), slow);
    auto turned = names_on_front("fps,area_mm2", "turned"); // the fastest comes first
    std::reverse(turned.begin(), turned.end());
    EXPECT_EQ(turned, slow);
    const auto explored = nlohmann::json::parse(read_file(folder / "fps/explore.json"));
    EXPECT_EQ(explored["better"], nlohmann::json({"smaller", "larger"}));
    EXPECT_NE(read_file(folder / "fps/front.svg").find("fps (larger is better)"),
              std::string::npos);
}

TEST(Measures, KnowTheirDirection) {
    EXPECT_EQ(direction_of(measure_named("slots.useful", "")), Direction::Maximise);
    EXPECT_EQ(direction_of(measure_named("slots.boundary", "")), Direction::Minimise);
    EXPECT_EQ(direction_of(measure_named("slots.drain", "")), Direction::Minimise);
    EXPECT_EQ(direction_of(measure_named("image.psnr_db", "")), Direction::Maximise);
    EXPECT_EQ(direction_of(measure_named("image.max_abs_error", "")), Direction::Minimise);
    EXPECT_EQ(direction_of(measure_named("energy.nj_per_frame", "")), Direction::Minimise);
    EXPECT_EQ(direction_of(measure_named("host.sim_s", "")), Direction::None);
    for_each_measure([](Measure m) { // ratios are so made that above 1 is better
        if (name_of(m).rfind("ratio.", 0) == 0) {
            EXPECT_EQ(direction_of(m), Direction::Maximise) << name_of(m);
        }
    });
}

} // namespace
} // namespace degs::sim_test
